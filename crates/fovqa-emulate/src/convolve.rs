//! Gaussian convolution of one strip of an image: 64 columns, from top to bottom.
//!
//! Weights exp(-d² / 2σ²) for whole d up to floor(4σ), normalised, along x and then along y; edges are
//! clamped. Strips are independent of each other, and each is worked on by one thread.

use std::ops::Range;

use multiversion::multiversion;

use crate::image::Image;

/// Columns of a strip, and rows of its tiles.
pub(crate) const TILE: usize = 64;
/// Values that are summed side by side in registers. A row of a strip is a multiple of it.
const LANES: usize = 32;

/// Weights of a Gaussian.
#[derive(Debug, Clone)]
pub(crate) struct Kernel {
    weights: Vec<f32>,
    radius: usize,
}

impl Kernel {
    /// Of a width in pixels.
    pub(crate) fn new(sigma_px: f64) -> Self {
        let radius = (4.0 * sigma_px).floor() as usize;
        let weight = |d: f64| libm::exp(-d * d / (2.0 * sigma_px * sigma_px));
        let weights: Vec<f64> =
            (0..=2 * radius).map(|i| weight(i as f64 - radius as f64)).collect();
        let total: f64 = weights.iter().sum();
        Self { weights: weights.iter().map(|w| (w / total) as f32).collect(), radius }
    }
}

/// Room for the strip, convolved along x alone.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    along: Vec<f32>,
    padded: Vec<f32>,
}

/// How many strips an image of a width has.
pub(crate) fn strips(width: usize) -> usize {
    width.div_ceil(TILE)
}

/// Convolves the rows `rows` of a strip into `out`, rows of [`TILE`] pixels each. Behind the right edge
/// of the image its last pixel goes on.
pub(crate) fn convolve<const C: usize>(
    image: &Image<C>,
    strip: usize,
    rows: Range<usize>,
    kernel: &Kernel,
    scratch: &mut Scratch,
    out: &mut [f32],
) {
    let (width, height, radius) = (image.width(), image.height(), kernel.radius);
    let stride = TILE * C;
    let needed = rows.start.saturating_sub(radius)..(rows.end + radius).min(height);
    let (first, last) = (strip * TILE, width - 1);
    scratch.along.resize(needed.len() * stride, 0.0);
    for (y, along) in needed.clone().zip(scratch.along.chunks_exact_mut(stride)) {
        let row = image.row(y);
        scratch.padded.clear();
        // The pixels of the row, and its ends as often as the kernel reaches beyond them.
        let (from, to) = (first.saturating_sub(radius), (first + TILE + radius).min(width));
        for _ in first..radius {
            scratch.padded.extend(row[0]);
        }
        scratch.padded.extend(row[from..to].as_flattened());
        for _ in to..first + TILE + radius {
            scratch.padded.extend(row[last]);
        }
        across(along, &kernel.weights, &scratch.padded, C);
    }
    for (y, out) in rows.zip(out.chunks_exact_mut(stride)) {
        let top = y as isize - radius as isize - needed.start as isize;
        down(out, &kernel.weights, &scratch.along, top);
    }
}

/// Each value is the weighted sum of those `step` apart, the first of them at its own place.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn across(out: &mut [f32], weights: &[f32], source: &[f32], step: usize) {
    weigh(out, weights, source, |d| d * step);
}

/// The same with rows as long as `out`, the first at `top`, clamped to those there are.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn down(out: &mut [f32], weights: &[f32], source: &[f32], top: isize) {
    let stride = out.len();
    let last = (source.len() / stride) as isize - 1;
    weigh(out, weights, source, |d| (top + d as isize).clamp(0, last) as usize * stride);
}

#[inline(always)]
fn weigh(out: &mut [f32], weights: &[f32], source: &[f32], place: impl Fn(usize) -> usize) {
    for (i, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let mut sums = [0.0f32; LANES];
        for (d, weight) in weights.iter().enumerate() {
            let from = place(d) + i * LANES;
            let values: &[f32] = &source[from..from + LANES];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        *out = sums;
    }
}
