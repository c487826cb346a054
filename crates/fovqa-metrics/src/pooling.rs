//! How values are put together: bands of a frame, the two eyes, the frames of a sequence. A metric says
//! once, beside its code, how each of its statistics pools ([`Statistic`]); this is the one place where it is
//! done ([`pool`]).

use crate::fidelity::{mse_of_db, psnr_db};

/// A statistic of a metric: one of the numbers it gives of a frame, a band or a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Statistic {
    /// Its name in results; empty for the metric's own value.
    pub name: &'static str,
    /// How the bands of a frame are pooled.
    pub bands: Pooling,
    /// How the two eyes are.
    pub eyes: Pooling,
    /// How frames are, beside mean, smallest and largest value.
    pub frames: Pooling,
    /// What a band weighs where only results are at hand, which have no sums.
    pub weight: Weight,
    /// Whether it is a whole number: how many of something there are.
    pub is_count: bool,
    /// Whether the ratio of test to reference is of interest, in what is measured of each picture.
    pub has_ratio: bool,
    /// Whether it has a row in results; what has none is shown otherwise, or serves pooling alone.
    pub has_row: bool,
}

/// A way to put values together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pooling {
    /// They cannot be.
    None,
    /// The plain mean.
    Average,
    /// What was summed in all, over all that it was summed over.
    Mean,
    /// The same of squared errors with peak 1, in decibels.
    Decibels,
    /// The standard deviation of all that was measured, N - 1 in the divisor.
    Deviation,
    /// The largest.
    Max,
    /// The sum.
    Sum,
}

/// What a band weighs, by rows that results have beside a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// Its pixels.
    Pixels,
    /// Another statistic of the metric, of the same level.
    Statistic(&'static str),
    /// Of a deviation, how many values it is of and their mean.
    Moments {
        /// Statistic of the number.
        count: &'static str,
        /// Statistic of the mean.
        mean: &'static str,
    },
}

impl Statistic {
    /// The metric's own value: a score, of which means are taken.
    pub(crate) const VALUE: Self = Self::named("");

    /// A score of a name.
    pub(crate) const fn named(name: &'static str) -> Self {
        Self {
            name,
            bands: Pooling::None,
            eyes: Pooling::Average,
            frames: Pooling::Average,
            weight: Weight::Pixels,
            is_count: false,
            has_ratio: true,
            has_row: true,
        }
    }

    /// How many of something there are.
    pub(crate) const fn count(name: &'static str) -> Self {
        let of = Self { is_count: true, has_ratio: false, ..Self::named(name) };
        of.pooled(Pooling::Sum).over_frames(Pooling::Sum)
    }

    /// Pooled so over bands and eyes.
    pub(crate) const fn pooled(self, pooling: Pooling) -> Self {
        Self { bands: pooling, eyes: pooling, ..self }
    }

    /// Pooled so over bands.
    pub(crate) const fn over_bands(self, pooling: Pooling) -> Self {
        Self { bands: pooling, ..self }
    }

    /// Pooled so over eyes.
    pub(crate) const fn over_eyes(self, pooling: Pooling) -> Self {
        Self { eyes: pooling, ..self }
    }

    /// Pooled so over frames.
    pub(crate) const fn over_frames(self, pooling: Pooling) -> Self {
        Self { frames: pooling, ..self }
    }

    /// Weighed so where only results are at hand.
    pub(crate) const fn weighed_by(self, weight: Weight) -> Self {
        Self { weight, ..self }
    }

    /// Without a ratio of test to reference.
    pub(crate) const fn without_ratio(self) -> Self {
        Self { has_ratio: false, ..self }
    }

    /// Without a row in results.
    pub(crate) const fn without_row(self) -> Self {
        Self { has_row: false, ..self }
    }

    /// Whether frames have a value of all of them together that is not made of theirs.
    pub fn pools_frames(&self) -> bool {
        matches!(self.frames, Pooling::Mean | Pooling::Decibels | Pooling::Deviation)
    }

    /// Whether the largest of all frames stands for them.
    pub fn is_maximum(&self) -> bool {
        self.frames == Pooling::Max
    }
}

/// What it takes to pool a value without loss.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Parts {
    /// Nothing but the value.
    #[default]
    Value,
    /// Of a mean: what was summed, and over how much.
    Mean {
        /// The sum.
        sum: f64,
        /// What divides it.
        weight: f64,
    },
    /// Of a deviation: N, Σ and Σ².
    Deviation {
        /// How many values.
        count: f64,
        /// Their sum.
        sum: f64,
        /// The sum of their squares.
        squares: f64,
    },
}

