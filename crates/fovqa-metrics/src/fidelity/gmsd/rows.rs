//! The rows of GMSD's map: 2x2 means of the luma, gradients and their similarity.

use fovqa_frame::{LumaKind, LumaScratch, LumaSignal};
use fovqa_vision::Run;
use multiversion::multiversion;

use super::{LEVELS, STABILISER, Sums};
use crate::pair_input::PairInput;
use crate::regions::{BlockRegions, LEFT_OUT, clipped};
use crate::sums::add_by_band;

/// The number of pixels that are read at a time: their planes stay in the second-level cache.
const TILE_COLUMNS: usize = 512;

/// The last three rows of 2x2 means of both pictures, with a zero on either side of each row.
pub(super) struct Halves<'a> {
    pictures: [LumaSignal<'a>; 2],
    scratch: LumaScratch,
    tile: [Vec<f64>; 2],
    rows: [[Vec<f64>; 2]; 3],
    /// The row of zeros above and below the picture.
    nothing: Vec<f64>,
}

impl<'a> Halves<'a> {
    pub(super) fn new(input: &PairInput<'a>) -> Self {
        let luma = |frame| LumaSignal::new(frame, input.tables, LumaKind::Luma);
        let row = || vec![0.0; input.reference.width() / 2 + 2];
        Self {
            pictures: [luma(input.reference), luma(input.test)],
            scratch: LumaScratch::new(TILE_COLUMNS),
            tile: std::array::from_fn(|_| vec![0.0; TILE_COLUMNS]),
            rows: std::array::from_fn(|_| [row(), row()]),
            nothing: row(),
        }
    }

    /// Reads row `y` of the means.
    pub(super) fn read(&mut self, y: usize) {
        for (picture, row) in self.pictures.iter().zip(&mut self.rows[y % 3]) {
            let width = picture.width() / 2 * 2;
            for x in (0..width).step_by(TILE_COLUMNS) {
                let columns = TILE_COLUMNS.min(width - x);
                for (row, tile) in self.tile.iter_mut().enumerate() {
                    let xs = x..x + columns;
                    picture.fill_row(2 * y + row, xs, &mut self.scratch, &mut tile[..columns]);
                }
                // The first value follows the zero on the left.
                let first = 1 + x / 2;
                let [top, bottom] = &self.tile;
                halve(top, bottom, &mut row[first..first + columns / 2]);
            }
        }
    }

    /// The three rows around row `y` of each picture.
    pub(super) fn around(&self, y: usize, height: usize) -> [[&[f64]; 3]; 2] {
        [0, 1].map(|picture: usize| {
            let row = |y: usize| self.rows[y % 3][picture].as_slice();
            let above = if y > 0 { row(y - 1) } else { &self.nothing };
            let below = if y + 1 < height { row(y + 1) } else { &self.nothing };
            [above, row(y), below]
        })
    }
}

/// One row of the map: 1 - GMS, its square, and the blocks that count.
pub(super) struct MapRow {
    difference: Vec<f32>,
    square: Vec<f32>,
    /// Whether all blocks around each block are in the mask.
    clean: Vec<bool>,
    runs: Vec<Run>,
}

impl MapRow {
    pub(super) fn new(width: usize) -> Self {
        let row = || vec![0.0; width];
        Self { difference: row(), square: row(), clean: vec![true; width], runs: Vec::new() }
    }

    /// Computes a row from the rows around it.
    pub(super) fn compare(&mut self, [reference, test]: &[[&[f64]; 3]; 2]) {
        dissimilarity(*reference, *test, &mut self.difference, &mut self.square);
    }

