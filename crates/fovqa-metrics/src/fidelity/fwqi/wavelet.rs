//! The 9/7 wavelet transform of FWQI (Cohen, Daubechies, Feauveau 1992, called bior4.4), with whole-sample
//! symmetric extension: a row of n values x_0 … is mirrored without repeating its ends.
//!
//! ```text
//! low_k = Σ h_|j| x_(2k + j), |j| <= 4,   high_k = Σ g_|j| x_(2k + 1 + j), |j| <= 3,   k = 0 … n/2 - 1
//! ```

use multiversion::multiversion;
use rayon::prelude::*;

const LOW: [f64; 5] = [
    0.852_698_679_008_894,
    0.377_402_855_612_831,
    -0.110_624_404_418_437,
    -0.023_849_465_019_557,
    0.037_828_455_507_264,
];
const HIGH: [f64; 4] =
    [0.788_485_616_405_583, -0.418_092_273_221_617, -0.040_689_417_609_164, 0.064_538_882_628_697];

/// How far the low-pass filter reaches.
const REACH: isize = 4;

/// A plane of values, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    pub(super) fn height(&self) -> usize {
        self.values.len() / self.width
    }

    pub(super) fn row(&self, y: usize) -> &[f64] {
        &self.values[y * self.width..][..self.width]
    }
}

/// One level of the transform.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Level {
    /// Low in both directions: the input of the next level.
    pub(super) low: Plane,
    /// High across, high down, and high in both directions.
    pub(super) details: [Plane; 3],
}

/// Transforms a plane with even sides of at least 6 values.
pub(super) fn transform(plane: &Plane) -> Level {
    let (width, height) = (plane.width, plane.height());
    debug_assert!(width % 2 == 0 && height % 2 == 0 && width.min(height) >= 6, "whole blocks");
    // Each row has its low-pass half first, then its high-pass half.
    let mut across = vec![0.0; width * height];
    let rows = across.par_chunks_exact_mut(width).zip(plane.values.par_chunks_exact(width));
    rows.for_each_init(Halves::default, |halves, (out, row)| {
        halves.take(row);
        let (low, high) = out.split_at_mut(width / 2);
        filter_across(halves, low, high);
    });
    let half = || Plane { width: width / 2, values: vec![0.0; width * height / 4] };
    let mut level = Level { low: half(), details: [half(), half(), half()] };
    let [high_across, high_down, high_both] = &mut level.details;
    let out = level.low.values.par_chunks_exact_mut(width / 2);
    let out = out.zip(high_across.values.par_chunks_exact_mut(width / 2));
    let out = out.zip(high_down.values.par_chunks_exact_mut(width / 2));
    let out = out.zip(high_both.values.par_chunks_exact_mut(width / 2));
    out.enumerate().for_each(|(k, (((low, high_across), high_down), high_both))| {
        let row = |offset: isize| {
            let y = mirrored(2 * k as isize + offset, height);
            across[y * width..][..width].split_at(width / 2)
        };
        // From 4 rows above row 2k to 4 rows below it.
        let rows: [_; 9] = std::array::from_fn(|i| row(i as isize - REACH));
        filter_down(&rows.map(|(low, _)| low), low, high_down);
        filter_down(&rows.map(|(_, high)| high), high_across, high_both);
    });
    level
}

/// The index of a value, or of its mirror image beyond the ends.
fn mirrored(index: isize, length: usize) -> usize {
    let last = length as isize - 1;
    let inside = if index < 0 { -index } else { index };
    (if inside > last { 2 * last - inside } else { inside }) as usize
}

/// The even and the odd values of a row, with two mirrored ones beyond each end.
#[derive(Debug, Default)]
struct Halves {
    even: Vec<f64>,
    odd: Vec<f64>,
}

