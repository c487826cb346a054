//! Alpha: what to do with pixels that are not opaque.

use fovqa_params::words;

use crate::error::ReadErrorKind;

words! {
    /// How to treat alpha that is not 1 everywhere.
    #[derive(Default)]
    pub enum AlphaPolicy {
        /// Report an error that names the first such pixel.
        #[default]
        Error "error" "An error that names the first pixel that is not opaque";
        /// Use the colours as they are.
        Ignore "ignore" "Colours are used as they are, and alpha is ignored";
        /// Lay the picture over black: PNG colours are multiplied by alpha (as encoded, like a
        /// viewer does), OpenEXR colours are premultiplied already.
        OverBlack "over-black" "The image is composited over black";
    }
}

/// Checks that all alpha values are 1 (row by row, 1 = opaque). The error names the first one that
/// is not.
pub(crate) fn require_opaque(
    alpha: impl Iterator<Item = f32>,
    width: usize,
) -> Result<(), ReadErrorKind> {
    let (mut transparent, mut all_zero, mut first) = (0u64, true, None);
    for (i, value) in alpha.enumerate() {
        all_zero &= value == 0.0;
        if value.to_bits() != 1.0f32.to_bits() {
            transparent += 1;
            first.get_or_insert((i % width, i / width, value));
        }
    }
    match first {
        None => Ok(()),
        Some(_) if all_zero => Err(ReadErrorKind::AllTransparent),
        Some((x, y, value)) => Err(ReadErrorKind::Alpha { transparent, x, y, value }),
    }
}
