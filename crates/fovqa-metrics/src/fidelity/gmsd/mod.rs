//! GMSD, the gradient magnitude similarity deviation (Xue, Zhang, Mou, Bovik 2014, Eqs. 1 to 5).
//!
//! ```text
//! GMS = (2 g h + c) / (g² + h² + c),   GMSD = sqrt(Σ (GMS - mean GMS)² / (N - 1))
//! ```
//!
//! g and h are the gradient magnitudes of reference and test. Gradients are those of Prewitt: differences of
//! the sums of three neighbours, divided by 3. They are computed from the luma in [0, 1], averaged over
//! blocks of 2x2 pixels; an odd last row or column is dropped, and values outside the picture are 0.
//! c = 170 / 255². GMSD is 0 for identical pictures, and lower is better.
//!
//! Per band it is the deviation over the blocks whose centre lies in the band; it has no value for fewer than
//! two blocks. Where pixels are left out, their blocks and the neighbouring blocks are left out too. The code
//! sums 1 - GMS = (g - h)² / (g² + h² + c), which has the same deviation and keeps its digits where pictures
//! are nearly equal.

mod rows;
#[cfg(test)]
mod tests;

use fovqa_frame::map_row_blocks;

use self::rows::{Halves, MapRow};
use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::MetricInfo;
use crate::kinds::Better;
use crate::map::{MapInfo, MapScale};
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::{Parts, Pooling, Statistic, Weight, deviation};
use crate::registry;
use crate::row::{Key, Rows};

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
            .pooled(Pooling::WeightedMean)
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

    fn measure(
        &self,
        _all: &registry::Params,
        input: &PairInput<'_>,
    ) -> Option<Result<Scored, ScoreError>> {
        Some(measure(input))
    }
}

/// Gradient magnitude similarity.
const MAP: MapInfo = MapInfo {
    name: "gmsd",
    label: "Gradient magnitude similarity",
    unit: None,
    block: 2,
    about: "gradient magnitude similarity, one value per 2x2 pixels; coloured from 1 (identical) to 0.5",
    bright: "worse",
    scale: MapScale::Linear { none: 1.0, most: 0.5 },
};

/// The number of blocks of a band and the mean of their similarity, with which its deviation is pooled.
const MAP_PIXELS: &str = "map_pixels";
const MAP_MEAN: &str = "map_mean";

/// The number of block levels: only blocks of 2x2 pixels.
const LEVELS: usize = 1;

/// The smallest side of a frame in pixels.
const SMALLEST_SIDE: usize = 4;

/// The constant c for luma in [0, 1].
const STABILISER: f64 = 170.0 / (255.0 * 255.0);

/// Sums of 1 - GMS over some blocks: for each band, then outside all bands.
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
    let map = map.map(|values| MAP.with((width, height), values));
    Ok(Scored { maps: map.into_iter().collect(), ..Scored::of(rows) })
}

/// Adds the deviation of a set of blocks, and the mean of their similarity.
fn add(key: Key, (blocks, sum, squares): (u64, f64, f64), rows: &mut Rows) {
    let count = blocks as f64;
    rows.push(key, deviation(count, sum, squares), Parts::Deviation { count, sum, squares });
    let mean = (blocks > 0).then(|| (count - sum) / count);
    rows.push(key.nth(MEAN), mean, Parts::Mean { sum: count - sum, weight: count });
}

/// Indices in the table of statistics.
const COUNT: usize = 1;
const MEAN: usize = 2;

/// Runs the pass over blocks of rows in parallel, and adds their sums in order. Returns the map if it is
/// asked for.
fn run(input: &PairInput<'_>) -> (Sums, Option<Vec<f32>>) {
    let (width, height) = (input.reference.width() / 2, input.reference.height() / 2);
    let bands = input.blocks.counts(LEVELS).len() - 1;
    let parts = map_row_blocks(height, |rows| {
        let mut halves = Halves::new(input);
        let mut map_row = MapRow::new(width);
        let mut sums = Sums::new(bands);
        let mut map = Vec::new();
        // Rows need the one above and the one below as well.
        for y in rows.start.saturating_sub(1)..=rows.start {
            halves.read(y);
        }
        for y in rows {
            if y + 1 < height {
                halves.read(y + 1);
            }
            map_row.compare(&halves.around(y, height));
            map_row.add(input.blocks, y, &mut sums);
            if input.map {
                map_row.keep(&mut map);
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
