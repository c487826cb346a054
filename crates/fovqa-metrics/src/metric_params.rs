//! The parameters of a metric, and what follows from them.

use fovqa_params::{ParamError, ParamValue};

use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::pair_input::PairInput;

/// The parameters of one metric: defaults, how they are set by name, and what the metric needs with them.
pub(crate) trait MetricParams: Default + Clone + PartialEq {
    /// Whether the metric measures pairs in a pass of its own ([`Self::measure`]).
    const HAS_OWN_PASS: bool = false;

    /// Sets a parameter to a value that the metric's table of parameters allows; `None` where this
    /// value cannot be set.
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

    /// How many levels of blocks need bands: blocks of 2x2 pixels and, level by level, of 2x2 of those.
    fn block_levels(&self) -> usize {
        0
    }

    /// Measures a pair in a pass of its own; `None` where the metric shares the pass of other metrics.
    fn measure(&self, _input: &PairInput<'_>) -> Option<Result<Scored, ScoreError>> {
        None
    }
}

/// The parameters of a metric that has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoParams;

impl MetricParams for NoParams {}
