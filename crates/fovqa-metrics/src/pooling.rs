//! How values are pooled over the bands of a frame, the two eyes, and the frames of a sequence.
//! Each metric declares once, beside its code, how its statistics are pooled ([`Statistic`]);
//! [`pool`] does it.

use crate::decibels::{mse_of_db, psnr_db};
use crate::kinds::Better;

/// A statistic of a metric: one of the numbers that it gives for a frame, a band or a level.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub struct Statistic {
    /// Its name in results; empty for the metric's own value.
    pub name: &'static str,
    /// How the values of several bands of a frame are combined.
    pub bands: Pooling,
    /// How the values of both eyes are combined.
    pub eyes: Pooling,
    /// How the values of several frames are combined. The results always have mean, minimum and
    /// maximum as well; with [`Pooling::PlainMean`], nothing is added to them.
    pub frames: Pooling,
    /// The weight of a band when only results.csv is available, which has no sums.
    pub weight: Weight,
    /// Whether it is a count of something.
    pub is_count: bool,
    /// Whether results have the ratio of test to reference. It applies to statistics of single
    /// pictures.
    pub has_ratio: bool,
    /// A value of the reference below this has no ratio.
    pub floor: f64,
    /// Whether higher or lower is better, where that differs from the metric.
    pub better: Option<Better>,
    /// Whether it describes the whole frame but depends on the band edges.
    pub is_of_bands: bool,
    /// Whether it has a row in results.csv.
    pub has_row: bool,
    /// Whether it is what a value was computed with, rather than quality.
    pub is_setting: bool,
    /// Whether there is a value per band, if the metric has any. A statistic may be of whole frames alone.
    pub is_per_band: bool,
    /// Whether its name says the metric too, so that JSON does not put the metric's key before it.
    pub is_named_alone: bool,
}

/// A way to combine values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pooling {
    /// The values cannot be combined.
    None,
    /// The mean of the values, each with the same weight.
    PlainMean,
    /// The weighted mean: the sum of all sums, divided by the sum of all weights.
    WeightedMean,
    /// The weighted mean of the squared errors (peak 1), converted to decibels.
    Decibels,
    /// The root of the weighted mean of the squares.
    RootWeightedMean,
    /// The root of the mean of the squares, each with the same weight.
    RootMeanSquare,
    /// The standard deviation of all samples together, with the divisor N - 1.
    Deviation,
    /// The largest value.
    Max,
    /// The smallest value.
    Min,
    /// The sum.
    Sum,
}

/// The source of a band's weight in results.csv.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// The band's number of pixels.
    Pixels,
    /// Another statistic of the metric, on the same level or of all levels of the band.
    Statistic(&'static str),
    /// For a deviation: the number of samples, and their mean.
    Moments {
        /// The statistic with the number of samples.
        count: &'static str,
        /// The statistic with their mean.
        mean: &'static str,
    },
}

impl Statistic {
    /// The metric's own value: a score, which is averaged.
    pub(crate) const VALUE: Self = Self::named("");

    /// A score with a name.
    pub(crate) const fn named(name: &'static str) -> Self {
        Self {
            name,
            bands: Pooling::None,
            eyes: Pooling::PlainMean,
            frames: Pooling::PlainMean,
            weight: Weight::Pixels,
            is_count: false,
            has_ratio: true,
            floor: 0.0,
            better: None,
            is_of_bands: false,
            has_row: true,
            is_setting: false,
            is_per_band: true,
            is_named_alone: false,
        }
    }

    /// A count of something.
    pub(crate) const fn count(name: &'static str) -> Self {
        let of = Self { is_count: true, has_ratio: false, ..Self::named(name) };
        of.pooled(Pooling::Sum).over_frames(Pooling::Sum)
    }

    /// A score of the test alone, which has no ratio.
    pub(crate) const fn of_test(name: &'static str) -> Self {
        Self { has_ratio: false, ..Self::named(name) }
    }

    /// Sets the pooling over bands and eyes.
    pub(crate) const fn pooled(self, pooling: Pooling) -> Self {
        Self { bands: pooling, eyes: pooling, ..self }
    }

    /// Sets the pooling over bands.
    pub(crate) const fn over_bands(self, pooling: Pooling) -> Self {
        Self { bands: pooling, ..self }
    }

    /// Sets the pooling over eyes.
    pub(crate) const fn over_eyes(self, pooling: Pooling) -> Self {
        Self { eyes: pooling, ..self }
    }

    /// Sets the pooling over frames.
    pub(crate) const fn over_frames(self, pooling: Pooling) -> Self {
        Self { frames: pooling, ..self }
    }

