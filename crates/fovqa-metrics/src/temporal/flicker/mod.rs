//! Flicker: the change of luma over time along the motion, without a steady drift.
//!
//! For a frame t, the path of a pixel x leads through the frames before it: x_0 = x and x_{k+1} = x_k +
//! m_{t-k}[⌊x_k⌋] for k = 0..N-2, where the motion m is read at the pixel that holds x_k and is not
//! interpolated. v_k is the luma of frame t - k at x_k, bilinear at pixel centres and clamped to the
//! frame. With v̄ the mean of v_k over k, and k̄ = (N - 1) / 2,
//!
//! ```text
//! s² = (1/N) [ Σ (v_k - v̄)² - ( Σ (k - k̄)(v_k - v̄) )² / Σ (k - k̄)² ]
//! flicker = √(mean of s² over the pixels with a path)
//! ```
//!
//! A variance up to 2^-48, which rounding alone may have, counts as 0. With `detrend = "mean"` the second term is left out. A step of a path is valid by the rules of
//! [ATD](super::atd), and a pixel with an invalid step has no path. Flicker is in [0, 1]. Luma that
//! alternates by ±a has flicker a for even N (0.98 a with 8 frames and the line taken out), and a steady drift
//! has none. The measure and its parameters are fovqa's own choice; no paper defines them.

mod paths;
#[cfg(test)]
mod tests;

use fovqa_frame::map_row_blocks;
use fovqa_params::{ParamError, ParamInfo, ParamValue, ParamValues};

use super::time_input::{Picture, TimeInput};
use crate::info::MetricInfo;
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pooling::{Parts, Pooling, Statistic};
use crate::regions::clipped;
use crate::row::{Key, Rows};
use crate::sums::add_by_band;
use paths::{LANES, Paths, variances};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "flicker",
    label: "Flicker",
    long_name: "deviation of luma along the motion (root mean square over frames)",
    statistics: &[
        Statistic::VALUE.over_eyes(Pooling::RootWeightedMean).over_frames(Pooling::RootMeanSquare),
        Statistic::named("left_out").pooled(Pooling::WeightedMean).without_ratio(),
    ],
    about: "standard deviation of luma along the motion over several frames, without a steady drift, of \
            reference and test, and their ratio",
    source: "fovqa's own definition",
    params: &[
        ParamInfo {
            name: "frames",
            default: "8",
            values: ParamValues::Whole(2, 64),
            about: "frames that are compared, the present one included",
        },
        ParamInfo {
            name: "detrend",
            default: "linear",
            values: ParamValues::Word(&["linear", "mean"]),
            about: "what is taken out: linear for a steady drift, mean for nothing but the mean",
        },
    ],
    ..MetricInfo::TEMPORAL
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Params {
    /// The number of frames, the present one included.
    pub frames: usize,
    /// Whether the straight line through the values is taken out, and not only their mean.
    pub detrend: bool,
}

impl Default for Params {
    fn default() -> Self {
        Self { frames: 8, detrend: true }
    }
}

/// The smallest number of frames that do not lie on a straight line in any case.
const FEWEST_DETRENDED: usize = 3;

