//! Limits of pictures.

/// The longest side of a PNG in pixels: that of a figure wider than two pages at 1200 dpi, with 1
/// GiB of pixels.
pub(crate) const MAX_SIDE_PX: f32 = 16384.0;

/// The smallest text in print, in points.
pub const LEAST_PT: f64 = 6.0;
