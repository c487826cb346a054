//! The ticks of an axis: round numbers at distances of 1, 2, 2.5 or 5 times a power of ten, as many
//! as fit.

use crate::scales::number::{Format, exponent, last_digit, power_of_ten};

/// The distances between ticks, with the power of ten of their last digit.
const STEPS: [(f64, i32); 4] = [(1.0, 0), (2.0, 0), (2.5, -1), (5.0, 0)];

/// The number of digits to which given ticks are rounded.
const MOST_DIGITS: i32 = 5;

/// The multiples of powers of ten that logarithmic ticks may be.
const LOG_MULTIPLES: [&[i32]; 2] = [&[1, 2, 5], &[1]];

/// The distances between powers that have a tick, in powers of ten.
const LOG_STEPS: [i32; 8] = [1, 2, 3, 5, 10, 20, 50, 100];

/// One tick of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    /// Its value.
    pub(crate) value: f64,
    /// Its label.
    pub(crate) label: String,
}

/// The finest ticks from `low` to `high` that `fits` accepts. If it accepts none, the first and the
/// last of the coarsest set with at least two ticks.
pub(crate) fn round_ticks(low: f64, high: f64, fits: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    let finest = exponent(high - low) - 2;
    let mut last = Vec::new();
    for power in finest..finest + 4 {
        for (multiple, digit) in STEPS {
            let ticks = every(low, high, multiple, power, power + digit);
            if ticks.len() < 2 && !last.is_empty() {
                return ends(last);
            }
            if ticks.len() >= 2 && fits(&ticks) {
                return ticks;
            }
            last = ticks;
        }
    }
    ends(last)
}

/// Ticks of a logarithmic axis from `low` to `high`, both above 0: at 1, 2 and 5 times powers of
/// ten if `fits` accepts them, or else only at powers, or at some of them. A range with fewer than
/// two of those has round numbers.
pub(crate) fn log_ticks(low: f64, high: f64, fits: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    let kinds = LOG_MULTIPLES.iter().flat_map(|multiples| {
        let every: &[i32] = if multiples.len() > 1 { &[1] } else { &LOG_STEPS };
        every.iter().map(move |every| (*multiples, *every))
    });
    let mut found = kinds.map(|(multiples, every)| at_powers(low, high, multiples, every));
    let fitting = found.find(|ticks| ticks.len() < 2 || fits(ticks));
    fitting.filter(|ticks| ticks.len() > 1).unwrap_or_else(|| round_ticks(low, high, fits))
}

fn at_powers(low: f64, high: f64, multiples: &[i32], every: i32) -> Vec<Tick> {
    /// Tolerance for rounding: a tick this far beyond the end counts as being at the end.
    const SLACK: f64 = 1e-9;
    let powers = (exponent(low)..=exponent(high)).filter(|power| power % every == 0);
    // The number is parsed from digits, which gives the nearest float.
    let value = |multiple: i32, power: i32| format!("{multiple}e{power}").parse::<f64>().ok();
    powers
        .flat_map(|power| multiples.iter().filter_map(move |multiple| value(*multiple, power)))
        .filter(|value| *value >= low * (1.0 - SLACK) && *value <= high * (1.0 + SLACK))
        .map(|value| Tick { value, label: Format::new(value, last_digit(value)).label(value) })
        .collect()
}

fn ends(mut ticks: Vec<Tick>) -> Vec<Tick> {
    if ticks.len() > 2 {
        ticks.drain(1..ticks.len() - 1);
    }
    ticks
}

fn every(low: f64, high: f64, multiple: f64, power: i32, last_digit: i32) -> Vec<Tick> {
    /// Tolerance for rounding, as a share of a step: a tick this far beyond the end counts as being
    /// at the end.
    const SLACK: f64 = 1e-9;
    let unit = power_of_ten(power.abs());
    // Multiplying or dividing by an exact power gives 0.3 and not 0.30000000000000004.
    let scaled = |count: f64| {
        if power < 0 { count * multiple / unit } else { count * multiple * unit }
    };
    let step = scaled(1.0);
    let (first, last) = ((low / step - SLACK).ceil(), (high / step + SLACK).floor());
    let format =
        Format::new(low.abs().max(high.abs()).min(scaled(first.abs().max(last.abs()))), last_digit);
    let count = (last - first).max(-1.0) as usize + usize::from(last >= first);
    (0..count)
        .map(|i| scaled(first + i as f64))
        .map(|value| Tick { value, label: format.label(value) })
        .collect()
}

