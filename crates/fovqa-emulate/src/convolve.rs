//! Gaussian convolution of one strip of an image: 128 columns, from top to bottom.
//!
//! Weights exp(-d² / 2σ²) for whole d up to floor(4σ), normalised, along x and then along y; edges are
//! clamped. Strips are independent of each other, and each is worked on by one thread. Wide Gaussians
//! leave nothing that changes from pixel to pixel: they are computed for every second or fourth pixel,
//! and between those linearly.

use std::ops::Range;

use multiversion::multiversion;

use crate::fetch::lerp;
use crate::image::Image;

/// Columns of a strip.
pub(crate) const STRIP: usize = 128;
/// Values that are summed side by side in registers. A row of a strip is a multiple of it.
const LANES: usize = 32;

/// Weights of a Gaussian.
#[derive(Debug, Clone)]
pub(crate) struct Kernel {
    weights: Vec<f32>,
    radius: usize,
    /// Pixels from one computed one to the next. Behind an edge from 0 to 1 the second derivative is
    /// 0.24 / σ² at most, so that chords over h pixels are off by 0.03 h² / σ²: less than 0.001.
    step: usize,
}

impl Kernel {
    /// Of a width in pixels.
    pub(crate) fn new(sigma_px: f64) -> Self {
        let radius = (4.0 * sigma_px).floor() as usize;
        let weight = |d: f64| libm::exp(-d * d / (2.0 * sigma_px * sigma_px));
        let weights: Vec<f64> =
            (0..=2 * radius).map(|i| weight(i as f64 - radius as f64)).collect();
        let total: f64 = weights.iter().sum();
        let step = match sigma_px {
            s if s < 11.0 => 1,
            s if s < 22.0 => 2,
            _ => 4,
        };
        Self { weights: weights.iter().map(|w| (w / total) as f32).collect(), radius, step }
    }
}

/// Room for what is computed on the way.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    /// A row of the image, pixels a step apart side by side.
    phases: Vec<f32>,
    /// Where the row begins for each weight.
    places: Vec<usize>,
    /// The strip, convolved along x alone.
    along: Vec<f32>,
    /// Convolved along both, where that is not every pixel.
    coarse: Vec<f32>,
    row: Vec<f32>,
}

/// How many strips an image of a width has.
pub(crate) fn strips(width: usize) -> usize {
    width.div_ceil(STRIP)
}

/// Convolves the rows `rows` of a strip into `out`, rows of [`STRIP`] pixels each. Behind the right
/// edge of the image its last pixel goes on.
pub(crate) fn convolve<const C: usize>(
    image: &Image<C>,
    strip: usize,
    rows: Range<usize>,
    kernel: &Kernel,
    scratch: &mut Scratch,
    out: &mut [f32],
) {
    let Kernel { weights, radius, step } = kernel;
    let (radius, step) = (*radius, *step);
    // One more than the strip has, to read between.
    let more = usize::from(step > 1);
    let stride = ((STRIP / step + more) * C).next_multiple_of(LANES);
    let coarse_rows = (rows.len() - 1) / step + 1 + more;
    let end = rows.start + (coarse_rows - 1) * step + 1;
    let needed = rows.start.saturating_sub(radius)..(end + radius).min(image.height());

    let phase = stride / C + 1 + weights.len() / step + 1;
    scratch.places.clear();
    scratch.places.extend((0..weights.len()).map(|d| (d % step * phase + d / step) * C));
    scratch.along.resize(needed.len() * stride, 0.0);
    let first = (strip * STRIP) as isize - radius as isize;
    for (y, along) in needed.clone().zip(scratch.along.chunks_exact_mut(stride)) {
        fill_phases(image.row(y), first, step, phase, &mut scratch.phases);
        across(along, weights, &scratch.phases, &scratch.places);
    }

    let top = rows.start as isize - radius as isize - needed.start as isize;
    if step == 1 {
        for (k, out) in out.chunks_exact_mut(stride).take(coarse_rows).enumerate() {
            down(out, weights, &scratch.along, top + k as isize);
        }
        return;
    }
    scratch.coarse.resize(coarse_rows * stride, 0.0);
    for (k, out) in scratch.coarse.chunks_exact_mut(stride).enumerate() {
        down(out, weights, &scratch.along, top + (k * step) as isize);
    }
    for (k, out) in out.chunks_exact_mut(STRIP * C).take(rows.len()).enumerate() {
        let upper = &scratch.coarse[k / step * stride..][..2 * stride];
        let t = (k % step) as f32 / step as f32;
        scratch.row.clear();
        let (upper, lower) = upper.split_at(stride);
        scratch.row.extend(upper.iter().zip(lower).map(|(a, b)| a + (b - a) * t));
        between(scratch.row.as_chunks::<C>().0, step, out.as_chunks_mut::<C>().0);
    }
}

/// The pixels of a row from `first` on, clamped to its ends: every `step`-th one, then those behind
/// them, and so on, `phase` pixels each.
fn fill_phases<const C: usize>(
    row: &[[f32; C]],
    first: isize,
    step: usize,
    phase: usize,
    phases: &mut Vec<f32>,
) {
    let last = row.len() as isize - 1;
    phases.clear();
    for p in 0..step as isize {
        let column = |k: usize| (first + p + (k * step) as isize).clamp(0, last) as usize;
        phases.extend((0..phase).flat_map(|k| row[column(k)]));
    }
}

/// Fills in pixels between those that are a step apart.
fn between<const C: usize>(coarse: &[[f32; C]], step: usize, out: &mut [[f32; C]]) {
    for (ends, out) in coarse.windows(2).zip(out.chunks_exact_mut(step)) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = lerp(ends[0], ends[1], i as f32 / step as f32);
        }
    }
}

/// Each value is the weighted sum of those behind the places of the weights.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn across(out: &mut [f32], weights: &[f32], source: &[f32], places: &[usize]) {
    weigh(out, weights, source, |d| places[d]);
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
