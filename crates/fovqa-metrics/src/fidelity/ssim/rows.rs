//! Computes one row of the SSIM map from the rows around it.

use fovqa_frame::{PairTile, Part};
use multiversion::multiversion;

/// The number of windowed parts of a pair: u and v.
const PARTS: usize = 2;

/// Radius of the standard window, for which the taps are unrolled.
const STANDARD_RADIUS: usize = 5;

/// C1, C2 and the window for a signal of a given peak.
#[derive(Debug, Clone)]
pub(crate) struct Constants {
    pub(crate) c1: f32,
    pub(crate) c2: f32,
    pub(crate) peak: f32,
    pub(crate) taps: Vec<f32>,
}

impl Constants {
    pub(crate) fn new(params: &super::Params, peak: f32) -> Self {
        let squared = |k: f64| {
            let k = k * f64::from(peak);
            (k * k) as f32
        };
        Self { c1: squared(params.k1), c2: squared(params.k2), peak, taps: params.taps() }
    }

    pub(crate) fn radius(&self) -> usize {
        self.taps.len() - 1
    }
}

/// Mean and variance in the window of each pixel of a row.
#[derive(Debug)]
struct Moments {
    mean: Vec<f32>,
    variance: Vec<f32>,
}

impl Moments {
    fn new(columns: usize) -> Self {
        Self { mean: vec![0.0; columns], variance: vec![0.0; columns] }
    }
}

/// Buffers for the steps of one row: moments along the columns, and in the whole window.
#[derive(Debug)]
pub(crate) struct Scratch {
    columns: Moments,
    windows: [Moments; PARTS],
}

impl Scratch {
    pub(crate) fn new(columns: usize) -> Self {
        let row = || Moments::new(columns);
        Self { columns: row(), windows: [row(), row()] }
    }
}

/// A row of the map: SSIM, and its contrast-structure factor.
#[derive(Debug)]
pub(crate) struct MapRow<'a> {
    pub(crate) ssim: &'a mut [f32],
    pub(crate) contrast_structure: &'a mut [f32],
}

/// Computes the row of the map around row `row` of a tile for one plane. The tile's rows are
/// `2 radius` longer than the map's, and the tile has `radius` more rows above and below.
pub(crate) fn map_row(
    tile: &PairTile,
    plane: usize,
    row: usize,
    constants: &Constants,
    scratch: &mut Scratch,
    out: &mut MapRow<'_>,
) {
    let n = out.ssim.len();
    let length = n + 2 * constants.radius();
    let Scratch { columns, windows } = scratch;
    for (part, window) in [Part::Sum, Part::Difference].into_iter().zip(windows.iter_mut()) {
        let mean = &mut columns.mean[..length];
        let variance = &mut columns.variance[..length];
        let at = |row: usize| tile.row(plane, part, row, length);
        let standard: Option<[f32; 6]> = constants.taps.as_slice().try_into().ok();
        if let Some(taps) = standard {
            let rows = std::array::from_fn(|k| at(row + k - STANDARD_RADIUS));
            vertical_standard(rows, taps, mean, variance);
        } else {
            vertical(at, row, &constants.taps, mean, variance);
        }
        let (window_mean, window_variance) = (&mut window.mean[..n], &mut window.variance[..n]);
        if let Some(taps) = standard {
            horizontal_standard(mean, variance, taps, window_mean, window_variance);
        } else {
            horizontal(mean, variance, &constants.taps, window_mean, window_variance);
        }
    }
    let [u, v] = windows;
    let moments = [&u.mean, &u.variance, &v.mean, &v.variance].map(|moment| &moment[..n]);
    quotients(
        moments,
        constants.c1,
        constants.c2,
        constants.peak,
        out.ssim,
        out.contrast_structure,
    );
}

/// Applies the window along the columns.
///
/// It sums squares of deviations from the pixel in the middle instead of squares of values. Where
/// the window is flat these are exactly 0, and where it is nearly flat the variance keeps its
/// digits. Σ w v² - (Σ w v)² would have the rounding error of v², which is as large as C2 divided
/// by 10⁴.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn vertical_standard(rows: [&[f32]; 11], taps: [f32; 6], mean: &mut [f32], variance: &mut [f32]) {
    let n = mean.len();
    let variance = &mut variance[..n];
    let [r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10] = rows;
    let (r0, r1, r2, r3, r4, r5) = (&r0[..n], &r1[..n], &r2[..n], &r3[..n], &r4[..n], &r5[..n]);
    let (r6, r7, r8, r9, r10) = (&r6[..n], &r7[..n], &r8[..n], &r9[..n], &r10[..n]);
    for x in 0..n {
        let middle = r5[x];
        let (mut sum, mut square) = (0.0, 0.0);
        let pairs =
            [(r4[x], r6[x]), (r3[x], r7[x]), (r2[x], r8[x]), (r1[x], r9[x]), (r0[x], r10[x])];
        for (k, (above, below)) in pairs.into_iter().enumerate() {
            let (above, below) = (above - middle, below - middle);
            sum += taps[k + 1] * (above + below);
            square += taps[k + 1] * (above * above + below * below);
        }
        mean[x] = middle + sum;
        variance[x] = square - sum * sum;
    }
}

