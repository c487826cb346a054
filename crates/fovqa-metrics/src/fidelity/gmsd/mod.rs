//! GMSD, the gradient magnitude similarity deviation (Xue, Zhang, Mou, Bovik 2014, Eqs. 1 to 5).
//!
//! ```text
//! GMS = (2 g h + c) / (g² + h² + c),   GMSD = sqrt(Σ (GMS - mean GMS)² / (N - 1))
//! ```
//!
//! g and h are the gradient magnitudes of reference and test: Prewitt's differences of the sums of three
//! neighbours, divided by 3, of the luma in [0, 1] of blocks of 2x2 pixels, an odd last row or column dropped,
//! with zeros outside; c = 170 / 255². 0 for identical pictures, lower is better.
//!
//! Per band: the deviation over the blocks whose centre lies in it; none of fewer than two. Where pixels are
//! left out, so are their blocks, and the blocks beside those. What is summed is 1 - GMS =
//! (g - h)² / (g² + h² + c), which has the same deviation and keeps its digits where pictures are nearly alike.

#[cfg(test)]
mod tests;

use fovqa_frame::{LumaKind, LumaScratch, LumaSignal, map_row_blocks};
use fovqa_vision::Run;
use multiversion::multiversion;

use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::MetricInfo;
use crate::kinds::Better;
use crate::map::{MapInfo, MapScale};
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::{Parts, Pooling, Statistic, Weight, deviation};
use crate::regions::{BlockRegions, LEFT_OUT, clipped};
use crate::row::{Key, Rows};
use crate::sums::add_by_band;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "gmsd",
    label: "GMSD",
    better: Better::Lower,
    per_band: true,
    statistics: &[
        Statistic::VALUE
            .pooled(Pooling::Deviation)
            .over_frames(Pooling::Deviation)
            .weighted_by(Weight::Moments { count: MAP_PIXELS, mean: MAP_MEAN }),
        Statistic::count(MAP_PIXELS),
        Statistic::named(MAP_MEAN)
            .pooled(Pooling::Mean)
            .weighted_by(Weight::Statistic(MAP_PIXELS))
            .pointing(Better::Higher),
    ],
    map: Some(&MAP),
    about: "deviation of gradient magnitude similarity, of luma in blocks of 2x2 pixels",
    source: "Xue, Zhang, Mou, Bovik 2014",
    ..MetricInfo::FIDELITY
};

/// GMSD has no parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Params;

impl MetricParams for Params {
    const HAS_OWN_PASS: bool = true;

    fn smallest_side(&self, _ssim_window: usize) -> usize {
        SMALLEST_SIDE
    }

    fn block_levels(&self) -> usize {
        LEVELS
    }

    fn measure(&self, input: &PairInput<'_>) -> Option<Result<Scored, ScoreError>> {
        Some(measure(input))
    }
}

/// Gradient magnitude similarity.
const MAP: MapInfo = MapInfo {
    name: "gmsd",
    block: 2,
    about: "gradient magnitude similarity, one value for 2x2 pixels; coloured from 1 (alike) to 0",
    scale: MapScale::Linear { none: 1.0, most: 0.0 },
};

/// How many blocks a band has, and the mean of their similarity: by these its deviation is pooled.
const MAP_PIXELS: &str = "map_pixels";
const MAP_MEAN: &str = "map_mean";

/// Blocks of 2x2 pixels.
const LEVELS: usize = 1;

/// Smallest side of a frame, pixels.
const SMALLEST_SIDE: usize = 4;

/// c, of luma in [0, 1].
const STABILISER: f64 = 170.0 / (255.0 * 255.0);

/// Pixels that are read at a time: their planes stay in the second-level cache.
const TILE_COLUMNS: usize = 512;

/// Sums of 1 - GMS over some blocks, per band and then outside all bands.
#[derive(Debug, Clone)]
struct Sums {
    blocks: Vec<u64>,
    sum: Vec<f64>,
    squares: Vec<f64>,
}

impl Sums {
    fn new(bands: usize) -> Self {
        let zeros = || vec![0.0; bands + 1];
        Self { blocks: vec![0; bands + 1], sum: zeros(), squares: zeros() }
    }

    fn merge(&mut self, other: &Self) {
        for band in 0..self.blocks.len() {
            self.blocks[band] += other.blocks[band];
            self.sum[band] += other.sum[band];
            self.squares[band] += other.squares[band];
        }
    }
}

/// Measures a pair.
fn measure(input: &PairInput<'_>) -> Result<Scored, ScoreError> {
    let metric = Metric::Gmsd;
    let (width, height) = (input.reference.width(), input.reference.height());
    if width.min(height) < SMALLEST_SIDE {
        return Err(ScoreError::TooSmall { metric, width, height, needed: SMALLEST_SIDE });
    }
    let (sums, map) = run(input);
    let bands = sums.blocks.len() - 1;
    let mut rows = Rows::default();
    let all = (sums.blocks.iter().sum(), sums.sum.iter().sum(), sums.squares.iter().sum());
    if all.0 < 2 {
        return Err(ScoreError::TooFew { metric, what: "blocks of 2x2 pixels" });
    }
    add(Key::of(metric), all, &mut rows);
    for band in 0..bands {
        let of_band = (sums.blocks[band], sums.sum[band], sums.squares[band]);
        let key = Key::of(metric).in_band(band);
        add(key, of_band, &mut rows);
        rows.count(key.nth(COUNT), of_band.0);
    }
    let size = (width / 2, height / 2);
    Ok(Scored { rows, maps: map.map(|values| MAP.colored(size, values)).into_iter().collect() })
}