    /// Sets the weight in results.csv.
    pub(crate) const fn weighted_by(self, weight: Weight) -> Self {
        Self { weight, ..self }
    }

    /// Sets a direction of its own: whether higher or lower is better.
    pub(crate) const fn pointing(self, better: Better) -> Self {
        Self { better: Some(better), ..self }
    }

    /// Declares that it depends on the band edges.
    pub(crate) const fn of_bands(self) -> Self {
        Self { is_of_bands: true, ..self }
    }

    /// Declares that values of the reference below a floor have no ratio.
    pub(crate) const fn with_floor(self, floor: f64) -> Self {
        Self { floor, ..self }
    }

    /// Declares that it has no ratio of test to reference.
    pub(crate) const fn without_ratio(self) -> Self {
        Self { has_ratio: false, ..self }
    }

    /// Declares that only whole frames have it.
    pub(crate) const fn of_frames(self) -> Self {
        Self { is_per_band: false, ..self }
    }

    /// Declares that its name says the metric too.
    pub(crate) const fn named_alone(self) -> Self {
        Self { is_named_alone: true, ..self }
    }

    /// Declares that it has no row in results.
    pub(crate) const fn without_row(self) -> Self {
        Self { has_row: false, ..self }
    }

    /// Whether a sequence has a pooled value besides the mean of its frames.
    pub fn pools_frames(&self) -> bool {
        matches!(
            self.frames,
            Pooling::WeightedMean
                | Pooling::Decibels
                | Pooling::Deviation
                | Pooling::RootWeightedMean
                | Pooling::RootMeanSquare
        )
    }

    /// Whether the pooled value of a sequence follows from the values of its frames alone, but is not their
    /// mean.
    pub fn pools_values(&self) -> bool {
        self.frames == Pooling::RootMeanSquare
    }

    /// Whether the largest value of all frames represents the sequence.
    pub fn is_maximum(&self) -> bool {
        self.frames == Pooling::Max
    }
}

/// The numbers that are needed to pool a value without loss.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Parts {
    /// The value alone.
    #[default]
    Value,
    /// For a mean: its sum and its weight.
    Mean {
        /// The sum.
        sum: f64,
        /// The divisor of the sum.
        weight: f64,
    },
    /// For a deviation: N, Σ and Σ².
    Deviation {
        /// The number of values.
        count: f64,
        /// Their sum.
        sum: f64,
        /// The sum of their squares.
        squares: f64,
    },
}

impl Parts {
    /// The parts of a value from results.csv, by its weight. For a deviation, `mean` is the mean of
    /// its samples.
    pub fn of_value(pooling: Pooling, value: Option<f64>, weight: f64, mean: f64) -> Self {
        match (pooling, value) {
            (Pooling::WeightedMean, Some(value)) => Self::Mean { sum: value * weight, weight },
            (Pooling::RootWeightedMean, Some(value)) => {
                Self::Mean { sum: value * value * weight, weight }
            }
            (Pooling::Decibels, Some(value)) => {
                Self::Mean { sum: mse_of_db(value) * weight, weight }
            }
            // A single sample has no deviation, but it counts when several bands are combined.
            (Pooling::Deviation, value) => {
                let deviation = value.unwrap_or(0.0);
                let squared = deviation * deviation * (weight - 1.0).max(0.0);
                let sum = mean * weight;
                Self::Deviation { count: weight, sum, squares: squared + mean * sum }
            }
            _ => Self::Value,
        }
    }

    /// Adds the parts of another value; `None` where the two are of different kinds.
    fn and(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Self::Value, Self::Value) => Some(Self::Value),
            (Self::Mean { sum, weight }, Self::Mean { sum: s, weight: w }) => {
                Some(Self::Mean { sum: sum + s, weight: weight + w })
            }
            (
                Self::Deviation { count, sum, squares },
                Self::Deviation { count: n, sum: s, squares: q },
            ) => Some(Self::Deviation { count: count + n, sum: sum + s, squares: squares + q }),
            _ => None,
        }
    }

    /// Whether nothing was measured.
    fn is_empty(&self) -> bool {
        match *self {
            Self::Value => true,
            Self::Mean { weight, .. } => weight <= 0.0,
            Self::Deviation { count, .. } => count <= 0.0,
        }
    }

    /// The value of these parts; `None` if there is nothing to compute it from.
    fn value(&self, pooling: Pooling) -> Option<f64> {
        match *self {
            Self::Value => None,
            Self::Mean { sum, weight } => {
                let mean = (weight > 0.0).then(|| sum / weight)?;
                Some(match pooling {
                    Pooling::Decibels => psnr_db(mean),
                    Pooling::RootWeightedMean => mean.sqrt(),
                    _ => mean,
                })
            }
            Self::Deviation { count, sum, squares } => deviation(count, sum, squares),
        }
    }
}

