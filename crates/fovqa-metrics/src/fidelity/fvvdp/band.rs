//! One band of a pyramid on a display.

use super::csf::Line;

/// One band, the finest first.
#[derive(Debug, Clone)]
pub(super) struct Band {
    pub(super) size: (usize, usize),
    /// Frequency at the centre of the display, cycles per degree.
    pub(super) cpd: f64,
    /// log2 of the gain of its contrast.
    pub(super) log2_gain: f32,
    /// Degrees from the centre of the display, of columns and of rows.
    pub(super) directions: [Vec<f64>; 2],
    /// Its sensitivity where every pixel is looked at directly.
    pub(super) foveal: Line,
}
