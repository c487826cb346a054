//! A continuous scene, asked for its light where samples stand.
//!
//! Nothing is clamped to the frame. The rays of an area sample are averaged in linear light; exposure,
//! tone map and encoding follow, as metrics apply them to frames of linear light.

use std::borrow::Cow;
use std::ops::Range;

use fovqa_frame::transfer::srgb;
use fovqa_frame::{SignalParams, ToneMap};

use crate::fetch::mean16;
use crate::image::Image;
use crate::polar_view::PolarView;
use crate::ragged::Ragged;
use crate::sample_places::SamplePlaces;
use crate::sampling::Sampling;
use crate::separable::Separable;
use crate::source::{Source, pixel_position};
use crate::space::Space;
use crate::texel::{Texel, narrowed, widened};
use crate::value::Value;
use crate::values::Values;

/// A scene as seen from one point: the light of each of its rays.
pub trait SceneLight: Sync {
    /// Linear light (Rec. 709; 1 is white) that arrives along the ray of a position on the frame's
    /// plane, in pixels from the top-left corner. Samples of some methods stand off the frame; their
    /// positions have light too.
    fn light(&self, x: f64, y: f64) -> [f32; 3];
}

/// A scene, and what becomes of its light.
pub(crate) struct SceneSource<'a> {
    scene: &'a dyn SceneLight,
    gain: f32,
    tonemap: ToneMap,
    /// `None` where the method runs on linear values.
    encoder: Option<srgb::Encoder>,
}

impl<'a> SceneSource<'a> {
    /// The scene as values of a space. Light is linear whatever `signal` says of frames.
    pub(crate) fn new(scene: &'a dyn SceneLight, signal: &SignalParams, space: Space) -> Self {
        Self {
            scene,
            gain: libm::exp2(signal.exposure_stops) as f32,
            tonemap: signal.tonemap,
            encoder: (space == Space::Encoded).then(srgb::Encoder::new),
        }
    }

    /// A sample whose places are at positions in pixels.
    fn ask(&self, sampling: Sampling, position: impl Fn(usize, usize) -> [f64; 2]) -> Texel {
        let ray = |p: usize, q: usize| {
            let [x, y] = position(p, q);
            // A ray without a value is black, as a pixel without one is.
            self.scene.light(x, y).map(|light| if light.is_nan() { 0.0 } else { light })
        };
        let light = match sampling {
            Sampling::Point => ray(0, 0),
            Sampling::Area => mean16(ray),
        };
        widened(light.map(|light| {
            let mapped = self.tonemap.map(light * self.gain);
            self.encoder.map_or(mapped, |encoder| encoder.encode(mapped))
        }))
    }
}

impl Source<3> for SceneSource<'_> {
    fn has_pixels(&self, _places: SamplePlaces) -> bool {
        false
    }

    fn sample(&self, places: SamplePlaces, position: impl Fn(f64, f64) -> [f64; 2]) -> Texel {
        let (x, y) = (places.axis(0), places.axis(1));
        self.ask(places.sampling, |p, q| position(x.at(p), y.at(q)))
    }

    fn sample_pixels(
        &self,
        places: SamplePlaces,
        y: usize,
        xs: Range<usize>,
        out: &mut [[f32; 3]],
    ) {
        for (x, out) in xs.zip(out) {
            *out = narrowed(self.sample(places, pixel_position(x, y)));
        }
    }

    fn sample_frame<V: Value>(&self, places: SamplePlaces, size: [usize; 2]) -> Image<3, V> {
        self.signal(places, size).into_owned().kept()
    }

    fn signal(&self, places: SamplePlaces, [width, height]: [usize; 2]) -> Cow<'_, Image<3>> {
        Cow::Owned(Image::by_strips(width, height, 1, |ys, row| {
            self.sample_pixels(places, ys.start, 0..width, row);
        }))
    }

    fn sample_grid<const L: usize>(&self, grid: &Separable) -> Image<L> {
        let [width, height] = grid.size();
        let of_axis = [&grid.x, &grid.y].map(|axis| axis.places_px.as_slice());
        let count = grid.places.axis(0).count;
        Image::by_strips(width, height, 1, |ys, row| {
            let j = ys.start;
            for (i, out) in row.iter_mut().enumerate() {
                let position =
                    |p: usize, q: usize| [of_axis[0][count * i + p], of_axis[1][count * j + q]];
                *out = narrowed(self.ask(grid.places.sampling, position));
            }
        })
    }

    fn sample_polar(&self, buffer: &Ragged) -> Values {
        buffer.fill(|column, out| {
            for (j, out) in out.iter_mut().enumerate() {
                let position = |p: usize, q: usize| buffer.place_px(column, j, p, q);
                *out = self.ask(buffer.places.sampling, position);
            }
        })
    }

    fn show_polar<V: Value>(&self, view: &PolarView, buffer: &Ragged) -> Image<3, V> {
        view.show_values(buffer, &self.sample_polar(buffer))
    }
}
