//! Numbers as labels: decimals alike along an axis, powers of ten where zeros would not be read.

/// Above it, and with few digits, a number is written with a power of ten: 2×10⁶.
const LARGE: f64 = 1e6;

/// Below it, and with more than [`SMALL_DECIMALS`] decimals, a number is written with a power of
/// ten: 2×10⁻⁶, but 0.00002.
const SMALL: f64 = 1e-3;

/// The most decimals a small number is written with.
const SMALL_DECIMALS: i32 = 5;

/// More digits than this after the first say that differences matter, not size.
const FEW_DIGITS: i32 = 5;

/// Digits of a value beside its mark.
const VALUE_DIGITS: i32 = 3;

/// How the numbers of one axis are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// With so many decimals.
    Plain { decimals: usize },
    /// As a multiple of ten to the `exponent`.
    Power { exponent: i32, decimals: usize },
}

/// The power of ten of a number's first digit; 0 for 0. Read from its digits, since a logarithm
/// may be off by one at a power of ten, and differs between machines.
pub(crate) fn exponent(value: f64) -> i32 {
    let text = format!("{value:e}");
    text.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// The power of ten of a number's last digit other than 0; 0 for 0.
pub(crate) fn last_digit(value: f64) -> i32 {
    let text = format!("{value:e}");
    let mantissa = text.split_once('e').map_or("", |(mantissa, _)| mantissa);
    exponent(value) - mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32)
}

/// Ten to the `n`, as exact as it can be.
pub(crate) fn power_of_ten(n: i32) -> f64 {
    format!("1e{n}").parse().unwrap_or(f64::INFINITY)
}

impl Format {
    /// For numbers up to `largest` (in magnitude) whose last digit counts ten to the `last_digit`.
    pub(crate) fn new(largest: f64, last_digit: i32) -> Self {
        let first = exponent(largest);
        let digits = (first - last_digit).max(0);
        let decimals = (-last_digit).max(0);
        let plain = if largest >= LARGE {
            digits > FEW_DIGITS && largest < 1e15
        } else {
            largest >= SMALL || largest == 0.0 || decimals <= SMALL_DECIMALS
        };
        if plain {
            return Self::Plain { decimals: decimals as usize };
        }
        // Whole multiples of the last digit's power, while they are short.
        let exponent = if digits < 2 { last_digit } else { first };
        Self::Power { exponent, decimals: (exponent - last_digit).max(0) as usize }
    }

    /// For values beside their marks: three digits of the largest, the same for all.
    pub(crate) fn of_values(values: impl Iterator<Item = f64>) -> Self {
        let largest = values.filter(|v| v.is_finite()).fold(0.0, |most: f64, v| most.max(v.abs()));
        let finest = exponent(largest) - VALUE_DIGITS + 1;
        // Whole numbers are written out up to a million.
        Self::new(largest, if largest < LARGE { finest.min(0) } else { finest })
    }

    /// The label of a number.
    pub(crate) fn label(self, value: f64) -> String {
        match self {
            Self::Plain { decimals } => plain(value, decimals),
            Self::Power { .. } if value == 0.0 => "0".to_owned(),
            Self::Power { exponent, decimals } => {
                // In two steps: ten to the 300 and beyond is no number of its own.
                let half = exponent / 2;
                let mantissa = value / power_of_ten(half) / power_of_ten(exponent - half);
                format!("{}×10{}", plain(mantissa, decimals), superscript(exponent))
            }
        }
    }
}

fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        // "-0.0" is 0.
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    exponent.to_string().chars().map(raise).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(value: f64, largest: f64, last_digit: i32) -> String {
        Format::new(largest, last_digit).label(value)
    }

    #[test]
    fn labels_as_people_write_them() {
        assert_eq!(written(30.0, 40.0, 0), "30");
        assert_eq!(written(-2.5, 5.0, -1), "−2.5");
        assert_eq!(written(-0.0, 5.0, -1), "0.0");
        assert_eq!(written(0.00002, 0.00008, -5), "0.00002");
        assert_eq!(written(2e-6, 1e-5, -6), "2×10⁻⁶");
        assert_eq!(written(1e-5, 1e-5, -6), "10×10⁻⁶");
        assert_eq!(written(0.0, 1e-5, -6), "0");
        assert_eq!(written(-4e9, 4e9, 9), "−4×10⁹");
        assert_eq!(written(500_000.0, 900_000.0, 5), "500000");
        assert_eq!(written(1_000_000_002.0, 1_000_000_008.0, 0), "1000000002");
        assert_eq!(written(0.999_999_2, 0.999_999_8, -7), "0.9999992");
        assert_eq!(written(2e299, 8e299, 299), "2×10²⁹⁹");
        assert_eq!(written(3e-280, 8e-280, -280), "3×10⁻²⁸⁰");
    }

    #[test]
    fn values_have_three_digits() {
        let all = |values: [f64; 2]| {
            let format = Format::of_values(values.into_iter());
            values.map(|v| format.label(v))
        };
        assert_eq!(all([29.126, 8.0]), ["29.1", "8.0"]);
        assert_eq!(all([0.912_3, 0.05]), ["0.912", "0.050"]);
        assert_eq!(all([12_345.6, 1.0]), ["12346", "1"]);
        assert_eq!(all([1.234e-5, 1.0e-5]), ["1.23×10⁻⁵", "1.00×10⁻⁵"]);
        assert_eq!(all([f64::INFINITY, 0.0]).last().map(String::as_str), Some("0.00"));
    }

    #[test]
    fn first_and_last_digits() {
        for (value, first, last) in [(1000.0, 3, 3), (0.001, -3, -3), (-12.5, 1, -1), (0.0, 0, 0)] {
            assert_eq!((exponent(value), last_digit(value)), (first, last), "{value}");
        }
    }
}