/// Applies the window along a row of column moments. The variance is the mean of the columns'
/// variances plus the variance of their means, again computed from deviations from the middle.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn horizontal_standard(
    means: &[f32],
    variances: &[f32],
    taps: [f32; 6],
    // These are separate slices, because only then does the compiler know that they do not overlap,
    // and vectorises.
    mean: &mut [f32],
    variance: &mut [f32],
) {
    let n = mean.len();
    let variance = &mut variance[..n];
    // Shifted views of the row, one per position in the window, so that the loop below runs over
    // columns.
    let (m, v) = (|k: usize| &means[k..][..n], |k: usize| &variances[k..][..n]);
    let m = [m(0), m(1), m(2), m(3), m(4), m(5), m(6), m(7), m(8), m(9), m(10)];
    let v = [v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), v(8), v(9), v(10)];
    for x in 0..n {
        let middle = m[STANDARD_RADIUS][x];
        let (mut sum, mut square) = (0.0, taps[0] * v[STANDARD_RADIUS][x]);
        for k in 0..STANDARD_RADIUS {
            let (from, to) = (STANDARD_RADIUS - 1 - k, STANDARD_RADIUS + 1 + k);
            let (left, right) = (m[from][x] - middle, m[to][x] - middle);
            sum += taps[k + 1] * (left + right);
            square += taps[k + 1] * ((left * left + v[from][x]) + (right * right + v[to][x]));
        }
        mean[x] = middle + sum;
        variance[x] = square - sum * sum;
    }
}

/// [`vertical_standard`] for any radius.
fn vertical<'a>(
    at: impl Fn(usize) -> &'a [f32],
    row: usize,
    taps: &[f32],
    mean: &mut [f32],
    variance: &mut [f32],
) {
    mean.fill(0.0);
    variance.fill(0.0);
    let middle = at(row);
    for (k, tap) in taps.iter().enumerate().skip(1) {
        let rows = at(row - k).iter().zip(at(row + k)).zip(middle);
        for ((sum, square), ((above, below), middle)) in
            mean.iter_mut().zip(variance.iter_mut()).zip(rows)
        {
            let (above, below) = (above - middle, below - middle);
            *sum += tap * (above + below);
            *square += tap * (above * above + below * below);
        }
    }
    for ((sum, square), middle) in mean.iter_mut().zip(variance).zip(middle) {
        *square -= *sum * *sum;
        *sum += middle;
    }
}

/// [`horizontal_standard`] for any radius.
fn horizontal(m: &[f32], v: &[f32], taps: &[f32], mean: &mut [f32], variance: &mut [f32]) {
    let radius = taps.len() - 1;
    for (x, (mean, variance)) in mean.iter_mut().zip(variance).enumerate() {
        let at = x + radius;
        let (mut sum, mut square) = (0.0, taps[0] * v[at]);
        for (k, tap) in taps.iter().enumerate().skip(1) {
            let (left, right) = (m[at - k] - m[at], m[at + k] - m[at]);
            sum += tap * (left + right);
            square += tap * ((left * left + v[at - k]) + (right * right + v[at + k]));
        }
        *mean = m[at] + sum;
        *variance = square - sum * sum;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn quotients(
    moments: [&[f32]; 2 * PARTS],
    c1: f32,
    c2: f32,
    peak: f32,
    ssim: &mut [f32],
    contrast_structure: &mut [f32],
) {
    let n = ssim.len();
    let [u, var_u, v, var_v] = moments.map(|m| &m[..n]);
    let contrast_structure = &mut contrast_structure[..n];
    for x in 0..n {
        let (mean_u, mean_v) = (u[x] + peak, v[x]);
        let (mean_uu, mean_vv) = (mean_u * mean_u, mean_v * mean_v);
        let (var_u, var_v) = (var_u[x], var_v[x]);
        let luminance = (0.5 * (mean_uu - mean_vv) + c1) / (0.5 * (mean_uu + mean_vv) + c1);
        let structure = (0.5 * (var_u - var_v) + c2) / (0.5 * (var_u + var_v) + c2);
        contrast_structure[x] = structure;
        ssim[x] = luminance * structure;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::ssim::Params;

    /// The window of any radius and the unrolled one are bit-identical.
    #[test]
    fn the_unrolled_window_is_the_general_one() {
        const WIDTH: usize = 47;
        let rows: [Vec<f32>; 11] = std::array::from_fn(|y| {
            (0..WIDTH).map(|x| ((x * 37 + y * 101) % 97) as f32 / 97.0 - 0.5).collect()
        });
        let taps = Params::default().taps();
        let six: [f32; 6] = taps.clone().try_into().unwrap();
        let buffers = |n: usize| [vec![0.0; n], vec![0.0; n]];
        let [mut mean, mut variance] = buffers(WIDTH);
        vertical(|row| &rows[row], 5, &taps, &mut mean, &mut variance);
        let [mut unrolled_mean, mut unrolled_variance] = buffers(WIDTH);
        let rows = rows.each_ref().map(Vec::as_slice);
        vertical_standard(rows, six, &mut unrolled_mean, &mut unrolled_variance);
        assert_eq!((&mean, &variance), (&unrolled_mean, &unrolled_variance));
        let (mut general, mut unrolled) = (buffers(WIDTH - 10), buffers(WIDTH - 10));
        let [general_mean, general_variance] = &mut general;
        horizontal(&mean, &variance, &taps, general_mean, general_variance);
        let [unrolled_mean, unrolled_variance] = &mut unrolled;
        horizontal_standard(&mean, &variance, six, unrolled_mean, unrolled_variance);
        assert_eq!(general, unrolled);
    }

    #[test]
    fn the_window_adds_up_to_one() {
        for sigma in [0.3, 1.5, 4.0] {
            let taps = Params { sigma, ..Params::default() }.taps();
            let total = taps[0] + 2.0 * taps[1..].iter().sum::<f32>();
            assert!((total - 1.0).abs() < 1e-6);
        }
        assert_eq!(Params::default().window_side(), 11);
    }
}
