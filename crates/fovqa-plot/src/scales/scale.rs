//! Converts values to shares of an axis: which values can be drawn, and the range that includes
//! them.
//!
//! Logarithms are computed by libm, so that they are bit-identical on every platform.

use libm::{log10, pow};

use crate::scales::ticks::{Tick, log_ticks, round_ticks};

/// A larger value is drawn as infinite, because a range between such values would not be finite.
const LARGEST: f64 = 1e300;

/// A smaller value is drawn as 0, because the steps of such a range would lose their digits.
const SMALLEST: f64 = 1e-280;

/// Values whose relative difference is smaller are drawn as equal, because f64 has no round numbers
/// between them.
const EQUAL: f64 = 1e-9;

/// The ends of the longest logarithmic range including its space; powers beyond them are not
/// representable.
const LOG_ENDS: (f64, f64) = (1e-300, 1e305);

/// The place of a value on an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum AxisPlace {
    /// On the axis.
    At(f64),
    /// Beyond the upper end.
    Above,
    /// Beyond the lower end.
    Below,
}

impl AxisPlace {
    /// The place of a value; `None` for NaN.
    pub(crate) fn of(value: f64) -> Option<Self> {
        match value {
            v if v.is_nan() => None,
            v if v > LARGEST => Some(Self::Above),
            v if v < -LARGEST => Some(Self::Below),
            v if v.abs() < SMALLEST => Some(Self::At(0.0)),
            v => Some(Self::At(v)),
        }
    }

    /// The value, if it is on the axis.
    pub(crate) fn finite(self) -> Option<f64> {
        match self {
            Self::At(value) => Some(value),
            Self::Above | Self::Below => None,
        }
    }
}

/// The values at the two ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// The value at the lower or left end.
    pub(crate) low: f64,
    /// The value at the upper or right end. It is above `low`, unless the axis runs downwards.
    pub(crate) high: f64,
    /// Whether the axis is logarithmic; both ends are then above 0.
    pub(crate) log: bool,
}

