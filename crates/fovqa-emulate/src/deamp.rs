//! DEAMP: nested boxes, each an RMFR of its own over its part of the frame (Wang, Gu, Lu 2024, Eq. 3-9).
//! A pixel reads the innermost layer whose box holds it; borders are hard.
//!
//! Filter on screen (ours): beyond the middle layer, the finished picture convolved with a Gaussian.

use std::ops::Range;

use fovqa_methods::deamp::{Deamp as Mapped, Params};
use fovqa_methods::{Mapping, MethodError, Place, Setting};

use crate::blur::gaussian;
use crate::borders::{Border, box_of};
use crate::counts::Counts;
use crate::image::Image;
use crate::layer_axis::layer_axis;
use crate::sample_places::SamplePlaces;
use crate::separable::Separable;
use crate::source::Source;
use crate::value::Value;

#[derive(Debug)]
struct Layer {
    buffer: Separable,
    /// Pixels of the frame whose centres are in the box, along x and y.
    inside: [Range<usize>; 2],
    /// Columns and rows of its samples whose places are in the layer inside: where both are, samples are
    /// not counted.
    hole: [Range<usize>; 2],
}

/// DEAMP of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct Deamp {
    /// The innermost first.
    layers: Vec<Layer>,
    samples: f64,
    /// The frame's width and height in pixels.
    size: [usize; 2],
    /// σ of the filter on screen in pixels, where it is on.
    screen_sigma_px: Option<f64>,
}

impl Deamp {
    pub(crate) fn new(
        params: &Params,
        setting: &Setting,
        places: SamplePlaces,
        screen_sigma_px: Option<f64>,
    ) -> Result<Self, MethodError> {
        let mapped = Mapped::new(params, setting)?;
        let gaze = setting.gaze_px();
        // The innermost layer a place along an axis can belong to.
        let layer_along = |axis: usize, position: f64| {
            let mut offset = [0.0; 2];
            offset[axis] = position - gaze[axis];
            mapped.layer_at(Place::at(offset))
        };
        let mut samples = 0;
        let layers = (0..mapped.layers()).map(|layer| {
            let axis = |axis| layer_axis(&mapped, setting, layer, axis, places);
            let buffer = Separable::new(axis(0), axis(1), places);
            let [w, h] = buffer.size();
            let hole = [(0, &buffer.x), (1, &buffer.y)].map(|(axis, along)| {
                let finer = |x: &f64| layer_along(axis, *x) < layer;
                let first = along.centres_px.iter().position(finer).unwrap_or(0);
                let behind =
                    along.centres_px.iter().rposition(finer).map_or(first, |last| last + 1);
                first..behind
            });
            samples += w * h - hole[0].len() * hole[1].len();
            let inside = [0, 1].map(|axis| {
                let side = setting.size_px()[axis] as usize;
                let held = |i: &usize| layer_along(axis, *i as f64 + 0.5) <= layer;
                let first = (0..side).find(held).unwrap_or(side);
                let behind = (first..side).rev().find(held).map_or(first, |last| last + 1);
                first..behind
            });
            Layer { buffer, inside, hole }
        });
        let layers = layers.collect();
        let size = setting.size_px().map(|side| side as usize);
        Ok(Self { layers, samples: samples as f64, size, screen_sigma_px })
    }

    /// Where samples of all layers stand, the innermost first, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.layers.iter().flat_map(|layer| layer.buffer.positions())
    }

    /// Where the samples that are counted stand, in pixels.
    pub(crate) fn counted_positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.layers.iter().flat_map(|layer| layer.buffer.positions_outside(&layer.hole))
    }

    /// The borders of all layers but the outermost, which ends with the frame.
    pub(crate) fn borders(&self) -> Vec<Border> {
        let [inner @ .., _] = self.layers.as_slice() else { return Vec::new() };
        inner.iter().map(|layer| box_of(layer.inside.each_ref())).collect()
    }

    pub(crate) fn counts(&self) -> Counts {
        let buffers = self.layers.iter().map(|layer| layer.buffer.size()).collect();
        Counts::rectangular(buffers, self.samples)
    }

    pub(crate) fn buffers<const C: usize>(&self, source: &impl Source<C>) -> Vec<Image<C>> {
        self.layers.iter().map(|layer| source.sample_grid(&layer.buffer)).collect()
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        match self.screen_sigma_px {
            Some(sigma_px) => self.filter_on_screen(self.unfiltered(source), sigma_px).kept(),
            None => self.unfiltered(source),
        }
    }

    fn unfiltered<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        let sample = |layer: &Layer| source.sample_grid(&layer.buffer);
        let buffers: Vec<Image<4>> = self.layers.iter().map(sample).collect();
        let [width, height] = self.size;
        Image::by_rows_with(width, height, Vec::new, |scratch, y, out| {
            for (layer, buffer) in self.layers.iter().zip(&buffers).rev() {
                let [xs, ys] = layer.inside.clone();
                if ys.contains(&y) {
                    let out = &mut out[xs.clone()];
                    layer.buffer.read_row(buffer, y, xs, scratch, out);
                }
            }
        })
    }

    /// Of `n` layers those behind the first ceil(n / 2) are filtered.
    fn filter_on_screen<const C: usize>(&self, shown: Image<C>, sigma_px: f64) -> Image<C> {
        let kept = self.layers.len().div_ceil(2);
        if kept == self.layers.len() {
            return shown;
        }
        let [xs, ys] = &self.layers[kept - 1].inside;
        let blurred = gaussian(&shown, sigma_px);
        Image::by_rows(shown.width(), shown.height(), |y, out| {
            out.copy_from_slice(blurred.row(y));
            if ys.contains(&y) {
                out[xs.clone()].copy_from_slice(&shown.row(y)[xs.clone()]);
            }
        })
    }
}
