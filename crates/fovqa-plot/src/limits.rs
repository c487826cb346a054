//! Limits of pictures.

/// The longest side of a PNG: a figure over two pages' width at 1200 dpi, and 1 GiB of pixels.
pub(crate) const MAX_SIDE_PX: f32 = 16384.0;
