//! One row of the SSIM map from the rows around it.

use fovqa_frame::{PairTile, Part};
use multiversion::multiversion;

/// Moments that are windowed: u, u², v, v².
const MOMENTS: usize = 4;

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

/// Room for the steps of one row.
#[derive(Debug)]
pub(crate) struct Scratch {
    columns: [Vec<f32>; MOMENTS],
    moments: [Vec<f32>; MOMENTS],
}

impl Scratch {
    pub(crate) fn new(columns: usize) -> Self {
        let rows = || std::array::from_fn(|_| vec![0.0; columns]);
        Self { columns: rows(), moments: rows() }
    }
}

/// A row of the map: SSIM, and its contrast-structure factor.
#[derive(Debug)]
pub(crate) struct MapRow<'a> {
    pub(crate) ssim: &'a mut [f32],
    pub(crate) contrast_structure: &'a mut [f32],
}

/// Computes the row of the map around row `row` of a tile for one plane. The tile's rows are
/// `2 radius` longer than the map's, and it has `radius` more above and below.
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
    let Scratch { columns, moments } = scratch;
    let (sums, differences) = columns.split_at_mut(2);
    for (part, columns) in [(Part::Sum, sums), (Part::Difference, differences)] {
        let [values, squares] = columns else { unreachable!("two moments a part") };
        let (values, squares) = (&mut values[..length], &mut squares[..length]);
        let at = |row: usize| tile.row(plane, part, row, length);
        if let &[c0, c1, c2, c3, c4, c5] = constants.taps.as_slice() {
            let rows = std::array::from_fn(|k| at(row + k - STANDARD_RADIUS));
            vertical_standard(rows, [c0, c1, c2, c3, c4, c5], values, squares);
        } else {
            vertical(at, row, &constants.taps, values, squares);
        }
    }
    for (columns, moment) in columns.iter().zip(moments.iter_mut()) {
        let (columns, moment) = (&columns[..length], &mut moment[..n]);
        if let &[c0, c1, c2, c3, c4, c5] = constants.taps.as_slice() {
            horizontal_standard(columns, [c0, c1, c2, c3, c4, c5], moment);
        } else {
            horizontal(columns, &constants.taps, moment);
        }
    }
    let moments = moments.each_ref().map(|m| &m[..n]);
    quotients(
        moments,
        constants.c1,
        constants.c2,
        constants.peak,
        out.ssim,
        out.contrast_structure,
    );
}

/// The window down the columns: of the values, and of their squares, which cost less to compute
/// again than to keep.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn vertical_standard(rows: [&[f32]; 11], taps: [f32; 6], values: &mut [f32], squares: &mut [f32]) {
    let n = values.len();
    let squares = &mut squares[..n];
    let [r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10] = rows;
    let (r0, r1, r2, r3, r4, r5) = (&r0[..n], &r1[..n], &r2[..n], &r3[..n], &r4[..n], &r5[..n]);
    let (r6, r7, r8, r9, r10) = (&r6[..n], &r7[..n], &r8[..n], &r9[..n], &r10[..n]);
    for x in 0..n {
        let (mut sum, mut square) = (taps[0] * r5[x], taps[0] * (r5[x] * r5[x]));
        let pairs =
            [(r4[x], r6[x]), (r3[x], r7[x]), (r2[x], r8[x]), (r1[x], r9[x]), (r0[x], r10[x])];
        for (k, (above, below)) in pairs.into_iter().enumerate() {
            sum += taps[k + 1] * (above + below);
            square += taps[k + 1] * (above * above + below * below);
        }
        values[x] = sum;
        squares[x] = square;
    }
}

