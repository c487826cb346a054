//! Contrast enhancement of the periphery: I' = clamp(I + f (I - blur(I, 2s)), 0, 1), with
//! f = f_max · clamp((e - e_f) / T, 0, 1) and s the width of the blur that it makes up for (Patney et al.
//! 2016, section 3.1). On the encoded signal.

use fovqa_methods::Setting;

use crate::blur::Blur;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::peripheral::Growth;
use crate::radial::{Detail, Radial};

/// Enhancement of frames at a gaze.
#[derive(Debug)]
pub(crate) struct Enhancer {
    blur: Blur,
    strength: Radial,
    offsets: Offsets,
}

impl Enhancer {
    /// `transition_deg` is T, above 0.
    pub(crate) fn new(f_max: f64, growth: Growth, transition_deg: f64, setting: &Setting) -> Self {
        let reach = setting.corner_px();
        let width = |r: f64| 2.0 * growth.width_px(setting, r);
        let strength = |r: f64| {
            let beyond_deg = setting.eccentricity_deg(r) - growth.foveal_deg;
            f_max * (beyond_deg / transition_deg).clamp(0.0, 1.0)
        };
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
