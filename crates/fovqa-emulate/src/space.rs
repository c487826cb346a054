//! The values a method runs on.

use fovqa_frame::transfer::srgb;
use fovqa_params::words;

use crate::image::Image;

words! {
    /// The values a method and its own filters run on.
    #[derive(Default)]
    pub enum Space {
        /// Encoded for display, as on a tone-mapped render target.
        #[default]
        Encoded "encoded" "Encoded for display, as on a tone-mapped target";
        /// Linear light: decoded before the method and encoded behind it.
        Linear "linear" "Linear light, decoded before the method and encoded behind it";
    }
}

/// Encoded values to linear light (sRGB).
pub(crate) fn decoded<const C: usize>(image: &Image<C>) -> Image<C> {
    let decoder = srgb::Decoder::new();
    image.map_rows(|row, out| each(row, out, |value| decoder.decode(value)))
}

/// Linear light to encoded values (sRGB).
pub(crate) fn encoded<const C: usize>(image: &Image<C>) -> Image<C> {
    let encoder = srgb::Encoder::new();
    image.map_rows(|row, out| each(row, out, |value| encoder.encode(value)))
}

fn each<const C: usize>(row: &[[f32; C]], out: &mut [[f32; C]], of: impl Fn(f32) -> f32) {
    for (out, value) in out.iter_mut().zip(row) {
        *out = value.map(&of);
    }
}
