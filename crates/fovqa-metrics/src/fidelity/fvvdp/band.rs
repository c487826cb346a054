//! One spatial-frequency band of a pyramid on a display.

use super::csf::Line;

/// One band of a pyramid; bands are ordered from the finest on.
#[derive(Debug, Clone)]
pub(super) struct Band {
    pub(super) size: (usize, usize),
    /// Frequency at the centre of the display, in cycles per degree.
    pub(super) cpd: f64,
    /// log2 of the gain of its contrast.
    pub(super) log2_gain: f32,
    /// Directions of the columns and of the rows, in degrees from the centre of the display.
    pub(super) directions: [Vec<f64>; 2],
    /// The sensitivity for foveal vision at every pixel.
    pub(super) foveal: Line,
}