impl Parts {
    /// The parts of a value as far as results tell: of a value and its weight or, of a deviation, how
    /// many values it is of and their mean.
    pub fn of_value(pooling: Pooling, value: f64, weight: f64, mean: f64) -> Self {
        match pooling {
            Pooling::Mean => Self::Mean { sum: value * weight, weight },
            Pooling::Decibels => Self::Mean { sum: mse_of_db(value) * weight, weight },
            Pooling::Deviation => {
                let squared = value * value * (weight - 1.0).max(0.0);
                let sum = mean * weight;
                Self::Deviation { count: weight, sum, squares: squared + mean * sum }
            }
            Pooling::None | Pooling::Average | Pooling::Max | Pooling::Sum => Self::Value,
        }
    }

    fn add(&mut self, other: &Self) {
        *self = match (*self, *other) {
            (Self::Mean { sum, weight }, Self::Mean { sum: other_sum, weight: other_weight }) => {
                Self::Mean { sum: sum + other_sum, weight: weight + other_weight }
            }
            (
                Self::Deviation { count, sum, squares },
                Self::Deviation { count: n, sum: s, squares: q },
            ) => Self::Deviation { count: count + n, sum: sum + s, squares: squares + q },
            _ => Self::Value,
        };
    }

    /// The value that they make; `None` where there is nothing to make it of.
    fn value(&self, pooling: Pooling) -> Option<f64> {
        match *self {
            Self::Value => None,
            Self::Mean { sum, weight } => {
                let mean = (weight > 0.0).then(|| sum / weight)?;
                Some(if pooling == Pooling::Decibels { psnr_db(mean) } else { mean })
            }
            Self::Deviation { count, sum, squares } => deviation(count, sum, squares),
        }
    }
}

/// The standard deviation of `count` values with this sum and this sum of squares; `None` of fewer than
/// two.
pub(crate) fn deviation(count: f64, sum: f64, squares: f64) -> Option<f64> {
    let squared = squares - sum * sum / count;
    (count >= 2.0).then(|| (squared.max(0.0) / (count - 1.0)).sqrt())
}

/// Puts values, each with its parts, together in the order they come. `None` for the value where there is
/// nothing to have one of, or where several cannot be put together. One alone stays what it is.
pub fn pool(
    pooling: Pooling,
    values: impl IntoIterator<Item = (Option<f64>, Parts)>,
) -> (Option<f64>, Parts) {
    let mut scored = values.into_iter().filter_map(|(value, parts)| Some((value?, parts)));
    let Some((first, mut parts)) = scored.next() else { return (None, Parts::Value) };
    let (mut count, mut sum, mut max) = (1.0, first, first);
    for (value, more) in scored {
        count += 1.0;
        sum += value;
        max = f64::max(max, value);
        parts.add(&more);
    }
    if count < 2.0 {
        return (Some(first), parts);
    }
    match pooling {
        Pooling::None => (None, Parts::Value),
        Pooling::Average => (Some(sum / count), Parts::Value),
        Pooling::Max => (Some(max), Parts::Value),
        Pooling::Sum => (Some(sum), Parts::Value),
        Pooling::Mean | Pooling::Decibels | Pooling::Deviation => (parts.value(pooling), parts),
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
    fn means_are_of_sums_and_scores_of_values() {
        let values = [mean(1.0, 4.0), mean(6.0, 12.0), (None, Parts::Value)];
        let (value, parts) = pool(Pooling::Mean, values);
        assert_eq!((value, parts), (Some(7.0 / 16.0), Parts::Mean { sum: 7.0, weight: 16.0 }));
        assert_eq!(pool(Pooling::Average, values).0, Some(0.375));
        assert_eq!(pool(Pooling::Max, values).0, Some(0.5));
        assert_eq!(pool(Pooling::Sum, values).0, Some(0.75));
        assert_eq!(pool(Pooling::None, values).0, None);
        assert_eq!(pool(Pooling::None, [values[0]]).0, Some(0.25), "one alone stays");
        assert_eq!(pool(Pooling::Mean, []).0, None);
    }

    #[test]
    fn decibels_are_of_the_error_not_of_the_decibels() {
        let frame = |mse: f64, pixels: f64| {
            (Some(psnr_db(mse)), Parts::Mean { sum: mse * pixels, weight: pixels })
        };
        let (value, _) = pool(Pooling::Decibels, [frame(0.01, 100.0), frame(0.0, 300.0)]);
        assert!((value.unwrap() - psnr_db(0.0025)).abs() < 1e-12);
        // As well of results, which have the decibels and a weight.
        let read = |mse: f64, pixels: f64| {
            let value = psnr_db(mse);
            (Some(value), Parts::of_value(Pooling::Decibels, value, pixels, 0.0))
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
            (Some(value), Parts::of_value(Pooling::Deviation, value, count, mean))
        };
        let (pooled, _) = pool(Pooling::Deviation, [read(left), read(right)]);
        assert!((pooled.unwrap() - whole).abs() < 1e-12);
        assert_eq!(deviation(1.0, 3.0, 9.0), None);
        assert_eq!(deviation(3.0, 3.0, 3.0), Some(0.0));
    }
}
