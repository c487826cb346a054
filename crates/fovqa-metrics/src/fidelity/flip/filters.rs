//! Filters a tile of a picture: contrast sensitivity of the opponent channels, edges and points.
//!
//! All kernels are separable. Rows are filtered across as they come, and the last of them are kept; from
//! these, rows are filtered down. Beyond the picture, its border pixels are repeated.

use std::ops::Range;

use multiversion::multiversion;

use super::colour::{Colours, Filtered, to_opponents};
use super::kernels::Kernels;

/// The number of values that are computed at a time: a vector of the widest kind.
pub(super) const LANES: usize = 16;

/// The planes of a row that is filtered across: the achromatic and the red-green channel, the two parts of
/// the blue-yellow one, and the achromatic channel with the Gaussian and its two derivatives.
const PLANES: usize = 7;
const Y: usize = 0;
const CX: usize = 1;
const CZ: usize = 2;
const GAUSSIAN: usize = 4;
const EDGE: usize = 5;
const POINT: usize = 6;

/// All planes of some pixels.
type Pixels = [[f32; LANES]; PLANES];

/// The last rows of a picture, filtered across, within a tile of columns.
#[derive(Debug)]
pub(super) struct Filter<'a> {
    kernels: &'a Kernels,
    colours: &'a Colours,
    /// The opponent channels of a row, with as many values beyond its ends as the kernels reach.
    row: [Vec<f32>; 3],
    /// For each kept row, all planes of [`LANES`] pixels after another.
    kept: Vec<Pixels>,
    /// The length of a kept row, in groups of [`LANES`] pixels.
    stride: usize,
    filtered: Filtered,
    /// Where the rows above and below begin, from the nearest to the farthest.
    above: Vec<usize>,
    below: Vec<usize>,
}

impl<'a> Filter<'a> {
    /// A filter for tiles of up to `columns` columns.
    pub(super) fn new(kernels: &'a Kernels, colours: &'a Colours, columns: usize) -> Self {
        let (radius, stride) = (kernels.radius(), columns.div_ceil(LANES));
        Self {
            kernels,
            colours,
            row: std::array::from_fn(|_| vec![0.0; stride * LANES + 2 * radius]),
            kept: vec![[[0.0; LANES]; PLANES]; (2 * radius + 1) * stride],
            stride,
            filtered: Filtered::new(stride * LANES),
            above: vec![0; radius],
            below: vec![0; radius],
        }
    }

    /// Where row `y` begins.
    fn start(&self, y: usize) -> usize {
        y % (2 * self.kernels.radius() + 1) * self.stride
    }

    /// Takes the linear red, green and blue of row `y`. They begin in column `from`, and the tile has the
    /// columns `xs`; only the border of the picture may be nearer than the kernels reach.
    pub(super) fn take(&mut self, y: usize, rgb: [&[f32]; 3], from: usize, xs: &Range<usize>) {
        let radius = self.kernels.radius();
        // The picture begins or ends here, where there are fewer columns.
        let first = from + radius - xs.start;
        let read = first..first + rgb[0].len();
        let end = xs.len() + 2 * radius;
        to_opponents(self.colours, rgb, self.row.each_mut().map(|row| &mut row[read.clone()]));
        for row in &mut self.row {
            let (left, right) = (row[read.start], row[read.end - 1]);
            row[..read.start].fill(left);
            row[read.end..end].fill(right);
        }
        let start = self.start(y);
        let kept = &mut self.kept[start..start + xs.len().div_ceil(LANES)];
        let [y, cx, cz] = &self.row;
        achromatic_across(self.kernels, y, kept);
        red_green_across(self.kernels, cx, kept);
        blue_yellow_across(self.kernels, cz, kept);
    }

    /// Filters row `y` of a picture of a height down. All rows within reach must have been taken, the
    /// farthest one last.
    pub(super) fn filter(&mut self, y: usize, height: usize, columns: usize) -> &Filtered {
        for k in 1..=self.kernels.radius() {
            self.above[k - 1] = self.start(y.saturating_sub(k));
            self.below[k - 1] = self.start((y + k).min(height - 1));
        }
        let rows = Rows {
            kept: &self.kept,
            centre: self.start(y),
            above: &self.above,
            below: &self.below,
        };
        down(self.kernels, &rows, &mut self.filtered, columns);
        &self.filtered
    }
}

/// The sums, and the differences, of two vectors.
#[inline(always)]
fn sum(a: &[f32; LANES], b: &[f32; LANES]) -> [f32; LANES] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[inline(always)]
fn difference(a: &[f32; LANES], b: &[f32; LANES]) -> [f32; LANES] {
    std::array::from_fn(|i| b[i] - a[i])
}

/// How far two values are above the one between them. The second derivative is computed from these, so that it is
/// exactly 0 where nothing changes.
#[inline(always)]
fn bend(sum: &[f32; LANES], centre: &[f32; LANES]) -> [f32; LANES] {
    std::array::from_fn(|i| sum[i] - (centre[i] + centre[i]))
}

#[inline(always)]
fn times(values: &[f32; LANES], weight: f32) -> [f32; LANES] {
    std::array::from_fn(|i| values[i] * weight)
}

/// Adds values times a weight.
#[inline(always)]
fn add(total: &mut [f32; LANES], weight: f32, values: &[f32; LANES]) {
    for i in 0..LANES {
        total[i] += weight * values[i];
    }
}

/// The values of a row from `start` on.
#[inline(always)]
fn lanes(row: &[f32], start: usize) -> &[f32; LANES] {
    row[start..].first_chunk().unwrap_or(&[0.0; LANES])
}

