//! The input of a metric with its own pass: a pair of frames.

use fovqa_frame::{Frame, SignalTables};
use fovqa_vision::Eccentricity;

use crate::fidelity::fpsnr::WeightField;
use crate::regions::{BlockRegions, Regions};

/// A pair for a pass of its own.
#[derive(Debug, Clone, Copy)]
pub struct PairInput<'a> {
    /// The reference.
    pub reference: &'a Frame,
    /// The test, of the same size.
    pub test: &'a Frame,
    /// The conversion from samples to the signal.
    pub tables: &'a SignalTables,
    /// The pixels that count, with the band of each.
    pub regions: &'a Regions<'a>,
    /// The bands of the blocks of each level that the metric needs
    /// ([`crate::Params::block_levels`]), without blocks that a mask leaves out.
    pub blocks: &'a BlockRegions<'a>,
    /// How the eye sees the frames; `None` without a view.
    pub eccentricity: Option<&'a Eccentricity>,
    /// The foveal weight, if the metric needs or takes it and there is a view.
    pub weight: Option<&'a WeightField>,
    /// Whether a map is asked for.
    pub map: bool,
}