/// The standard deviation of `count` values with this sum and this sum of squares; `None` for fewer
/// than two values.
pub(crate) fn deviation(count: f64, sum: f64, squares: f64) -> Option<f64> {
    let squared = squares - sum * sum / count;
    (count >= 2.0).then(|| (squared.max(0.0) / (count - 1.0)).sqrt())
}

/// Combines values, each with its parts, in the order they come. The value is `None` if there is none, or if
/// several cannot be combined. A single value is returned as it is, to the last bit.
pub fn pool(
    pooling: Pooling,
    values: impl IntoIterator<Item = (Option<f64>, Parts)>,
) -> (Option<f64>, Parts) {
    let mut pool = Pool::default();
    values.into_iter().for_each(|(value, parts)| pool.add(value, parts));
    pool.value(pooling)
}

/// Combines values like [`pool`], but takes them one at a time. Several pools can be filled in one pass over
/// the frames.
#[derive(Debug, Clone, Copy)]
pub struct Pool {
    /// Number of values, their sum, the sum of their squares, the largest and the smallest one.
    scored: usize,
    sum: f64,
    squares: f64,
    max: f64,
    min: f64,
    /// The last value.
    last: f64,
    /// Number of items that have a value or samples, and their parts together.
    measured: usize,
    parts: Option<Parts>,
}

impl Default for Pool {
    fn default() -> Self {
        let (max, min) = (f64::NEG_INFINITY, f64::INFINITY);
        Self { scored: 0, sum: 0.0, squares: 0.0, max, min, last: 0.0, measured: 0, parts: None }
    }
}

impl Pool {
    /// Adds the next value with its parts.
    pub fn add(&mut self, value: Option<f64>, parts: Parts) {
        if let Some(value) = value {
            self.sum += value;
            self.squares += value * value;
            self.max = f64::max(self.max, value);
            self.min = f64::min(self.min, value);
            (self.scored, self.last) = (self.scored + 1, value);
        }
        // A value may be missing although it has samples.
        if value.is_some() || !parts.is_empty() {
            self.measured += 1;
            self.parts = match self.parts {
                None => Some(parts),
                Some(before) => Some(before.and(parts).unwrap_or_default()),
            };
        }
    }

