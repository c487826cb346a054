//! What every built-in scene can tell of a position in a frame.

/// What is at a position of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Distance along the viewing axis in metres.
    pub depth_m: f64,
    /// From this position to that of the same point in the frame before, in pixels; `None` where the
    /// point was behind the eye.
    pub motion_px: Option<[f64; 2]>,
}

/// A frame of a built-in scene, as a function of position. Positions are in pixels from the top-left
/// corner; those off the frame have values as well.
pub trait FrameScene: Send + Sync {
    /// Linear light, Rec. 709; 1 is white paper.
    fn light(&self, x: f64, y: f64) -> [f32; 3];

    /// Depth and motion.
    fn surface(&self, x: f64, y: f64) -> Surface;
}
