//! RMFR: each axis squeezed by itself, `b = (Q(t) + gaze) n / W` (Ye et al. 2022, Eq. 4-7).

use fovqa_methods::Setting;
use fovqa_methods::rmfr::{Params, Rmfr as Mapped};

use crate::counts::Counts;
use crate::image::Image;
use crate::layer_axis::layer_axis;
use crate::sample_places::SamplePlaces;
use crate::separable::Separable;
use crate::source::Source;
use crate::value::Value;

/// RMFR of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct Rmfr {
    buffer: Separable,
}

impl Rmfr {
    pub(crate) fn new(params: &Params, setting: &Setting, places: SamplePlaces) -> Self {
        let mapped = Mapped::new(params, setting);
        let axis = |axis| layer_axis(&mapped, setting, 0, axis, places);
        Self { buffer: Separable::new(axis(0), axis(1), places) }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.buffer.positions()
    }

    pub(crate) fn counts(&self) -> Counts {
        let [w, h] = self.buffer.size();
        Counts::rectangular(vec![[w, h]], (w * h) as f64)
    }

    pub(crate) fn buffer<const C: usize>(&self, source: &impl Source<C>) -> Image<C> {
        source.sample_grid(&self.buffer)
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        self.buffer.read(&source.sample_grid(&self.buffer))
    }
}
