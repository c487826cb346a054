//! The perceptual sandbox of Patney et al. 2016, section 3.1: a frame blurred with eccentricity (`stable`),
//! the same loss of detail as aliasing (`aliased`), and blurred with its contrast restored
//! (`perceptual-target`). Methods of emulation alone: they have no buffer and save nothing.

use fovqa_methods::Setting;
use fovqa_methods::sandbox::Sandbox;

use crate::blur::Blur;
use crate::grids::Grids;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::sample_places::SamplePlaces;
use crate::source::Source;
use crate::value::Value;

/// A frame that is blurred with eccentricity.
#[derive(Debug)]
pub(crate) struct Stable {
    blur: Blur,
    offsets: Offsets,
    pub(crate) places: SamplePlaces,
}

impl Stable {
    pub(crate) fn new(sandbox: &Sandbox, setting: &Setting, places: SamplePlaces) -> Self {
        let width = |r: f64| sandbox.width_px(setting, r);
        let width = Radial::new(Detail::Fine, setting.corner_px(), width);
        Self { blur: Blur::new(width), offsets: Offsets::new(setting), places }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        let size = [self.offsets.width(), self.offsets.height()];
        self.blur.apply(&source.signal(self.places, size), &self.offsets).kept()
    }
}

/// A frame on coarser and coarser grids: j = log2 max(1, s).
#[derive(Debug)]
pub(crate) struct Aliased {
    grids: Grids,
}

impl Aliased {
    pub(crate) fn new(sandbox: &Sandbox, setting: &Setting, places: SamplePlaces) -> Self {
        let level = |r: f64| libm::log2(sandbox.width_px(setting, r).max(1.0));
        let level = Radial::new(Detail::Fine, setting.corner_px(), level);
        Self { grids: Grids::new(level, Offsets::new(setting), places) }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.grids.positions()
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        self.grids.show(source)
    }
}
