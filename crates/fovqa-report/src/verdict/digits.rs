//! Numbers of verdicts: short, but with as many digits as tell a value apart from its limit.

/// Digits after the decimal point, or of the mantissa of a small number, if no more are needed.
const USUAL: i32 = 4;
/// More digits than this tell nothing: a 64-bit float has no more.
const MOST: i32 = 15;
/// Numbers below this are written with an exponent.
const SMALL: f64 = 0.01;

/// A value in the usual short form.
pub(crate) fn number(value: f64) -> String {
    written(value, USUAL)
}

/// A value and its limit with the same digits: as many as the limit is given with, and as many as tell the
/// two apart.
pub(super) fn beside(value: f64, limit: f64) -> [String; 2] {
    let digits = digits_of(limit).max(digits_between(value, limit)).clamp(USUAL, MOST);
    [value, limit].map(|number| written(number, digits))
}

/// Digits after the decimal point of a number that somebody has written: one with few digits.
fn digits_of(number: f64) -> i32 {
    const FEW: usize = 9;
    let text = number.to_string();
    let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    let significant = text.chars().filter(char::is_ascii_digit).collect::<String>();
    let is_short = significant.trim_start_matches('0').len() <= FEW;
    if is_short { digits as i32 } else { 0 }
}

/// Digits after the decimal point with which two numbers differ by ten units of the last one or more.
fn digits_between(a: f64, b: f64) -> i32 {
    let apart = (a - b).abs();
    if apart == 0.0 || !apart.is_finite() {
        return 0;
    }
    1 - libm::floor(libm::log10(apart)) as i32
}

/// A number with so many digits after the decimal point; a small one with an exponent and the digits that
/// are as precise, but at least four.
fn written(value: f64, digits: i32) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    let short = if value != 0.0 && value.abs() < SMALL {
        let exponent = libm::floor(libm::log10(value.abs())) as i32;
        let digits = (digits + exponent).clamp(USUAL - 1, MOST);
        format!("{value:.*e}", digits as usize)
    } else {
        format!("{value:.*}", digits as usize)
    };
    if short.parse::<f64>().is_ok_and(|back| back.to_bits() == value.to_bits()) {
        return value.to_string();
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_told_apart_from_its_limit() {
        for (value, limit, expected) in [
            (27.620_378_390, 26.0, ["27.6204", "26"]),
            (0.999_93, 0.999_95, ["0.99993", "0.99995"]),
            (0.999_949_96, 0.999_95, ["0.99994996", "0.99995"]),
            (30.000_000_1, 30.0, ["30.0000001", "30"]),
            (0.931_517_840_771_964_2, 0.926_860_251_568_104_4, ["0.9315", "0.9269"]),
            (1.234_567_89e-5, 1.234_567_1e-5, ["0.0000123456789", "0.000012345671"]),
            (f64::INFINITY, 30.0, ["inf", "30"]),
            (30.0, 30.0, ["30", "30"]),
            (3.0e-3, 0.05, ["0.003", "0.05"]),
        ] {
            let [shown, of] = beside(value, limit);
            assert_eq!([shown.as_str(), of.as_str()], expected);
            assert!(value.to_bits() == limit.to_bits() || shown != of);
        }
        assert_eq!(number(0.123_456_7), "0.1235");
        assert_eq!(number(1.234_567e-5), "1.235e-5");
        assert_eq!(number(28.0), "28");
    }
}
