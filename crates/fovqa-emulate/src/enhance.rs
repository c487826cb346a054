//! Contrast enhancement of the periphery: I' = clamp(I + f (I - blur(I, 2s)), 0, 1), with
//! f = f_max · clamp((e - e_f) / T, 0, 1) and s the width of the blur that it makes up for (Patney et al.
//! 2016, section 3.1). On the encoded signal.

use fovqa_methods::Setting;
use fovqa_methods::sandbox::Sandbox;

use crate::blur::Blur;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};

/// Enhancement of frames at a gaze.
#[derive(Debug)]
pub(crate) struct Enhancer {
    blur: Blur,
    strength: Radial,
    offsets: Offsets,
}

impl Enhancer {
    pub(crate) fn new(sandbox: &Sandbox, setting: &Setting) -> Self {
        let reach = setting.corner_px();
        let width = |r: f64| 2.0 * sandbox.width_px(setting, r);
        let strength = |r: f64| sandbox.strength(setting.eccentricity_deg(r));
        Self {
            blur: Blur::new(Radial::new(Detail::Fine, reach, width)),
            strength: Radial::new(Detail::Fine, reach, strength),
            offsets: Offsets::new(setting),
        }
    }

    pub(crate) fn apply<const C: usize>(&self, image: &Image<C>) -> Image<C> {
        let blurred = self.blur.apply(image, &self.offsets);
        Image::by_rows(image.width(), image.height(), |y, out| {
            let squares = self.offsets.squares(y, 0..out.len());
            let pixels = image.row(y).iter().zip(blurred.row(y));
            for ((out, (sharp, soft)), square) in out.iter_mut().zip(pixels).zip(squares) {
                let f = self.strength.at(square);
                *out =
                    std::array::from_fn(|c| (sharp[c] + f * (sharp[c] - soft[c])).clamp(0.0, 1.0));
            }
        })
    }
}
