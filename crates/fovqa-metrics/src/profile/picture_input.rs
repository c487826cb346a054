//! The input of profiles: one picture.

use fovqa_frame::{Frame, SignalTables};
use fovqa_vision::{BandEdges, Eccentricity};

use crate::regions::{BlockRegions, Regions};
use crate::row::Image;

/// A picture to be measured by itself.
#[derive(Debug, Clone, Copy)]
pub struct PictureInput<'a> {
    /// The picture.
    pub frame: &'a Frame,
    /// The conversion from samples to the signal.
    pub tables: &'a SignalTables,
    /// The pixels that count, with the band of each.
    pub regions: &'a Regions<'a>,
    /// The bands of the blocks of each level that a metric needs
    /// ([`crate::Params::block_levels`]), without blocks that a mask leaves out.
    pub blocks: &'a BlockRegions<'a>,
    /// How the eye sees the picture, and the edges of the bands; `None` without a view.
    pub seen: Option<(&'a Eccentricity, &'a BandEdges)>,
    /// Whether it is the reference or the test.
    pub image: Image,
}