impl Scale {
    /// A range that includes these values, which are places on the axis; `None` without values. If
    /// they are all equal, the range has space on both sides.
    pub(crate) fn holding(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (v.min(low), v.max(high)));
        if low > high {
            return None;
        }
        let size = low.abs().max(high.abs());
        if high - low > size * EQUAL {
            return Some(Self::even(low, high));
        }
        let room = if size > 0.0 { size * 0.1 } else { 1.0 };
        Some(Self::even(low - room, high + room))
    }

    /// A logarithmic range that includes those values that are above 0; `None` if there are none.
    pub(crate) fn holding_log(values: impl Iterator<Item = f64>) -> Option<Self> {
        Some(Self { log: true, ..Self::holding(values.filter(|v| *v > 0.0))? })
    }

    /// A linear range.
    pub(crate) fn even(low: f64, high: f64) -> Self {
        Self { low, high, log: false }
    }

    /// A range that includes 0 and the values on both sides of it; `None` without values.
    pub(crate) fn from_zero(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values = values.peekable();
        values.peek()?;
        let (low, high) =
            values.fold((0.0, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
        Some(Self::even(low, if low < high { high } else { 1.0 }))
    }

    /// The given range; `None` if its ends are not finite numbers in order, if they are so close
    /// that there are no round numbers between them, or if they are not above 0 for a logarithmic
    /// range.
    pub(crate) fn between((low, high): (f64, f64), log: bool) -> Option<Self> {
        let end = |value: f64| AxisPlace::of(value).and_then(AxisPlace::finite);
        let (low, high) = (end(low)?, end(high)?);
        let apart = high - low > low.abs().max(high.abs()) * EQUAL;
        (apart && (!log || low > 0.0)).then_some(Self { low, high, log })
    }

    /// The range, extended at the lower and upper end by shares of its length.
    pub(crate) fn with_air(self, below: f64, above: f64) -> Self {
        if self.log {
            let (low, high) = (log10(self.low), log10(self.high));
            let end = |power: f64| pow(10.0, power).clamp(LOG_ENDS.0, LOG_ENDS.1);
            let (below, above) = (below * (high - low), above * (high - low));
            return Self { low: end(low - below), high: end(high + above), log: true };
        }
        let length = self.high - self.low;
        Self::even(self.low - below * length, self.high + above * length)
    }

    /// The finest ticks that `fits` accepts.
    pub(crate) fn ticks(self, fits: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
        let (low, high) = (self.low.min(self.high), self.low.max(self.high));
        if self.log { log_ticks(low, high, fits) } else { round_ticks(low, high, fits) }
    }

    /// The position of a value as a share of the axis: 0 at `low`, 1 at `high`. A value without a
    /// logarithm has the share minus infinity.
    pub(crate) fn share(self, value: f64) -> f64 {
        if self.log {
            if value <= 0.0 {
                return f64::NEG_INFINITY;
            }
            let low = log10(self.low);
            return (log10(value) - low) / (log10(self.high) - low);
        }
        (value - self.low) / (self.high - self.low)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn holds_what_can_be_drawn() {
        let scale = Scale::holding([3.0, -1.0].into_iter()).unwrap();
        assert_eq!((scale.low, scale.high), (-1.0, 3.0));
        assert_eq!([scale.share(-1.0), scale.share(1.0), scale.share(3.0)], [0.0, 0.5, 1.0]);
        let airy = scale.with_air(0.25, 0.5);
        assert_eq!((airy.low, airy.high), (-2.0, 5.0));
        assert!(Scale::holding(std::iter::empty()).is_none());
    }

    #[test]
    fn begins_at_zero_where_all_lie_on_one_side() {
        let ends = |values: &[f64]| {
            Scale::from_zero(values.iter().copied()).map(|scale| (scale.low, scale.high))
        };
        assert_eq!(ends(&[3.0, 2.0]), Some((0.0, 3.0)));
        assert_eq!(ends(&[-3.0, -2.0]), Some((-3.0, 0.0)));
        assert_eq!(ends(&[-3.0, 2.0]), Some((-3.0, 2.0)));
        assert_eq!((ends(&[0.0]), ends(&[])), (Some((0.0, 1.0)), None));
    }

    #[test]
    fn equal_values_stand_in_the_middle() {
        for value in [30.0, 0.0, -2e-9, 1e300, 1e-280] {
            let scale = Scale::holding([value, value].into_iter()).unwrap();
            assert!((scale.share(value) - 0.5).abs() < 1e-6, "{value}");
        }
    }

    #[test]
    fn equal_ratios_are_equal_lengths_of_a_logarithmic_range() {
        let scale = Scale::holding_log([-3.0, 0.0, 1.0, 1e4].into_iter()).unwrap();
        assert_eq!((scale.low, scale.high), (1.0, 1e4));
        assert!(
            (scale.share(10.0) - 0.25).abs() < 1e-12 && (scale.share(1e3) - 0.75).abs() < 1e-12
        );
        assert_eq!([scale.share(1.0), scale.share(1e4)], [0.0, 1.0]);
        assert_eq!(scale.share(0.0), f64::NEG_INFINITY);
        let airy = scale.with_air(0.25, 0.5);
        assert!((airy.low * 10.0 - 1.0).abs() < 1e-9 && (airy.high / 1e6 - 1.0).abs() < 1e-9);
        assert!(Scale::holding_log([-1.0, 0.0].into_iter()).is_none());
        for value in [3.0, 1e-280, 1e300] {
            let scale = Scale::holding_log([value].into_iter()).unwrap().with_air(0.1, 0.1);
            assert!(
                scale.low < value * 0.95 && scale.high > value * 1.05 && scale.high.is_finite()
            );
        }
        let widest = Scale::holding_log([1e-280, 1e300].into_iter()).unwrap().with_air(0.1, 0.1);
        assert!(widest.low > 0.0 && widest.high.is_finite());
    }

    #[test]
    fn given_ranges_are_in_order() {
        assert_eq!(Scale::between((-1.0, 2.0), false), Some(Scale::even(-1.0, 2.0)));
        for ends in [(2.0, 2.0), (2.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY), (0.0, 1e-300)] {
            assert_eq!(Scale::between(ends, false), None, "{ends:?}");
        }
        assert!(Scale::between((0.1, 2.0), true).is_some_and(|scale| scale.log));
        assert_eq!(Scale::between((0.0, 2.0), true), None);
    }

    #[test]
    fn what_cannot_be_drawn() {
        assert_eq!(AxisPlace::of(f64::NAN), None);
        assert_eq!(AxisPlace::of(f64::INFINITY), Some(AxisPlace::Above));
        assert_eq!(AxisPlace::of(f64::MIN), Some(AxisPlace::Below));
        assert_eq!(AxisPlace::of(5e-324), Some(AxisPlace::At(0.0)));
        assert_eq!(AxisPlace::of(7.0).and_then(AxisPlace::finite), Some(7.0));
    }
}
