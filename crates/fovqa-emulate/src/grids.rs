//! Grids of coarser and coarser samples, read bilinearly and blended linearly.
//!
//! Level l has ceil(W / 2^l) x ceil(H / 2^l) samples at ((i + 0.5) 2^l, (k + 0.5) 2^l); level 0 is the
//! image. A pixel reads level l at (x, y) / 2^l, and blends levels floor(j) and floor(j) + 1 by
//! j - floor(j).

use crate::fetch::lerp;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::Radial;
use crate::sampling::Sampling;
use crate::separable::{Axis, Separable};

/// Grids over a frame, and which of them a pixel reads.
#[derive(Debug)]
pub(crate) struct Grids {
    /// From level 1 on.
    levels: Vec<Separable>,
    /// j, by the distance from the gaze.
    level: Radial,
    offsets: Offsets,
}

impl Grids {
    /// `level` is j, at least 0.
    pub(crate) fn new(level: Radial, offsets: Offsets, sampling: Sampling) -> Self {
        let levels = (1..=level.largest().ceil() as i32).map(|l| {
            let step = libm::exp2(f64::from(l));
            let axis = |side: usize| {
                let n = (side as f64 / step).ceil() as usize;
                Axis::new(n, side, sampling, |b| b * step, |x| x / step)
            };
            Separable::new(axis(offsets.width()), axis(offsets.height()), sampling)
        });
        Self { levels: levels.collect(), level, offsets }
    }

    /// The image as seen through the grids.
    pub(crate) fn show<const C: usize>(&self, image: &Image<C>) -> Image<C> {
        let levels: Vec<Image<C>> = self.levels.iter().map(|level| level.sample(image)).collect();
        Image::by_rows(image.width(), image.height(), |y, row| {
            let squares = self.offsets.squares(y, 0..row.len());
            let read = |l: usize, x: usize| match l.checked_sub(1) {
                Some(l) => self.levels[l].read_pixel(&levels[l], x, y),
                None => image.row(y)[x],
            };
            for ((x, out), square) in row.iter_mut().enumerate().zip(squares) {
                let j = self.level.at(square).max(0.0);
                let l = (j as usize).min(levels.len());
                let t = j - l as f32;
                let finer = read(l, x);
                let blended = t > 0.0 && l < levels.len();
                *out = if blended { lerp(finer, read(l + 1, x), t) } else { finer };
            }
        })
    }
}
