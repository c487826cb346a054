//! Linear fall-off: grids of the density p, `j = -½ log2 p` (Weier et al. 2016; RMFR's comparison).

use fovqa_frame::Mask;
use fovqa_methods::linear::{Linear as Mapped, Params};
use fovqa_methods::{Foveation, MethodError, Place, Setting};

use crate::counts::Counts;
use crate::grids::Grids;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::sample_places::SamplePlaces;
use crate::source::Source;
use crate::sums::{sum_over_mask, sum_over_pixels};
use crate::value::Value;

/// Linear fall-off of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct Linear {
    grids: Grids,
    /// Samples for each pixel, by the distance from the gaze.
    density: Radial,
    samples: f64,
}

impl Linear {
    pub(crate) fn new(
        params: &Params,
        setting: &Setting,
        places: SamplePlaces,
    ) -> Result<Self, MethodError> {
        let mapped = Mapped::new(params, setting)?;
        let density = |r: f64| mapped.density(Place { radius_px: r, direction: [1.0, 0.0] });
        let offsets = Offsets::new(setting);
        let (fine, reach) = (Detail::Fine, setting.corner_px());
        let level = Radial::new(fine, reach, |r| -0.5 * libm::log2(density(r)));
        let density = Radial::new(fine, reach, density);
        let samples = sum_over_pixels(&density, &offsets);
        Ok(Self { grids: Grids::new(level, offsets, places), density, samples })
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.grids.positions()
    }

    /// Samples on the pixels of a mask, as the sum of their density.
    pub(crate) fn samples_on(&self, mask: &Mask) -> f64 {
        sum_over_mask(&self.density, self.grids.offsets(), mask)
    }

    pub(crate) fn counts(&self) -> Counts {
        Counts::on_screen(Vec::new(), self.samples)
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        self.grids.show(source)
    }
}