    /// The combined value with its parts.
    pub fn value(&self, pooling: Pooling) -> (Option<f64>, Parts) {
        let parts = self.parts.unwrap_or_default();
        match (pooling, self.scored) {
            (_, 1) if self.measured == 1 => (Some(self.last), parts),
            (
                Pooling::WeightedMean
                | Pooling::Decibels
                | Pooling::Deviation
                | Pooling::RootWeightedMean,
                _,
            ) => (parts.value(pooling), parts),
            (_, 0) | (Pooling::None, _) => (None, Parts::Value),
            (Pooling::PlainMean, count) => (Some(self.sum / count as f64), Parts::Value),
            (Pooling::RootMeanSquare, count) => {
                (Some((self.squares / count as f64).sqrt()), Parts::Value)
            }
            (Pooling::Max, _) => (Some(self.max), Parts::Value),
            (Pooling::Min, _) => (Some(self.min), Parts::Value),
            (Pooling::Sum, _) => (Some(self.sum), Parts::Value),
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    fn mean(sum: f64, weight: f64) -> (Option<f64>, Parts) {
        (Some(sum / weight), Parts::Mean { sum, weight })
    }

    #[test]
    fn means_pool_sums_and_scores_pool_values() {
        let values = [mean(1.0, 4.0), mean(6.0, 12.0), (None, Parts::Value)];
        let (value, parts) = pool(Pooling::WeightedMean, values);
        assert_eq!((value, parts), (Some(7.0 / 16.0), Parts::Mean { sum: 7.0, weight: 16.0 }));
        assert_eq!(pool(Pooling::PlainMean, values).0, Some(0.375));
        assert_eq!(pool(Pooling::Max, values).0, Some(0.5));
        assert_eq!(pool(Pooling::Min, values).0, Some(0.25));
        assert_eq!(pool(Pooling::Sum, values).0, Some(0.75));
        assert_eq!(pool(Pooling::None, values).0, None);
        assert_eq!(pool(Pooling::None, [values[0]]).0, Some(0.25), "one alone stays");
        assert_eq!(pool(Pooling::WeightedMean, []).0, None);
    }

    /// Variances add up, deviations do not.
    #[test]
    fn roots_are_taken_of_pooled_squares() {
        let part =
            |sum: f64, weight: f64| (Some((sum / weight).sqrt()), Parts::Mean { sum, weight });
        // The squares 4 and 1, of 1 and of 3 pixels.
        let values = [part(4.0, 1.0), part(3.0, 3.0), (None, Parts::Value)];
        let (value, parts) = pool(Pooling::RootWeightedMean, values);
        assert_eq!((value, parts), (Some(1.75f64.sqrt()), Parts::Mean { sum: 7.0, weight: 4.0 }));
        assert_eq!(pool(Pooling::RootMeanSquare, values).0, Some(2.5f64.sqrt()));
        let read = |value: f64, weight: f64| {
            (Some(value), Parts::of_value(Pooling::RootWeightedMean, Some(value), weight, 0.0))
        };
        let (value, _) = pool(Pooling::RootWeightedMean, [read(2.0, 1.0), read(1.0, 3.0)]);
        assert_eq!(value, Some(1.75f64.sqrt()));
        assert_eq!(pool(Pooling::RootMeanSquare, [values[1]]).0, Some(1.0));
    }

    #[test]
    fn decibels_are_computed_from_the_pooled_error() {
        let frame = |mse: f64, pixels: f64| {
            (Some(psnr_db(mse)), Parts::Mean { sum: mse * pixels, weight: pixels })
        };
        let (value, _) = pool(Pooling::Decibels, [frame(0.01, 100.0), frame(0.0, 300.0)]);
        assert!((value.unwrap() - psnr_db(0.0025)).abs() < 1e-12);
        // Values from results give the same, from decibels and a weight.
        let read = |mse: f64, pixels: f64| {
            let value = psnr_db(mse);
            (Some(value), Parts::of_value(Pooling::Decibels, Some(value), pixels, 0.0))
        };
        let (value, _) = pool(Pooling::Decibels, [read(0.01, 100.0), read(0.0, 300.0)]);
        assert!((value.unwrap() - psnr_db(0.0025)).abs() < 1e-12);
        let identical = pool(Pooling::Decibels, [frame(0.0, 1.0), frame(0.0, 1.0)]);
        assert_eq!(identical.0, Some(f64::INFINITY));
    }

    #[test]
    fn a_deviation_of_parts_is_that_of_the_whole() {
        let values: Vec<f64> = (0..50).map(|i| f64::from(i * 37 % 50) * 0.02).collect();
        let parts = |values: &[f64]| {
            let (sum, squares) = values.iter().fold((0.0, 0.0), |(s, q), v| (s + v, q + v * v));
            let count = values.len() as f64;
            (deviation(count, sum, squares), Parts::Deviation { count, sum, squares })
        };
        let whole = parts(&values).0.unwrap();
        // 50 values at equal steps: N (N + 1) / 12 steps².
        assert!((whole - 0.02 * (50.0f64 * 51.0 / 12.0).sqrt()).abs() < 1e-12);
        let (left, right) = values.split_at(13);
        let (pooled, _) = pool(Pooling::Deviation, [parts(left), parts(right)]);
        assert!((pooled.unwrap() - whole).abs() < 1e-12);
        let read = |values: &[f64]| {
            let (value, count) = (parts(values).0.unwrap(), values.len() as f64);
            let mean = values.iter().sum::<f64>() / count;
            (Some(value), Parts::of_value(Pooling::Deviation, Some(value), count, mean))
        };
        let (pooled, _) = pool(Pooling::Deviation, [read(left), read(right)]);
        assert!((pooled.unwrap() - whole).abs() < 1e-12);
        // A single value has no deviation, but counts among others.
        let (one, rest) = values.split_at(1);
        let alone = || (None, Parts::of_value(Pooling::Deviation, None, 1.0, one[0]));
        let (pooled, _) = pool(Pooling::Deviation, [alone(), read(rest)]);
        assert!((pooled.unwrap() - whole).abs() < 1e-12);
        assert_eq!(pool(Pooling::Deviation, [alone()]).0, None);
        let two = [alone(), (None, Parts::Deviation { count: 1.0, sum: 2.0, squares: 4.0 })];
        let wanted = (one[0] - 2.0).abs() / 2f64.sqrt();
        assert!((pool(Pooling::Deviation, two).0.unwrap() - wanted).abs() < 1e-12);
        assert_eq!(deviation(1.0, 3.0, 9.0), None);
        assert_eq!(deviation(3.0, 3.0, 3.0), Some(0.0));
    }
}