/// Ticks at the given values, written with the same number of decimals.
pub(crate) fn given_ticks(places: &[f64]) -> Vec<Tick> {
    let mut values: Vec<f64> = places.iter().copied().filter(|v| v.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let largest = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let digit = values.iter().filter(|v| **v != 0.0).map(|v| last_digit(*v)).min().unwrap_or(0);
    let format = Format::new(largest, digit.max(exponent(largest) - MOST_DIGITS));
    values.into_iter().map(|value| Tick { value, label: format.label(value) }).collect()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        round_ticks(low, high, |t| t.len() <= most).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn ticks_are_at_round_numbers() {
        assert_eq!(labels(19.2, 40.8, 7), ["20", "25", "30", "35", "40"]);
        assert_eq!(labels(0.0, 60.0, 7), ["0", "10", "20", "30", "40", "50", "60"]);
        assert_eq!(labels(0.0, 10.0, 6), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(0.0, 10.0, 5), ["0.0", "2.5", "5.0", "7.5", "10.0"]);
        assert_eq!(labels(-0.31, 0.31, 7), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(0.0, 1e-5, 6), ["0", "2×10⁻⁶", "4×10⁻⁶", "6×10⁻⁶", "8×10⁻⁶", "10×10⁻⁶"]);
        assert_eq!(
            labels(0.0, 0.0001, 6),
            ["0.00000", "0.00002", "0.00004", "0.00006", "0.00008", "0.00010"]
        );
        assert_eq!(labels(0.0, 3e8, 4), ["0", "1×10⁸", "2×10⁸", "3×10⁸"]);
    }

    #[test]
    fn logarithmic_ticks_are_at_1_2_5_or_at_powers() {
        let labels = |low: f64, high: f64, most: usize| -> Vec<String> {
            let ticks = log_ticks(low, high, |t| t.len() <= most).into_iter();
            ticks.map(|t| t.label).collect()
        };
        assert_eq!(labels(0.4, 60.0, 9), ["0.5", "1", "2", "5", "10", "20", "50"]);
        assert_eq!(labels(0.1, 10.0, 7), ["0.1", "0.2", "0.5", "1", "2", "5", "10"], "both ends");
        assert_eq!(labels(0.04, 60.0, 9), ["0.1", "1", "10"]);
        assert_eq!(labels(1e-6, 1e6, 5), ["1×10⁻⁶", "0.001", "1", "1000", "1×10⁶"]);
        assert_eq!(labels(2.2, 4.4, 6), ["2.5", "3.0", "3.5", "4.0"], "none of them is in it");
        assert!(labels(1e-300, 1e305, 9).len() > 4 && !labels(1e-300, 1e305, 2).is_empty());
        assert_eq!(log_ticks(9e-6, 1.1e-5, |_| true)[0].value, 9e-6);
    }

    #[test]
    fn as_many_as_fit() {
        for most in 2..30 {
            let found = labels(3.7, 94.1, most).len();
            assert!(found <= most && found * 3 >= most, "{found} of {most}");
        }
        assert!(!labels(1.1, 1.9, 1).is_empty());
        assert!(!round_ticks(1.1, 1.9, |_| false).is_empty());
    }

    #[test]
    fn values_are_the_nearest_to_their_labels() {
        for tick in round_ticks(-0.97, 1.03, |t| t.len() < 30) {
            assert_eq!(tick.value, tick.label.replace('−', "-").parse::<f64>().unwrap());
        }
    }

    #[test]
    fn given_ones_are_sorted_and_alike() {
        let ticks = given_ticks(&[5.0, 0.0, f64::NAN, 2.5, 5.0]);
        let labels: Vec<_> = ticks.iter().map(|t| t.label.as_str()).collect();
        assert_eq!(labels, ["0.0", "2.5", "5.0"]);
        assert_eq!(given_ticks(&[1.0 / 3.0])[0].label, "0.333333");
        assert!(given_ticks(&[]).is_empty());
    }
}
