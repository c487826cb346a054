//! The decimated pyramid: kernel 0.05, 0.25, 0.4, 0.25, 0.05 (Burt, Adelson 1983, a = 0.4), sides
//! halved and rounded up, edges reflected with the edge sample repeated.
//!
//! FovVideoVDP selects the rule for the right edge by the parity of the rows instead of the
//! columns. Where the two parities differ, the weights of the last column of the next level sum to
//! 1.25 or 0.75. This is part of the calibrated metric; [`RightEdge::ByColumns`] is the correct
//! rule.

use multiversion::multiversion;

use super::calibration::{FIRST_BAND, LOWEST_CPD, MOST_BANDS};
use super::grid::Grid;

/// The smallest side of a frame in pixels.
pub const SMALLEST_SIDE: usize = 4;

/// The rule for the weights of the right edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RightEdge {
    /// The parity of the rows decides, as in FovVideoVDP.
    ByRows,
    /// The parity of the columns decides.
    ByColumns,
}

/// Frequencies of the bands in cycles per degree, the finest first. The smaller side of the frame
/// limits their number, and the first band at or below 0.5 cpd is the last.
pub(crate) fn band_frequencies_cpd(
    (width, height): (usize, usize),
    pixels_per_degree: f64,
) -> Vec<f64> {
    let nyquist = pixels_per_degree / 2.0;
    let cpd = |band: usize| match band {
        0 => nyquist,
        band => FIRST_BAND * nyquist / f64::from(1u32 << (band - 1)),
    };
    let fit = (width.min(height).max(1).ilog2() as usize).saturating_sub(1).max(1);
    let last = (0..MOST_BANDS).find(|band| cpd(*band) <= LOWEST_CPD).unwrap_or(fit);
    (0..(last + 1).min(fit)).map(cpd).collect()
}

/// The next level of planes of one size, with half the sides, rounded up. The sides must be at
/// least 2.
pub(crate) fn reduce(fine: &[&Grid], right_edge: RightEdge) -> Vec<Grid> {
    let Some((width, height)) = fine.first().map(|grid| grid.size()) else { return Vec::new() };
    let half = || Grid::to_fill(width.div_ceil(2), height.div_ceil(2));
    let mut coarse: Vec<Grid> = fine.iter().map(|_| half()).collect();
    let odd = match right_edge {
        RightEdge::ByRows => height % 2 == 1,
        RightEdge::ByColumns => width % 2 == 1,
    };
    let (columns, fine_stride, stride) = (coarse[0].width(), fine[0].stride(), coarse[0].stride());
    Grid::fill_blocks_of(coarse.iter_mut(), |first, blocks| {
        // There are two more columns on the left, and zeros on the right up to the last tap.
        let mut tall = vec![0.0; 2 * columns + 4 + fine_stride];
        for (fine, block) in fine.iter().zip(blocks) {
            for (index, row) in block.chunks_exact_mut(stride).enumerate() {
                let centre = 2 * (first + index) as isize;
                let taps =
                    [-2, -1, 0, 1, 2].map(|tap| fine.padded_row(reflected(centre + tap, height)));
                vertical(taps, &mut tall[2..2 + fine_stride]);
                tall[2 + width..].fill(0.0);
                (tall[0], tall[1]) = (tall[3], tall[2]);
                horizontal(&tall, &mut row[..columns]);
                let (last, before) = (tall[1 + width], tall[width]);
                row[columns - 1] += if odd { 0.25 * last + 0.05 * before } else { 0.05 * last };
                row[columns..].fill(0.0);
            }
        }
    });
    coarse
}

