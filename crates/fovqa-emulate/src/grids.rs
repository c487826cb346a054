//! Grids of coarser and coarser samples, read bilinearly and blended linearly.
//!
//! Level l has ceil(W / 2^l) x ceil(H / 2^l) samples at ((i + 0.5) 2^l, (k + 0.5) 2^l); level 0 is the
//! image. A pixel reads level l at (x, y) / 2^l, and blends levels floor(j) and floor(j) + 1 by
//! j - floor(j).

use std::ops::Range;

use crate::fetch::lerp;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::Radial;
use crate::sample_places::{SamplePlaces, pixel_positions};
use crate::separable::{Axis, Separable};
use crate::source::Source;
use crate::value::Value;

/// Pixels of a row that are looked at together: they read few levels.
const SEGMENT: usize = 64;

/// Grids over a frame, and which of them a pixel reads.
#[derive(Debug)]
pub(crate) struct Grids {
    /// From level 1 on.
    levels: Vec<Separable>,
    /// j, by the distance from the gaze.
    level: Radial,
    offsets: Offsets,
    /// Of all levels, level 0 too.
    places: SamplePlaces,
}

impl Grids {
    /// `level` is j, at least 0.
    pub(crate) fn new(level: Radial, offsets: Offsets, places: SamplePlaces) -> Self {
        let levels = (1..=level.largest().ceil() as i32).map(|l| {
            let step = libm::exp2(f64::from(l));
            let axis = |axis: usize, side: usize| {
                let n = (side as f64 / step).ceil() as usize;
                Axis::new(n, side, places.axis(axis), |b| b * step, |x| x / step)
            };
            Separable::new(axis(0, offsets.width()), axis(1, offsets.height()), places)
        });
        Self { levels: levels.collect(), level, offsets, places }
    }

    /// Where samples of all levels stand, the finest first, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let pixels = pixel_positions(self.places, [self.offsets.width(), self.offsets.height()]);
        pixels.chain(self.levels.iter().flat_map(Separable::positions))
    }

    /// The pixels of the frame, as seen from the gaze.
    pub(crate) fn offsets(&self) -> &Offsets {
        &self.offsets
    }

    /// The frame as seen through the grids.
    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        let grids: Vec<Image<4>> =
            self.levels.iter().map(|level| source.sample_grid(level)).collect();
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let room = || (Vec::new(), [[0.0; C]; SEGMENT], [0.0f32; SEGMENT]);
        Image::by_rows_with(width, height, room, |(scratch, coarser, levels), y, row| {
            let mut read = |l: usize, xs: Range<usize>, out: &mut [[f32; C]]| match l.checked_sub(1)
            {
                None => source.sample_pixels(self.places, y, xs, out),
                Some(l) => self.levels[l].read_row(&grids[l], y, xs, scratch, out),
            };
            for (segment, out) in row.chunks_mut(SEGMENT).enumerate() {
                let xs = segment * SEGMENT..segment * SEGMENT + out.len();
                let levels = &mut levels[..out.len()];
                for (j, square) in levels.iter_mut().zip(self.offsets.squares(y, xs.clone())) {
                    *j = self.level.at(square).max(0.0);
                }
                let least = levels.iter().copied().fold(f32::INFINITY, f32::min);
                let largest = levels.iter().copied().fold(0.0, f32::max);
                let finest = (least as usize).min(grids.len());
                read(finest, xs.clone(), out);
                for l in finest + 1..=(largest.ceil() as usize).min(grids.len()) {
                    let coarser = &mut coarser[..out.len()];
                    read(l, xs.clone(), coarser);
                    for ((out, coarser), j) in out.iter_mut().zip(coarser).zip(&*levels) {
                        *out = lerp(*out, *coarser, (j - (l - 1) as f32).clamp(0.0, 1.0));
                    }
                }
            }
        })
    }
}