impl Halves {
    fn take(&mut self, row: &[f64]) {
        let half = row.len() as isize / 2;
        let at = |index: isize| row[mirrored(index, row.len())];
        self.even.clear();
        self.odd.clear();
        self.even.extend([at(-4), at(-2)]);
        self.odd.extend([at(-3), at(-1)]);
        for [even, odd] in row.as_chunks().0 {
            self.even.push(*even);
            self.odd.push(*odd);
        }
        self.even.extend([at(2 * half), at(2 * half + 2)]);
        self.odd.extend([at(2 * half + 1), at(2 * half + 3)]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn filter_across(halves: &Halves, low: &mut [f64], high: &mut [f64]) {
    let n = low.len();
    let high = &mut high[..n];
    let (e, o) = (&halves.even[..n + 4], &halves.odd[..n + 4]);
    for k in 0..n {
        // The value in place k has two before it.
        low[k] = LOW[0] * e[k + 2]
            + LOW[1] * (o[k + 1] + o[k + 2])
            + LOW[2] * (e[k + 1] + e[k + 3])
            + LOW[3] * (o[k] + o[k + 3])
            + LOW[4] * (e[k] + e[k + 4]);
        high[k] = HIGH[0] * o[k + 2]
            + HIGH[1] * (e[k + 2] + e[k + 3])
            + HIGH[2] * (o[k + 1] + o[k + 3])
            + HIGH[3] * (e[k + 1] + e[k + 4]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn filter_down(rows: &[&[f64]; 9], low: &mut [f64], high: &mut [f64]) {
    let n = low.len();
    let high = &mut high[..n];
    let [a, b, c, d, e, f, g, h, i] = rows.map(|row| &row[..n]);
    for x in 0..n {
        low[x] = LOW[0] * e[x]
            + LOW[1] * (d[x] + f[x])
            + LOW[2] * (c[x] + g[x])
            + LOW[3] * (b[x] + h[x])
            + LOW[4] * (a[x] + i[x]);
        high[x] = HIGH[0] * f[x]
            + HIGH[1] * (e[x] + g[x])
            + HIGH[2] * (d[x] + h[x])
            + HIGH[3] * (c[x] + i[x]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, along one axis.
    fn literal(x: &[f64]) -> [Vec<f64>; 2] {
        let filter = |taps: &[f64], first: isize| -> Vec<f64> {
            let reach = taps.len() as isize - 1;
            let at = |k: isize| -> f64 {
                let tap =
                    |j: isize| taps[j.unsigned_abs()] * x[mirrored(2 * k + first + j, x.len())];
                (-reach..=reach).map(tap).sum()
            };
            (0..x.len() as isize / 2).map(at).collect()
        };
        [filter(&LOW, 0), filter(&HIGH, 1)]
    }

    #[test]
    fn both_directions_are_the_definition() {
        let (width, height) = (14, 10);
        let values = (0..width * height).map(|i| ((i * 7919) % 1009) as f64 / 1009.0).collect();
        let plane = Plane { width, values };
        let found = transform(&plane);
        let rows: Vec<[Vec<f64>; 2]> = (0..height).map(|y| literal(plane.row(y))).collect();
        let all = [&found.low, &found.details[0], &found.details[1], &found.details[2]];
        for (index, found) in all.into_iter().enumerate() {
            let (across, down) = (index % 2, index / 2);
            assert_eq!((found.width, found.height()), (width / 2, height / 2));
            for x in 0..width / 2 {
                let column: Vec<f64> = rows.iter().map(|row| row[across][x]).collect();
                for (y, wanted) in literal(&column)[down].iter().enumerate() {
                    let value = found.row(y)[x];
                    assert!(
                        (value - wanted).abs() < 1e-13,
                        "{index} {x},{y}: {value} for {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn flat_rows_have_no_details_and_grow_by_the_root_of_two() {
        let [low, high] = literal(&[1.0; 12]);
        assert!(low.iter().all(|v| (v - 2f64.sqrt()).abs() < 1e-11), "{low:?}");
        assert!(high.iter().all(|v| v.abs() < 1e-11), "{high:?}");
    }
}