/// The index of a row reflected at the edge, with the edge row repeated.
fn reflected(y: isize, height: usize) -> usize {
    let last = height as isize - 1;
    let y = if y < 0 { -1 - y } else { y };
    (if y > last { 2 * last + 1 - y } else { y }) as usize
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn vertical([a, b, c, d, e]: [&[f32]; 5], out: &mut [f32]) {
    let n = out.len();
    let (a, b, c, d, e) = (&a[..n], &b[..n], &c[..n], &d[..n], &e[..n]);
    for x in 0..n {
        out[x] = 0.05 * (a[x] + e[x]) + 0.25 * (b[x] + d[x]) + 0.4 * c[x];
    }
}

/// Computes every second column; `values` begin two columns to the left.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn horizontal(values: &[f32], out: &mut [f32]) {
    let n = out.len();
    let pairs = &values.as_chunks::<2>().0[..n + 2];
    let (a, b, c) = (&pairs[..n], &pairs[1..=n], &pairs[2..n + 2]);
    for x in 0..n {
        out[x] = 0.05 * (a[x][0] + c[x][0]) + 0.25 * (a[x][1] + b[x][1]) + 0.4 * b[x][0];
    }
}

/// Expands rows to a finer level.
#[derive(Debug)]
pub(crate) struct Expander {
    /// One coarse row with additional samples before its start and after its end.
    tall: Vec<f32>,
    size: (usize, usize),
}

impl Expander {
    /// An expander for levels of a size.
    pub(crate) fn new(size: (usize, usize)) -> Self {
        let coarse = size.0.div_ceil(2);
        Self { tall: vec![0.0; coarse + 2], size }
    }

    /// Expands the coarser level to row `y` of the level below it. `out` may include the padding of
    /// the row.
    pub(crate) fn row(&mut self, coarse: &Grid, y: usize, out: &mut [f32]) {
        let (width, _) = self.size;
        let (rows, columns) = (coarse.height(), coarse.width());
        let j = y / 2;
        let tall = &mut self.tall[1..=columns];
        let row = |j: usize| coarse.row(j.min(rows - 1));
        if y.is_multiple_of(2) {
            even_row(row(j.saturating_sub(1)), row(j), row(j + 1), tall);
        } else {
            odd_row(row(j), row(j + 1), tall);
        }
        self.tall[0] = self.tall[1];
        self.tall[columns + 1] = self.tall[columns];
        // If the width is odd, the last pair has one column too many.
        if width % 2 == 1 && out.len() == width {
            let whole = width / 2;
            across(&self.tall[..whole + 2], &mut out[..2 * whole]);
            let [before, last, after] = [0, 1, 2].map(|i| self.tall[whole + i]);
            out[width - 1] = 0.1 * (before + after) + 0.8 * last;
        } else {
            across(&self.tall, &mut out[..2 * columns]);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn even_row(above: &[f32], here: &[f32], below: &[f32], out: &mut [f32]) {
    let n = out.len();
    let (above, here, below) = (&above[..n], &here[..n], &below[..n]);
    for x in 0..n {
        out[x] = 0.1 * (above[x] + below[x]) + 0.8 * here[x];
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn odd_row(here: &[f32], below: &[f32], out: &mut [f32]) {
    let n = out.len();
    let (here, below) = (&here[..n], &below[..n]);
    for x in 0..n {
        out[x] = 0.5 * (here[x] + below[x]);
    }
}

/// Computes two columns for each column; `values` begin one column to the left.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn across(values: &[f32], out: &mut [f32]) {
    let pairs = out.as_chunks_mut::<2>().0;
    let n = pairs.len();
    let (left, here, right) = (&values[..n], &values[1..=n], &values[2..n + 2]);
    for x in 0..n {
        pairs[x] = [0.1 * (left[x] + right[x]) + 0.8 * here[x], 0.5 * (here[x] + right[x])];
    }
}

/// Expands a coarser level to the size of the finer one.
pub(crate) fn expand(coarse: &Grid, (width, height): (usize, usize)) -> Grid {
    let mut fine = Grid::new(width, height);
    fine.fill_blocks(|first, rows| {
        let mut expander = Expander::new((width, height));
        for (index, row) in rows.enumerate() {
            expander.row(coarse, first + index, &mut row[..width]);
        }
    });
    fine
}
