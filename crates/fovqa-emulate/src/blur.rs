//! Blur of a width that changes with the distance from the gaze.
//!
//! A stack of Gaussians of fixed widths σ = 0 (the image), 0.5, 0.5 √2, 1, … = 0.5 · 2^(m/2); between
//! neighbours a < s ≤ b the pixel is (1 - w) A + w B, w = (s² - a²) / (b² - a²): linear in the variance.
//! Of each level only the tiles that need it are computed.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use crate::convolve::{Kernel, STRIP, Scratch, convolve, strips};
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::Radial;

/// Rows of a strip that are looked at together: they need few levels.
const TILE_ROWS: usize = 64;

/// The image convolved with one Gaussian of a width in pixels, edges clamped.
pub(crate) fn gaussian<const C: usize>(image: &Image<C>, sigma_px: f64) -> Image<C> {
    let kernel = Kernel::new(sigma_px);
    let strip = |strip: usize| {
        let mut out = vec![0.0; image.height() * STRIP * C];
        convolve(image, strip, 0..image.height(), &kernel, &mut Scratch::default(), &mut out);
        out
    };
    let strips: Vec<_> = (0..strips(image.width())).into_par_iter().map(strip).collect();
    assemble(image, &strips)
}

/// A blur whose width is a function of the distance from the gaze.
#[derive(Debug)]
pub(crate) struct Blur {
    width_px: Radial,
    /// σ² of the levels, the first 0.
    variances: Vec<f32>,
    /// Of the levels from the second on.
    kernels: Vec<Kernel>,
}

impl Blur {
    /// A blur of a width in pixels; widths below 0 count as 0.
    pub(crate) fn new(width_px: Radial) -> Self {
        let (mut variances, mut kernels) = (vec![0.0], Vec::new());
        let largest = f64::from(width_px.largest());
        let mut sigma_px = 0.0;
        for m in 0.. {
            if sigma_px >= largest {
                break;
            }
            sigma_px = 0.5 * libm::exp2(f64::from(m) / 2.0);
            variances.push((sigma_px * sigma_px) as f32);
            kernels.push(Kernel::new(sigma_px));
        }
        Self { width_px, variances, kernels }
    }

    /// The image, blurred.
    pub(crate) fn apply<const C: usize>(&self, image: &Image<C>, offsets: &Offsets) -> Image<C> {
        let strip = |strip: usize| self.strip(image, offsets, strip);
        let strips: Vec<_> = (0..strips(image.width())).into_par_iter().map(strip).collect();
        assemble(image, &strips)
    }

    fn strip<const C: usize>(&self, image: &Image<C>, offsets: &Offsets, strip: usize) -> Vec<f32> {
        let stride = STRIP * C;
        let (height, width) = (image.height(), image.width());
        let xs = strip * STRIP..((strip + 1) * STRIP).min(width);
        let mut variances = vec![0.0f32; height * STRIP];
        let mut out = vec![0.0f32; height * stride];
        for (y, row) in variances.chunks_exact_mut(STRIP).enumerate() {
            for (variance, square) in row.iter_mut().zip(offsets.squares(y, xs.clone())) {
                let s = self.width_px.at(square).max(0.0);
                *variance = s * s;
            }
            // Behind the edge nothing is needed that is not needed before it.
            let edge = row[xs.len() - 1];
            row[xs.len()..].fill(edge);
            let pixels = image.row(y)[xs.clone()].as_flattened();
            let out = &mut out[y * stride..][..pixels.len()];
            self.add::<C>(0, row, pixels, out);
        }
        let needed: Vec<RangeInclusive<usize>> =
            variances.chunks(TILE_ROWS * STRIP).map(|tile| self.levels_of(tile)).collect();
        let mut scratch = Scratch::default();
        let mut level = vec![0.0; height * stride];
        for index in 1..self.variances.len() {
            let tiles =
                |held: bool| move |tile: &RangeInclusive<usize>| tile.contains(&index) == held;
            let mut from = 0;
            // Runs of tiles that need the level.
            while let Some(start) = needed[from..].iter().position(tiles(true)).map(|i| from + i) {
                let end = needed[start..].iter().position(tiles(false));
                from = end.map_or(needed.len(), |i| start + i);
                let rows = start * TILE_ROWS..(from * TILE_ROWS).min(height);
                let level = &mut level[..rows.len() * stride];
                convolve(image, strip, rows.clone(), &self.kernels[index - 1], &mut scratch, level);
                for (y, values) in rows.zip(level.chunks_exact(stride)) {
                    let out = &mut out[y * stride..(y + 1) * stride];
                    self.add::<C>(index, &variances[y * STRIP..(y + 1) * STRIP], values, out);
                }
            }
        }
        out
    }