/// Filters the achromatic channel of a row across. The row begins as many values earlier as the kernels reach.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn achromatic_across(kernels: &Kernels, row: &[f32], kept: &mut [Pixels]) {
    let (first, taps) = (kernels.taps[0], &kernels.taps[1..]);
    let (near, far) = taps.split_at(kernels.detector_radius);
    for (vector, out) in kept.iter_mut().enumerate() {
        let around = &row[vector * LANES..][..2 * taps.len() + LANES];
        let centre = lanes(around, taps.len());
        let mut achromatic = times(centre, first.y);
        let mut gaussian = times(centre, first.gaussian);
        let mut edge = [0.0; LANES];
        let mut point = [0.0; LANES];
        let (mut left, mut right) = (taps.len(), taps.len());
        for taps in near {
            (left, right) = (left - 1, right + 1);
            let (a, b) = (lanes(around, left), lanes(around, right));
            let (sum, difference) = (sum(a, b), difference(a, b));
            add(&mut achromatic, taps.y, &sum);
            add(&mut gaussian, taps.gaussian, &sum);
            add(&mut edge, taps.edge, &difference);
            add(&mut point, taps.point, &bend(&sum, centre));
        }
        for taps in far {
            (left, right) = (left - 1, right + 1);
            add(&mut achromatic, taps.y, &sum(lanes(around, left), lanes(around, right)));
        }
        (out[Y], out[GAUSSIAN], out[EDGE], out[POINT]) = (achromatic, gaussian, edge, point);
    }
}

/// Filters the red-green channel of a row across.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn red_green_across(kernels: &Kernels, row: &[f32], kept: &mut [Pixels]) {
    let (first, taps) = (kernels.taps[0], &kernels.taps[1..]);
    for (vector, out) in kept.iter_mut().enumerate() {
        let around = &row[vector * LANES..][..2 * taps.len() + LANES];
        let (mut left, mut right) = (taps.len(), taps.len());
        let mut total = times(lanes(around, left), first.cx);
        for taps in taps {
            (left, right) = (left - 1, right + 1);
            add(&mut total, taps.cx, &sum(lanes(around, left), lanes(around, right)));
        }
        out[CX] = total;
    }
}

/// Filters the blue-yellow channel of a row across.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn blue_yellow_across(kernels: &Kernels, row: &[f32], kept: &mut [Pixels]) {
    let (first, taps) = (kernels.taps[0], &kernels.taps[1..]);
    for (vector, out) in kept.iter_mut().enumerate() {
        let around = &row[vector * LANES..][..2 * taps.len() + LANES];
        let (mut left, mut right) = (taps.len(), taps.len());
        let mut broad = times(lanes(around, left), first.cz[0]);
        let mut narrow = times(lanes(around, left), first.cz[1]);
        for taps in taps {
            (left, right) = (left - 1, right + 1);
            let sum = sum(lanes(around, left), lanes(around, right));
            add(&mut broad, taps.cz[0], &sum);
            add(&mut narrow, taps.cz[1], &sum);
        }
        (out[CZ], out[CZ + 1]) = (broad, narrow);
    }
}

/// The rows that are kept, around the one that is filtered.
struct Rows<'a> {
    kept: &'a [Pixels],
    centre: usize,
    above: &'a [usize],
    below: &'a [usize],
}

/// Filters a row down.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn down(kernels: &Kernels, rows: &Rows<'_>, out: &mut Filtered, columns: usize) {
    let near = kernels.detector_radius;
    let first = kernels.taps[0];
    for vector in 0..columns.div_ceil(LANES) {
        let centre = &rows.kept[rows.centre + vector];
        let mut achromatic = times(&centre[Y], first.y);
        let mut red_green = times(&centre[CX], first.cx);
        let mut blue_yellow = times(&centre[CZ], first.cz[0]);
        add(&mut blue_yellow, first.cz[1], &centre[CZ + 1]);
        let mut edges = [times(&centre[EDGE], first.gaussian), [0.0; LANES]];
        let mut points = [times(&centre[POINT], first.gaussian), [0.0; LANES]];
        let around = rows.above.iter().zip(rows.below).zip(&kernels.taps[1..]);
        for (k, ((&above, &below), taps)) in around.enumerate() {
            let (a, b) = (&rows.kept[above + vector], &rows.kept[below + vector]);
            let of = |plane: usize| sum(&a[plane], &b[plane]);
            add(&mut achromatic, taps.y, &of(Y));
            add(&mut red_green, taps.cx, &of(CX));
            add(&mut blue_yellow, taps.cz[0], &of(CZ));
            add(&mut blue_yellow, taps.cz[1], &of(CZ + 1));
            if k < near {
                add(&mut edges[0], taps.gaussian, &of(EDGE));
                add(&mut edges[1], taps.edge, &difference(&a[GAUSSIAN], &b[GAUSSIAN]));
                add(&mut points[0], taps.gaussian, &of(POINT));
                add(&mut points[1], taps.point, &bend(&of(GAUSSIAN), &centre[GAUSSIAN]));
            }
        }
        let x = vector * LANES;
        for (out, values) in out.opponents.iter_mut().zip([achromatic, red_green, blue_yellow]) {
            out[x..x + LANES].copy_from_slice(&values);
        }
        for (out, [across, down]) in out.features.iter_mut().zip([edges, points]) {
            let magnitude: [f32; LANES] =
                std::array::from_fn(|i| (across[i] * across[i] + down[i] * down[i]).sqrt());
            out[x..x + LANES].copy_from_slice(&magnitude);
        }
    }
}
