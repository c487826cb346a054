//! What samples are taken from: a finished frame, or a scene.

use std::borrow::Cow;
use std::ops::Range;

use crate::fetch::mean16;
use crate::image::Image;
use crate::pixels::Pixels;
use crate::polar_view::PolarView;
use crate::ragged::Ragged;
use crate::sample_places::SamplePlaces;
use crate::sampling::Sampling;
use crate::separable::Separable;
use crate::texel::{Texel, narrowed};
use crate::value::Value;
use crate::values::Values;

/// What samples of `C` channels are taken from.
pub(crate) trait Source<const C: usize>: Sync {
    /// Whether the pixels of the frame are there, and samples of one per pixel are those pixels.
    fn has_pixels(&self, places: SamplePlaces) -> bool;

    /// A single sample; `position` leads from a place within its cell, both from 0 to 1, to the frame in
    /// pixels.
    fn sample(&self, places: SamplePlaces, position: impl Fn(f64, f64) -> [f64; 2]) -> Texel;

    /// Samples of one per pixel: those of the pixels `xs` of row `y`.
    fn sample_pixels(&self, places: SamplePlaces, y: usize, xs: Range<usize>, out: &mut [[f32; C]]);

    /// The samples of one per pixel of the whole frame, whose size is `[width, height]`.
    fn sample_frame<V: Value>(&self, places: SamplePlaces, size: [usize; 2]) -> Image<C, V>;

    /// The same as the signal.
    fn signal(&self, places: SamplePlaces, size: [usize; 2]) -> Cow<'_, Image<C>>;

    /// The samples of a buffer of two axes.
    fn sample_grid<const L: usize>(&self, grid: &Separable) -> Image<L>;

    /// The samples of a polar buffer.
    fn sample_polar(&self, buffer: &Ragged) -> Values;

    /// The frame as read from a polar buffer without filter.
    fn show_polar<V: Value>(&self, view: &PolarView, buffer: &Ragged) -> Image<C, V>;
}

/// The position of the one sample of a pixel for a place within it.
pub(crate) fn pixel_position(x: usize, y: usize) -> impl Fn(f64, f64) -> [f64; 2] {
    move |px, py| [x as f64 + px, y as f64 + py]
}

impl<const C: usize, P: Pixels<C>> Source<C> for P {
    fn has_pixels(&self, places: SamplePlaces) -> bool {
        places.are_centred()
    }

    fn sample(&self, places: SamplePlaces, position: impl Fn(f64, f64) -> [f64; 2]) -> Texel {
        let (x, y) = (places.axis(0), places.axis(1));
        let at = |p: usize, q: usize| {
            let [x, y] = position(x.at(p), y.at(q));
            self.at_place(x, y)
        };
        match places.sampling {
            Sampling::Point => at(0, 0),
            Sampling::Area => mean16(at),
        }
    }

    fn sample_pixels(
        &self,
        places: SamplePlaces,
        y: usize,
        xs: Range<usize>,
        out: &mut [[f32; C]],
    ) {
        if self.has_pixels(places) {
            return self.read_row(y, xs, out);
        }
        for (x, out) in xs.zip(out) {
            *out = narrowed(self.sample(places, pixel_position(x, y)));
        }
    }

    fn sample_frame<V: Value>(&self, places: SamplePlaces, size: [usize; 2]) -> Image<C, V> {
        let [width, height] = size;
        Image::by_rows(width, height, |y, row| self.sample_pixels(places, y, 0..width, row))
    }

    fn signal(&self, places: SamplePlaces, size: [usize; 2]) -> Cow<'_, Image<C>> {
        if self.has_pixels(places) {
            return Pixels::signal(self);
        }
        Cow::Owned(self.sample_frame(places, size))
    }

    fn sample_grid<const L: usize>(&self, grid: &Separable) -> Image<L> {
        grid.sample(self)
    }

    fn sample_polar(&self, buffer: &Ragged) -> Values {
        buffer.sample(self)
    }

    fn show_polar<V: Value>(&self, view: &PolarView, buffer: &Ragged) -> Image<C, V> {
        view.show(buffer, self)
    }
}
