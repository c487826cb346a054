//! Numbers as labels: the same number of decimals along an axis, and powers of ten where there
//! would be too many zeros.

/// A larger number with few digits is written with a power of ten: 2×10⁶.
const LARGE: f64 = 1e6;

/// A smaller number with more than [`SMALL_DECIMALS`] decimals is written with a power of ten:
/// 2×10⁻⁶, but 0.00002.
const SMALL: f64 = 1e-3;

/// The largest number of decimals of a small number.
const SMALL_DECIMALS: i32 = 5;

/// If there are more digits than this after the first, differences matter rather than size.
const FEW_DIGITS: i32 = 5;

/// The number of digits of a value beside its mark.
const VALUE_DIGITS: i32 = 3;

/// The notation of the numbers of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// With this number of decimals.
    Plain { decimals: usize },
    /// As a multiple of ten to the `exponent`.
    Power { exponent: i32, decimals: usize },
}

/// The power of ten of a number's first digit; 0 for 0. It is read from the number's digits,
/// because a logarithm may be off by one at a power of ten and differs between machines.
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

/// Ten to the power of `n`, as exact as a float can be.
pub(crate) fn power_of_ten(n: i32) -> f64 {
    format!("1e{n}").parse().unwrap_or(f64::INFINITY)
}

impl Format {
    /// The notation for numbers with magnitudes up to `largest`, whose last digit has the power of
    /// ten `last_digit`.
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
        // Whole multiples of the last digit's power, as long as they are short.
        let exponent = if digits < 2 { last_digit } else { first };
        Self::Power { exponent, decimals: (exponent - last_digit).max(0) as usize }
    }

    /// The notation for values beside their marks: three digits of the largest value, the same
    /// decimals for all.
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
                // The division is done in two steps, because powers of ten beyond 300 are not
                // representable.
                let half = exponent / 2;
                let mantissa = value / power_of_ten(half) / power_of_ten(exponent - half);
                format!("{}×10{}", plain(mantissa, decimals), superscript(exponent))
            }
        }
    }
}

/// A power of ten: 10⁻³, or 1.
pub(crate) fn power_label(exponent: i32) -> String {
    if exponent == 0 { "1".to_owned() } else { format!("10{}", superscript(exponent)) }
}

fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        // "-0.0" is written as 0.
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
    fn powers_of_ten() {
        assert_eq!([-6, 0, 2].map(power_label), ["10⁻⁶", "1", "10²"]);
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
