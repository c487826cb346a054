//! What temporal metrics measure: the last frames of pictures, and the motion between them.

use fovqa_frame::{Mask, Motion, Plane};

use super::kept_motion::KeptMotion;
use super::kept_plane::KeptPlane;
use crate::regions::Regions;
use crate::row::Image;

/// The last frames of pictures that move alike, and their motion.
#[derive(Debug, Clone, Copy)]
pub struct TimeInput<'a> {
    /// Backward motion of the present frame; `None` if nothing moves.
    pub motion: Option<&'a Motion>,
    /// Depth of the present frame; `None` if depth is ignored.
    pub depth: Option<&'a Plane>,
    /// The pixels of the present frame that count, with the band of each.
    pub regions: &'a Regions<'a>,
    /// The frames before, the nearest first.
    pub before: &'a [FrameBefore<'a>],
    /// The pictures.
    pub pictures: &'a [Picture<'a>],
}

/// A frame before the present one.
#[derive(Debug, Clone, Copy)]
pub struct FrameBefore<'a> {
    /// Its backward motion, to the frame before it; `None` if nothing moves.
    pub motion: Option<&'a KeptMotion>,
    /// Its depth; `None` if depth is ignored.
    pub depth: Option<&'a KeptPlane>,
    /// The pixels that count; `None` means all.
    pub mask: Option<&'a Mask>,
}

/// The luma of a picture over time.
#[derive(Debug, Clone)]
pub struct Picture<'a> {
    /// Whether it is the reference or the test.
    pub image: Image,
    /// The luma of the present frame, and of the frames before it, the nearest first.
    pub lumas: Vec<&'a KeptPlane>,
}

impl TimeInput<'_> {
    /// Width and height of the pictures in pixels.
    ///
    /// # Panics
    /// When planes or regions differ in size.
    pub(crate) fn size(&self) -> (usize, usize) {
        let of = |plane: &KeptPlane| (plane.width(), plane.height());
        let size = self.pictures.first().map_or((0, 0), |picture| of(picture.lumas[0]));
        let lumas = self.pictures.iter().flat_map(|picture| &picture.lumas);
        let depths = self.before.iter().filter_map(|frame| frame.depth);
        assert!(
            lumas.copied().chain(depths).all(|plane| of(plane) == size),
            "pictures of one size"
        );
        assert_eq!(self.regions.rows(), size.1, "regions of these pictures");
        size
    }
}
