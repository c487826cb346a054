//! Metrics of fidelity with a pass of their own over a pair: what they are given, and what they give.

use fovqa_frame::{Frame, SignalTables};

use crate::fidelity::fpsnr::WeightField;
use crate::fidelity::{ScoreError, Scored};
use crate::regions::{BlockRegions, Regions};
use crate::registry::Params;

/// A pair for a pass of its own.
#[derive(Debug, Clone, Copy)]
pub struct PairInput<'a> {
    /// The reference.
    pub reference: &'a Frame,
    /// The test, of the same size.
    pub test: &'a Frame,
    /// From samples to the signal.
    pub tables: &'a SignalTables,
    /// Which pixels count, and into which band.
    pub regions: &'a Regions<'a>,
    /// The foveal weight of every pixel, where the metric needs it.
    pub weight: Option<&'a WeightField>,
    /// Bands of the blocks of each level that the metric needs ([`crate::Needs::block_levels`]), less
    /// those that a mask leaves out.
    pub blocks: &'a BlockRegions<'a>,
    /// Parameters of all metrics.
    pub params: &'a Params,
    /// Whether a map is asked for.
    pub map: bool,
}

/// Measures a pair.
pub type PairPass = fn(&PairInput<'_>) -> Result<Scored, ScoreError>;
