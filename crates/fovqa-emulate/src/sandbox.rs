//! The perceptual sandbox of Patney et al. 2016, section 3.1: a frame blurred with eccentricity (`stable`),
//! the same loss of detail as aliasing (`aliased`), and blurred with its contrast restored
//! (`perceptual-target`). Methods of emulation alone: they have no buffer and save nothing.

use fovqa_methods::Setting;

use crate::blur::Blur;
use crate::grids::Grids;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::peripheral::Growth;
use crate::pixels::Pixels;
use crate::radial::{Detail, Radial};
use crate::sampling::Sampling;
use crate::value::Value;

/// A frame that is blurred with eccentricity.
#[derive(Debug)]
pub(crate) struct Stable {
    blur: Blur,
    offsets: Offsets,
}

impl Stable {
    pub(crate) fn new(growth: Growth, setting: &Setting) -> Self {
        let width = |r: f64| growth.width_px(setting, r);
        let width = Radial::new(Detail::Fine, setting.corner_px(), width);
        Self { blur: Blur::new(width), offsets: Offsets::new(setting) }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, frame: &impl Pixels<C>) -> Image<C, V> {
        V::keep(self.blur.apply(&frame.signal(), &self.offsets))
    }
}

/// A frame on coarser and coarser grids: j = log2 max(1, s).
#[derive(Debug)]
pub(crate) struct Aliased {
    grids: Grids,
}

impl Aliased {
    pub(crate) fn new(growth: Growth, setting: &Setting, sampling: Sampling) -> Self {
        let level = |r: f64| libm::log2(growth.width_px(setting, r).max(1.0));
        let level = Radial::new(Detail::Fine, setting.corner_px(), level);
        Self { grids: Grids::new(level, Offsets::new(setting), sampling) }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, frame: &impl Pixels<C>) -> Image<C, V> {
        self.grids.show(frame)
    }
}
