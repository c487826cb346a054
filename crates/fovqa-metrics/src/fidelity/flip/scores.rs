//! The numbers that FLIP and HDR-FLIP make of a map, from 0 to 1.

use super::quartiles::Quartiles;
use crate::fidelity::score_error::ScoreError;
use crate::fidelity::weighted_mean::WeightedMean;
use crate::kinds::Better;
use crate::metric::Metric;
use crate::pair_input::PairInput;
use crate::pooling::{Parts, Pooling, Statistic};
use crate::row::{Key, Rows};
use crate::sums::{add_by_band, weighted};

/// The statistics. `min`, `max` and `foveal` are their names, which say the metric too: the smallest and the largest
/// value of a frame are not those over frames.
pub(crate) const fn statistics(
    min: &'static str,
    max: &'static str,
    foveal: &'static str,
) -> [Statistic; STATISTICS] {
    [
        Statistic::VALUE.over_bands(Pooling::WeightedMean),
        Statistic::named("weighted_median").of_frames(),
        Statistic::named("q1").of_frames(),
        Statistic::named("q3").of_frames(),
        Statistic::named(min).over_eyes(Pooling::Min).of_frames().named_alone(),
        Statistic::named(max).over_eyes(Pooling::Max).of_frames().named_alone(),
        Statistic::named(foveal).of_frames().named_alone(),
        setting("ppd"),
    ]
}

/// What a value is computed with, which is not quality. Each eye has its own.
pub(crate) const fn setting(name: &'static str) -> Statistic {
    let statistic = Statistic::named(name).over_eyes(Pooling::None).of_frames();
    Statistic { is_setting: true, ..statistic }.pointing(Better::Neither)
}

/// The number of statistics, and where each is.
pub(crate) const STATISTICS: usize = 8;
const MEDIAN: usize = 1;
const Q1: usize = 2;
const Q3: usize = 3;
const MIN: usize = 4;
const MAX: usize = 5;
const FOVEAL: usize = 6;
const PPD: usize = 7;

/// Sums of the values of a map.
#[derive(Debug, Clone)]
pub(crate) struct Sums {
    /// For each band, then outside all bands.
    bands: Vec<f64>,
    foveal: WeightedMean,
}

impl Sums {
    pub(crate) fn new(input: &PairInput<'_>) -> Self {
        Self { bands: vec![0.0; input.regions.bands() + 1], foveal: WeightedMean::default() }
    }

    /// Adds the values of row `y` from column `x` on. `scratch` is as long as the values.
    pub(crate) fn add(
        &mut self,
        input: &PairInput<'_>,
        (x, y): (usize, usize),
        values: &[f32],
        scratch: &mut [f32],
    ) {
        let runs = input.regions.pixel_runs(y);
        add_by_band(values, x, runs, &mut self.bands);
        if let Some(weight) = input.weight {
            weight.fill_row(y, x..x + values.len(), scratch);
            self.foveal.add(weighted(values, scratch, x, runs));
        }
    }

    /// The sums of all blocks of rows.
    pub(crate) fn of(input: &PairInput<'_>, blocks: &[Self]) -> Self {
        let mut all = Self::new(input);
        for block in blocks {
            for (all, sum) in all.bands.iter_mut().zip(&block.bands) {
                *all += sum;
            }
            all.foveal.merge(&block.foveal);
        }
        all
    }

    /// The rows of a metric whose map has these sums and these values, NaN where there is none.
    pub(crate) fn rows(
        &self,
        metric: Metric,
        input: &PairInput<'_>,
        values: &[f32],
        pixels_per_degree: f64,
    ) -> Result<Rows, ScoreError> {
        let quartiles = Quartiles::of(values).ok_or(ScoreError::NothingLeft)?;
        let pixels = input.regions.pixels();
        let mut rows = Rows::default();
        let mut add = |key: Key, sum: f64, pixels: u64| {
            let weight = pixels as f64;
            let value = (pixels > 0).then(|| sum / weight);
            rows.push(key, value, Parts::Mean { sum, weight });
        };
        let key = Key::of(metric);
        add(key, self.bands.iter().sum(), pixels.iter().sum());
        for (band, sum) in self.bands[..input.regions.bands()].iter().enumerate() {
            add(key.in_band(band), *sum, pixels[band]);
        }
        let [q1, median, q3] = quartiles.weighted;
        let of = [(MEDIAN, median), (Q1, q1), (Q3, q3), (MIN, quartiles.min), (MAX, quartiles.max)];
        for (statistic, value) in of {
            rows.score(key.nth(statistic), f64::from(value));
        }
        rows.score(key.nth(PPD), pixels_per_degree);
        if let Some(value) = self.foveal.mean() {
            rows.score(key.nth(FOVEAL), value);
        }
        Ok(rows)
    }
}

/// Leaves out what a mask leaves out of row `y`, from column `x` on.
pub(crate) fn leave_out(input: &PairInput<'_>, (x, y): (usize, usize), values: &mut [f32]) {
    for stretch in input.regions.left_out_in(y, x..x + values.len()) {
        values[stretch.start - x..stretch.end - x].fill(f32::NAN);
    }
}