impl MetricParams for Params {
    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "frames" => self.frames = value.number()? as usize,
            "detrend" => self.detrend = matches!(value, ParamValue::Text(word) if word == "linear"),
            _ => return None,
        }
        Some(())
    }

    fn check(&self) -> Result<(), ParamError> {
        if !self.detrend || self.frames >= FEWEST_DETRENDED {
            return Ok(());
        }
        Err(ParamError::Value {
            owner: INFO.key,
            param: "frames",
            value: self.frames.to_string(),
            expected: format!(
                "at least {FEWEST_DETRENDED} with detrend = linear, or 2 with detrend = mean"
            ),
        })
    }

    fn frames_needed(&self) -> usize {
        self.frames
    }

    fn follow(&self, all: &crate::Params, input: &TimeInput<'_>) -> Option<Vec<Rows>> {
        let (width, height) = input.size();
        let paths = Paths {
            input,
            width,
            height,
            frames: self.frames,
            detrend: self.detrend,
            depth_tolerance: all.atd.depth_tolerance.filter(|_| input.depth.is_some()),
        };
        let blocks = map_row_blocks(height, |rows| {
            let mut block = Block::new(&paths);
            for y in rows {
                for x in (0..width).step_by(TILE_COLUMNS) {
                    block.tile(x, y, TILE_COLUMNS.min(width - x));
                }
            }
            block.sums
        });
        let mut all = Sums::new(input);
        for block in &blocks {
            all.merge(block);
        }
        let pictures = input.pictures.iter().zip(&all.variances);
        Some(pictures.map(|(picture, of)| all.rows(input, picture, of)).collect())
    }
}

/// The number of columns of a tile.
const TILE_COLUMNS: usize = 16 * LANES;

/// The sums of a block of rows: per band, then outside all bands.
struct Sums {
    /// The sums of the variances of each picture.
    variances: Vec<Vec<f64>>,
    /// The number of pixels with a path.
    valid: Vec<u64>,
}

impl Sums {
    fn new(input: &TimeInput<'_>) -> Self {
        let bands = input.regions.bands();
        Self {
            variances: vec![vec![0.0; bands + 1]; input.pictures.len()],
            valid: vec![0; bands + 1],
        }
    }

    fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.variances.iter_mut().zip(&other.variances) {
            mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| *mine += theirs);
        }
        self.valid.iter_mut().zip(&other.valid).for_each(|(mine, theirs)| *mine += theirs);
    }

    /// The values of a picture, whose sums are `of`: of the whole frame, with the share of pixels
    /// without a path, and of each band.
    fn rows(&self, input: &TimeInput<'_>, picture: &Picture<'_>, of: &[f64]) -> Rows {
        let mut rows = Rows::default();
        let key = Key::of(Metric::Flicker).of_image(picture.image);
        let mut add = |key: Key, sum: f64, valid: u64| {
            let weight = valid as f64;
            let value = (valid > 0).then(|| (sum / weight).sqrt());
            rows.push(key, value, Parts::Mean { sum, weight });
        };
        let valid: u64 = self.valid.iter().sum();
        add(key, of.iter().sum(), valid);
        for (band, (sum, valid)) in of.iter().zip(&self.valid).enumerate() {
            if band < input.regions.bands() {
                add(key.in_band(band), *sum, *valid);
            }
        }
        let pixels: u64 = input.regions.pixels().iter().sum();
        let (sum, weight) = ((pixels - valid) as f64, pixels as f64);
        rows.push(key.nth(1), Some(sum / weight.max(1.0)), Parts::Mean { sum, weight });
        rows
    }
}

struct Block<'a> {
    paths: &'a Paths<'a>,
    variances: Vec<Vec<f32>>,
    valid: Vec<u32>,
    sums: Sums,
}

impl<'a> Block<'a> {
    fn new(paths: &'a Paths<'a>) -> Self {
        Self {
            paths,
            variances: vec![vec![0.0; TILE_COLUMNS]; paths.input.pictures.len()],
            valid: vec![0; TILE_COLUMNS],
            sums: Sums::new(paths.input),
        }
    }

    fn tile(&mut self, x: usize, y: usize, n: usize) {
        let valid = &mut self.valid[..n];
        variances(self.paths, x, y, &mut self.variances, valid);
        let runs = self.paths.input.regions.pixel_runs(y);
        for (from, to, band) in clipped(runs, x..x + n) {
            let valid = valid[from - x..to - x].iter().sum::<u32>();
            self.sums.valid[usize::from(band)] += u64::from(valid);
        }
        for (variances, sums) in self.variances.iter().zip(&mut self.sums.variances) {
            add_by_band(&variances[..n], x, runs, sums);
        }
    }
}