/// Adds the deviation of some blocks, and the mean of their similarity.
fn add(key: Key, (blocks, sum, squares): (u64, f64, f64), rows: &mut Rows) {
    let count = blocks as f64;
    rows.push(key, deviation(count, sum, squares), Parts::Deviation { count, sum, squares });
    let mean = (blocks > 0).then(|| (count - sum) / count);
    rows.push(key.nth(MEAN), mean, Parts::Mean { sum: count - sum, weight: count });
}

/// Places in the table of statistics.
const COUNT: usize = 1;
const MEAN: usize = 2;

/// The pass: blocks of rows in parallel, added up in order; the map where it is asked for.
fn run(input: &PairInput<'_>) -> (Sums, Option<Vec<f32>>) {
    let (width, height) = (input.reference.width() / 2, input.reference.height() / 2);
    let bands = input.blocks.counts(LEVELS).len() - 1;
    let parts = map_row_blocks(height, |rows| {
        let mut halves = Halves::new(input);
        let mut line = Line::new(width);
        let mut sums = Sums::new(bands);
        let mut map = Vec::new();
        // The rows above and below these too.
        for y in rows.start.saturating_sub(1)..=rows.start {
            halves.read(y);
        }
        for y in rows {
            if y + 1 < height {
                halves.read(y + 1);
            }
            line.compare(&halves.around(y, height));
            line.add(input.blocks, y, &mut sums);
            if input.map {
                line.keep(&mut map);
            }
        }
        (sums, map)
    });
    let mut sums = Sums::new(bands);
    let mut map = Vec::new();
    for (of_block, values) in parts {
        sums.merge(&of_block);
        map.extend(values);
    }
    (sums, input.map.then_some(map))
}

/// Rows of 2x2 means of both pictures, the last three that were read, with a zero on either side.
struct Halves<'a> {
    pictures: [LumaSignal<'a>; 2],
    scratch: LumaScratch,
    tile: [Vec<f64>; 2],
    rows: [[Vec<f64>; 2]; 3],
    /// What lies above and below the picture.
    nothing: Vec<f64>,
}

impl<'a> Halves<'a> {
    fn new(input: &PairInput<'a>) -> Self {
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

    /// Reads row `y`.
    fn read(&mut self, y: usize) {
        for (picture, row) in self.pictures.iter().zip(&mut self.rows[y % 3]) {
            let width = picture.width() / 2 * 2;
            for x in (0..width).step_by(TILE_COLUMNS) {
                let columns = TILE_COLUMNS.min(width - x);
                for (row, tile) in self.tile.iter_mut().enumerate() {
                    let xs = x..x + columns;
                    picture.fill_row(2 * y + row, xs, &mut self.scratch, &mut tile[..columns]);
                }
                // Behind the zero at the left.
                let first = 1 + x / 2;
                let [top, bottom] = &self.tile;
                halve(top, bottom, &mut row[first..first + columns / 2]);
            }
        }
    }

    /// Three rows around row `y` of each picture.
    fn around(&self, y: usize, height: usize) -> [[&[f64]; 3]; 2] {
        [0, 1].map(|picture: usize| {
            let row = |y: usize| self.rows[y % 3][picture].as_slice();
            let above = if y > 0 { row(y - 1) } else { &self.nothing };
            let below = if y + 1 < height { row(y + 1) } else { &self.nothing };
            [above, row(y), below]
        })
    }
}

/// One row of the map: 1 - GMS, its square, and which blocks count.
struct Line {
    difference: Vec<f32>,
    square: Vec<f32>,
    /// Whether each block's neighbourhood is in the mask, where there is one.
    clean: Vec<bool>,
    runs: Vec<Run>,
}

impl Line {
    fn new(width: usize) -> Self {
        let row = || vec![0.0; width];
        Self { difference: row(), square: row(), clean: vec![true; width], runs: Vec::new() }
    }

    /// Computes a row.
    fn compare(&mut self, [reference, test]: &[[&[f64]; 3]; 2]) {
        dissimilarity(*reference, *test, &mut self.difference, &mut self.square);
    }

    /// Adds it to the sums of the bands it crosses.
    fn add(&mut self, blocks: &BlockRegions<'_>, y: usize, sums: &mut Sums) {
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

    /// Leaves out the blocks above, below and beside those of a row that a mask leaves out.
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

    /// The runs of a row without what is left out.
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

    /// Keeps the similarities.
    fn keep(&self, map: &mut Vec<f32>) {
        let values = self.difference.iter().zip(&self.clean);
        map.extend(values.map(|(d, clean)| if *clean { 1.0 - d } else { f32::NAN }));
    }
}

/// Means of blocks of 2x2 values.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn halve(top: &[f64], bottom: &[f64], out: &mut [f64]) {
    let n = out.len();
    let (top, bottom) = (&top.as_chunks::<2>().0[..n], &bottom.as_chunks::<2>().0[..n]);
    for x in 0..n {
        out[x] = ((top[x][0] + top[x][1]) + (bottom[x][0] + bottom[x][1])) * 0.25;
    }
}

/// 1 - GMS of a row and its square, from the rows around it, each a value longer on either side.
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

/// Magnitude of the gradient in a neighbourhood, and its square.
#[inline(always)]
fn magnitude(above: [f64; 3], beside: [f64; 2], below: [f64; 3]) -> (f64, f64) {
    let across = (above[2] + beside[1] + below[2]) - (above[0] + beside[0] + below[0]);
    let down = (below[0] + below[1] + below[2]) - (above[0] + above[1] + above[2]);
    let square = (across * across + down * down) * (1.0 / 9.0);
    (square.sqrt(), square)
}
