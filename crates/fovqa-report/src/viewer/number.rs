//! Numbers as the viewer's script reads them.

use serde::{Serialize, Serializer};

/// A value: a number, `"inf"`, `"-inf"`, or `null` where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Number(pub(super) Option<f64>);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Some(value) if value.is_nan() => serializer.serialize_none(),
            Some(value) if value.is_infinite() => {
                serializer.serialize_str(if value > 0.0 { "inf" } else { "-inf" })
            }
            Some(value) => serializer.serialize_f64(short(value)),
            None => serializer.serialize_none(),
        }
    }
}

/// A number of seven digits: more than anybody reads, and half as long.
fn short(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// A position in hundredths of a pixel.
pub(super) fn hundredths(px: f64) -> f64 {
    (px * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_infinity_is_a_word() {
        let json = |value| serde_json::to_string(&Number(value)).unwrap();
        assert_eq!(json(Some(31.234_567_891)), "31.23457");
        assert_eq!(json(Some(1.0 / 3.0e6)), "3.333333e-7");
        assert_eq!(json(Some(f64::INFINITY)), "\"inf\"");
        assert_eq!(json(Some(f64::NEG_INFINITY)), "\"-inf\"");
        assert_eq!([json(Some(f64::NAN)), json(None)], ["null", "null"]);
    }
}