    /// Adds the row to the sums of the bands that it crosses.
    pub(super) fn add(&mut self, blocks: &BlockRegions<'_>, y: usize, sums: &mut Sums) {
        let near = y.saturating_sub(1)..(y + 2).min(blocks.rows(LEVELS));
        let left_out = |y: usize| blocks.runs(LEVELS, y).iter().any(|run| run.band == LEFT_OUT);
        self.clean.fill(true);
        self.runs.clear();
        let runs = if near.clone().any(left_out) {
            for y in near {
                self.leave_out(blocks.runs(LEVELS, y));
            }
            self.mark(blocks.runs(LEVELS, y));
            self.runs.as_slice()
        } else {
            blocks.runs(LEVELS, y)
        };
        for (from, to, band) in clipped(runs, 0..self.difference.len()) {
            sums.blocks[usize::from(band)] += (to - from) as u64;
        }
        add_by_band(&self.difference, 0, runs, &mut sums.sum);
        add_by_band(&self.square, 0, runs, &mut sums.squares);
    }

    /// Leaves out blocks that a mask leaves out in a row, and the neighbours of such blocks.
    fn leave_out(&mut self, runs: &[Run]) {
        let mut from: usize = 0;
        for run in runs {
            let to = run.end as usize;
            if run.band == LEFT_OUT {
                let end = (to + 1).min(self.clean.len());
                self.clean[from.saturating_sub(1)..end].fill(false);
            }
            from = to;
        }
    }

    /// Sets the runs of a row without the blocks that are left out.
    fn mark(&mut self, runs: &[Run]) {
        let mut from = 0;
        for run in runs {
            for x in from..run.end as usize {
                let band = if self.clean[x] { run.band } else { LEFT_OUT };
                match self.runs.last_mut() {
                    Some(last) if last.band == band => last.end = x as u32 + 1,
                    _ => self.runs.push(Run { end: x as u32 + 1, band }),
                }
            }
            from = run.end as usize;
        }
    }

    /// Appends the similarities to a map.
    pub(super) fn keep(&self, map: &mut Vec<f32>) {
        let values = self.difference.iter().zip(&self.clean);
        map.extend(values.map(|(d, clean)| if *clean { 1.0 - d } else { f32::NAN }));
    }
}

/// Computes the means of blocks of 2x2 values.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn halve(top: &[f64], bottom: &[f64], out: &mut [f64]) {
    let n = out.len();
    let (top, bottom) = (&top.as_chunks::<2>().0[..n], &bottom.as_chunks::<2>().0[..n]);
    for x in 0..n {
        out[x] = ((top[x][0] + top[x][1]) + (bottom[x][0] + bottom[x][1])) * 0.25;
    }
}

/// Computes 1 - GMS of a row and its square from the three rows around it, which are one value longer
/// on either side.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn dissimilarity(reference: [&[f64]; 3], test: [&[f64]; 3], out: &mut [f32], square: &mut [f32]) {
    let n = out.len();
    let square = &mut square[..n];
    let [a, b, c] = reference.map(|row| &row[..n + 2]);
    let [d, e, f] = test.map(|row| &row[..n + 2]);
    for x in 0..n {
        let (g, gg) =
            magnitude([a[x], a[x + 1], a[x + 2]], [b[x], b[x + 2]], [c[x], c[x + 1], c[x + 2]]);
        let (h, hh) =
            magnitude([d[x], d[x + 1], d[x + 2]], [e[x], e[x + 2]], [f[x], f[x + 1], f[x + 2]]);
        let value = (g - h) * (g - h) / (gg + hh + STABILISER);
        out[x] = value as f32;
        square[x] = (value * value) as f32;
    }
}

/// The magnitude of the gradient in a neighbourhood, and its square.
#[inline(always)]
fn magnitude(above: [f64; 3], beside: [f64; 2], below: [f64; 3]) -> (f64, f64) {
    let across = (above[2] + beside[1] + below[2]) - (above[0] + beside[0] + below[0]);
    let down = (below[0] + below[1] + below[2]) - (above[0] + above[1] + above[2]);
    let square = (across * across + down * down) * (1.0 / 9.0);
    (square.sqrt(), square)
}
