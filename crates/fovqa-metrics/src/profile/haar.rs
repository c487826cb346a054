//! The Haar wavelet by eccentricity (Patney et al. 2016, 4.4.2 and Fig. 10).
//!
//! This is the orthonormal 2-D transform of the luma: level l describes blocks of 2^l x 2^l pixels.
//! With the quarters a b / c d of a block, LH = `(a + b - c - d) / 2` is low in x and high in y,
//! HL = `(a - b + c - d) / 2`, and HH = `(a - b - c + d) / 2`. LL = `(a + b + c + d) / 2` is the
//! input of the next level. The picture is cropped at the right and bottom to a multiple of 2^levels; a coefficient belongs
//! to the band of its block's centre in the uncropped frame.
//!
//! Per level and band, over LH, HL and HH together: mean |c|, max |c| and mean c² (energy), of luma
//! with peak 1. Values are 0 and above. Neither higher nor lower is better; the test's value is
//! compared with the reference's (lower: detail is lost; higher: noise).

use multiversion::multiversion;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::info::MetricInfo;
use crate::metric_params::MetricParams;
use crate::pooling::{Parts, Pooling, Statistic, Weight};
use crate::row::{Image, Key, Rows};

/// The statistics of all coefficients, then of each orientation, and the number of coefficients.
const STATISTICS: [Statistic; 13] = [
    mean("mean_abs"),
    MAX_ABS,
    mean("energy"),
    mean("mean_abs_lh"),
    Statistic { name: "max_abs_lh", ..MAX_ABS },
    mean("energy_lh"),
    mean("mean_abs_hl"),
    Statistic { name: "max_abs_hl", ..MAX_ABS },
    mean("energy_hl"),
    mean("mean_abs_hh"),
    Statistic { name: "max_abs_hh", ..MAX_ABS },
    mean("energy_hh"),
    Statistic::count(COEFFICIENTS),
];

/// The statistic by which the others are pooled.
pub(crate) const COEFFICIENTS: &str = "coefficients";

const MAX_ABS: Statistic =
    Statistic::named("max_abs").pooled(Pooling::Max).over_frames(Pooling::Max);

const fn mean(name: &'static str) -> Statistic {
    Statistic::named(name)
        .pooled(Pooling::WeightedMean)
        .weighted_by(Weight::Statistic(COEFFICIENTS))
}

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "haar",
    label: "Haar wavelet",
    statistics: &STATISTICS,
    about: "wavelet coefficients of luma by level and band (mean_abs, max_abs, energy), of reference and test, and their ratios",
    source: "Patney et al. 2016, 4.4.2, Fig. 10",
    params: &[
        ParamInfo {
            name: "levels",
            default: "5",
            values: ParamValues::Whole(1, MAX_LEVELS),
            about: "number of levels; level l describes blocks of 2^l x 2^l px",
        },
        ParamInfo {
            name: "orientations",
            default: "false",
            values: ParamValues::Flag,
            about: "also report LH, HL and HH separately",
        },
    ],
    ..MetricInfo::PROFILE
};

/// The largest number of levels: blocks have sides of 256 pixels.
pub const MAX_LEVELS: u32 = 8;

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Params {
    /// The number of levels, from 1 to [`MAX_LEVELS`].
    pub levels: u32,
    /// Whether LH, HL and HH are also reported separately.
    pub orientations: bool,
}

impl Default for Params {
    fn default() -> Self {
        Self { levels: 5, orientations: false }
    }
}

impl MetricParams for Params {
    fn smallest_side(&self, _ssim_window: usize) -> usize {
        self.block_side()
    }

    fn block_levels(&self) -> usize {
        self.levels as usize
    }

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "levels" => self.levels = value.number()? as u32,
            "orientations" => self.orientations = value.flag()?,
            _ => return None,
        }
        Some(())
    }
}