    /// The levels that the pixels of a tile need: those from below the least to above the largest.
    fn levels_of(&self, variances: &[f32]) -> RangeInclusive<usize> {
        let least = variances.iter().copied().fold(f32::INFINITY, f32::min);
        let largest = variances.iter().copied().fold(0.0, f32::max);
        let above = |variance: f32| self.variances.partition_point(|level| *level < variance);
        above(least).saturating_sub(1)..=above(largest)
    }

    /// Adds what a level contributes to pixels of some variances.
    fn add<const C: usize>(
        &self,
        level: usize,
        variances: &[f32],
        values: &[f32],
        out: &mut [f32],
    ) {
        let at = self.variances[level];
        let below = level.checked_sub(1).map(|below| self.variances[below]);
        let above = self.variances.get(level + 1).copied();
        let (values, out) = (values.as_chunks::<C>().0, out.as_chunks_mut::<C>().0);
        for ((out, value), &variance) in out.iter_mut().zip(values).zip(variances) {
            let other = if variance <= at { below } else { above };
            let weight = match other {
                // The image itself below the first level, or what rounding leaves above the last.
                None => 1.0,
                Some(other) => ((variance - other) / (at - other)).max(0.0),
            };
            if weight > 0.0 {
                *out = std::array::from_fn(|c| out[c] + weight * value[c]);
            }
        }
    }
}

/// Strips side by side.
fn assemble<const C: usize>(image: &Image<C>, strips: &[Vec<f32>]) -> Image<C> {
    let stride = STRIP * C;
    Image::by_rows(image.width(), image.height(), |y, row| {
        for (out, strip) in row.chunks_mut(STRIP).zip(strips) {
            let out = out.as_flattened_mut();
            out.copy_from_slice(&strip[y * stride..][..out.len()]);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As it is defined: each pixel by itself.
    fn literal(image: &Image<1>, sigma_px: f64, x: usize, y: usize) -> f64 {
        let radius = (4.0 * sigma_px).floor() as isize;
        let weight = |d: isize| (-((d * d) as f64) / (2.0 * sigma_px * sigma_px)).exp();
        let clamped =
            |at: usize, d: isize, n: usize| (at as isize + d).clamp(0, n as isize - 1) as usize;
        let total: f64 = (-radius..=radius).map(weight).sum();
        let mut sum = 0.0;
        for dy in -radius..=radius {
            let row = image.row(clamped(y, dy, image.height()));
            for dx in -radius..=radius {
                let value = f64::from(row[clamped(x, dx, image.width())][0]);
                sum += weight(dx) * weight(dy) * value;
            }
        }
        sum / (total * total)
    }

    #[test]
    fn follows_the_definition() {
        let image = Image::<1>::by_rows(150, 70, |y, row| {
            for (x, out) in row.iter_mut().enumerate() {
                *out = [f32::from(u8::from(x + 2 * y > 140 || (x * 7 + y * 13) % 31 == 0))];
            }
        });
        for (sigma_px, bound) in
            [(0.5, 1e-6), (2.8, 1e-6), (10.0, 1e-6), (12.0, 1e-3), (32.0, 1e-3)]
        {
            let blurred = gaussian(&image, sigma_px);
            for (x, y) in [(0, 0), (1, 69), (60, 33), (127, 20), (128, 21), (131, 3), (149, 69)] {
                let (found, exact) = (blurred.row(y)[x][0], literal(&image, sigma_px, x, y));
                let off = (f64::from(found) - exact).abs();
                assert!(off < bound, "σ {sigma_px} at {x}, {y}: {found} for {exact}");
            }
        }
    }
}