/// The window along a row: sixteen values at a time from the 26 they look at, which stay in
/// registers. Wider vectors gain nothing here: every other load would straddle two cache lines.
#[multiversion(targets("x86_64+avx2"))]
fn horizontal_standard(row: &[f32], taps: [f32; 6], out: &mut [f32]) {
    const AT_ONCE: usize = 16;
    const READ: usize = AT_ONCE + 2 * STANDARD_RADIUS;
    let (chunks, rest) = out.as_chunks_mut::<AT_ONCE>();
    for (i, out) in chunks.iter_mut().enumerate() {
        let Some(window) = row[i * AT_ONCE..].first_chunk::<READ>() else { return };
        let mut sums = [0.0f32; AT_ONCE];
        for (x, sum) in sums.iter_mut().enumerate() {
            *sum = taps[0] * window[x + STANDARD_RADIUS];
        }
        for (k, tap) in taps.iter().enumerate().skip(1) {
            for (x, sum) in sums.iter_mut().enumerate() {
                let at = x + STANDARD_RADIUS;
                *sum += tap * (window[at - k] + window[at + k]);
            }
        }
        *out = sums;
    }
    horizontal(&row[chunks.len() * AT_ONCE..], &taps, rest);
}

/// [`vertical_standard`] for any radius.
fn vertical<'a>(
    at: impl Fn(usize) -> &'a [f32],
    row: usize,
    taps: &[f32],
    values: &mut [f32],
    squares: &mut [f32],
) {
    for ((value, square), v) in values.iter_mut().zip(squares.iter_mut()).zip(at(row)) {
        *value = taps[0] * v;
        *square = taps[0] * (v * v);
    }
    for (k, tap) in taps.iter().enumerate().skip(1) {
        let pairs = at(row - k).iter().zip(at(row + k));
        for ((value, square), (a, b)) in values.iter_mut().zip(squares.iter_mut()).zip(pairs) {
            *value += tap * (a + b);
            *square += tap * (a * a + b * b);
        }
    }
}

/// [`horizontal_standard`] for any radius.
fn horizontal(row: &[f32], taps: &[f32], out: &mut [f32]) {
    let radius = taps.len() - 1;
    for (x, out) in out.iter_mut().enumerate() {
        let at = x + radius;
        *out = taps[0] * row[at];
        for (k, tap) in taps.iter().enumerate().skip(1) {
            *out += tap * (row[at - k] + row[at + k]);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn quotients(
    moments: [&[f32]; MOMENTS],
    c1: f32,
    c2: f32,
    peak: f32,
    ssim: &mut [f32],
    contrast_structure: &mut [f32],
) {
    let n = ssim.len();
    let [u, uu, v, vv] = moments.map(|m| &m[..n]);
    let contrast_structure = &mut contrast_structure[..n];
    for x in 0..n {
        let (mean_u, mean_v) = (u[x] + peak, v[x]);
        let (mean_uu, mean_vv) = (mean_u * mean_u, mean_v * mean_v);
        let (var_u, var_v) = (uu[x] - u[x] * u[x], vv[x] - mean_vv);
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

    /// The window of any radius and the unrolled one give the same bits.
    #[test]
    fn the_unrolled_window_is_the_general_one() {
        const WIDTH: usize = 47;
        let rows: [Vec<f32>; 11] = std::array::from_fn(|y| {
            (0..WIDTH).map(|x| ((x * 37 + y * 101) % 97) as f32 / 97.0 - 0.5).collect()
        });
        let taps = Params::default().taps();
        let six: [f32; 6] = taps.clone().try_into().unwrap();
        let buffer = || vec![0.0; WIDTH];
        let (mut values, mut squares) = (buffer(), buffer());
        vertical(|row| &rows[row], 5, &taps, &mut values, &mut squares);
        let (mut unrolled_values, mut unrolled_squares) = (buffer(), buffer());
        let rows = rows.each_ref().map(Vec::as_slice);
        vertical_standard(rows, six, &mut unrolled_values, &mut unrolled_squares);
        assert_eq!((&values, &squares), (&unrolled_values, &unrolled_squares));
        let (mut general, mut unrolled) = (vec![0.0; WIDTH - 10], vec![0.0; WIDTH - 10]);
        horizontal(&values, &taps, &mut general);
        horizontal_standard(&values, six, &mut unrolled);
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
