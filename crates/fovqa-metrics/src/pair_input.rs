//! A pair of frames, as a metric with a pass of its own is given it.

use fovqa_frame::{Frame, SignalTables};

use crate::regions::{BlockRegions, Regions};

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
    /// Bands of the blocks of each level that the metric needs ([`crate::Params::block_levels`]), without
    /// those that a mask leaves out.
    pub blocks: &'a BlockRegions<'a>,
    /// Whether a map is asked for.
    pub map: bool,
}
