//! The parameters of a metric, and the properties that depend on them.

use fovqa_params::{ParamError, ParamValue};

use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::pair_input::PairInput;
use crate::profile::PictureInput;
use crate::registry::Params;
use crate::row::Rows;
use crate::temporal::TimeInput;

/// The parameters of one metric: defaults, setting by name, and the needs of the metric with these
/// parameters.
pub(crate) trait MetricParams: Default + Clone + PartialEq {
    /// Whether the metric measures pairs or pictures in a pass of its own ([`Self::measure`],
    /// [`Self::profile`]).
    const HAS_OWN_PASS: bool = false;

    /// Sets a parameter to a value that the metric's parameter table allows; `None` if this value
    /// cannot be set.
    fn set(&mut self, _name: &str, _value: &ParamValue) -> Option<()> {
        None
    }

    /// Checks conditions that involve several parameters.
    fn check(&self) -> Result<(), ParamError> {
        Ok(())
    }

    /// The smallest side that a frame may have, in pixels. `ssim_window` is the side of SSIM's window,
    /// which MS-SSIM and FSSIM use too.
    fn smallest_side(&self, _ssim_window: usize) -> usize {
        1
    }

    /// The number of block levels that need bands: level 1 has blocks of 2x2 pixels, and each
    /// further level doubles their side.
    fn block_levels(&self) -> usize {
        0
    }

    /// The number of frames that a temporal metric compares, the present one included.
    fn frames_needed(&self) -> usize {
        1
    }

    /// Measures a picture in a pass of its own; `None` where the metric is no profile, or shares the pass of
    /// other profiles.
    fn profile(&self, _all: &Params, _input: &PictureInput<'_>) -> Option<Rows> {
        None
    }

    /// Measures the change of pictures over time, and returns the values of each; `None` where the metric is not
    /// temporal.
    fn follow(&self, _all: &Params, _input: &TimeInput<'_>) -> Option<Vec<Rows>> {
        None
    }

    /// Measures a pair in a pass of its own; `None` where the metric shares the pass of other metrics. `all`
    /// has the parameters of all metrics, for those that use another metric's.
    fn measure(&self, _all: &Params, _input: &PairInput<'_>) -> Option<Result<Scored, ScoreError>> {
        None
    }
}

/// The parameters of a metric that has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoParams;

impl MetricParams for NoParams {}