impl Params {
    /// The side of the coarsest block in pixels, which is the smallest side of a picture.
    pub fn block_side(&self) -> usize {
        1 << self.levels
    }
}

/// Sums over the coefficients of one orientation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sums {
    abs: f64,
    max: f64,
    square: f64,
}

impl Sums {
    pub(crate) fn merge(&mut self, other: &Self) {
        self.abs += other.abs;
        self.max = self.max.max(other.max);
        self.square += other.square;
    }
}

/// Adds the rows of `blocks` blocks with these sums of LH, HL and HH. `key` has the picture, level
/// and band.
pub(crate) fn rows(key: Key, sums: &[Sums; 3], blocks: u64, orientations: bool, rows: &mut Rows) {
    let mut all = Sums::default();
    for one in sums {
        all.merge(one);
    }
    let parts = orientations.then(|| sums.iter().map(|sums| (*sums, blocks)));
    let of = [(all, 3 * blocks)].into_iter().chain(parts.into_iter().flatten());
    for (of, (sums, coefficients)) in of.enumerate() {
        let count = coefficients as f64;
        let of_sum = |sum: f64| {
            let value = (coefficients > 0).then(|| sum / count);
            (value, Parts::Mean { sum, weight: count })
        };
        let max = (coefficients > 0).then_some(sums.max);
        let values = [of_sum(sums.abs), (max, Parts::Value), of_sum(sums.square)];
        for (statistic, (value, parts)) in values.into_iter().enumerate() {
            rows.push(key.nth(PER_ORIENTATION * of + statistic), value, parts);
        }
    }
}

/// The number of statistics of the coefficients of one orientation, or of all.
const PER_ORIENTATION: usize = 3;

/// The key for the number of coefficients, which both pictures share; `key` has the level and band.
pub(crate) fn coefficients(key: Key) -> Key {
    key.of_image(Image::Pair).nth(STATISTICS.len() - 1)
}

/// Transforms one pair of rows to the next level: `ll` and the details LH, HL, HH, each half as
/// long as the rows.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn level(top: &[f64], bottom: &[f64], ll: &mut [f64], details: [&mut [f64]; 3]) {
    let (top, bottom) = (top.as_chunks::<2>().0, bottom.as_chunks::<2>().0);
    let [lh, hl, hh] = details;
    let n = ll.len();
    let (top, bottom) = (&top[..n], &bottom[..n]);
    let (lh, hl, hh) = (&mut lh[..n], &mut hl[..n], &mut hh[..n]);
    for x in 0..n {
        let ([a, b], [c, d]) = (top[x], bottom[x]);
        let (upper, lower) = (a + b, c + d);
        let (upper_edge, lower_edge) = (a - b, c - d);
        ll[x] = (upper + lower) * 0.5;
        lh[x] = (upper - lower) * 0.5;
        hl[x] = (upper_edge + lower_edge) * 0.5;
        hh[x] = (upper_edge - lower_edge) * 0.5;
    }
}

/// The sums of a stretch of coefficients. They are added lane by lane, in the same order for any
/// vector width.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn sums(coefficients: &[f64]) -> Sums {
    const LANES: usize = 8;
    let mut abs = [0.0; LANES];
    let mut max = [0.0f64; LANES];
    let mut square = [0.0; LANES];
    let (chunks, rest) = coefficients.as_chunks::<LANES>();
    for chunk in chunks {
        for i in 0..LANES {
            let c = chunk[i].abs();
            abs[i] += c;
            max[i] = if c > max[i] { c } else { max[i] };
            square[i] += c * c;
        }
    }
    for (i, c) in rest.iter().enumerate() {
        let c = c.abs();
        abs[i] += c;
        max[i] = if c > max[i] { c } else { max[i] };
        square[i] += c * c;
    }
    Sums {
        abs: abs.iter().sum(),
        max: max.into_iter().fold(0.0, f64::max),
        square: square.iter().sum(),
    }
}
