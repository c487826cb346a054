//! Numbers in a journal. They cover every value that a metric can have, including infinite and
//! missing ones.

use std::fmt;

pub(super) use fovqa_results::Number;
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::ser::{Serialize, Serializer};

/// One item in the list of a frame's values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Token {
    /// `null`: there is no value.
    Nothing,
    /// `true`: the value is the quotient of the two numbers that follow it.
    Mean,
    /// A number.
    Number(f64),
}

impl Serialize for Token {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Token::Nothing => serializer.serialize_unit(),
            Token::Mean => serializer.serialize_bool(true),
            Token::Number(number) => Number(number).serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Token {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TokenVisitor;
        impl Visitor<'_> for TokenVisitor {
            type Value = Token;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, \"inf\", \"-inf\", \"nan\", true or null")
            }
            fn visit_unit<E: Error>(self) -> Result<Token, E> {
                Ok(Token::Nothing)
            }
            fn visit_bool<E: Error>(self, mean: bool) -> Result<Token, E> {
                if mean { Ok(Token::Mean) } else { Err(E::custom("false is not a number")) }
            }
            fn visit_f64<E: Error>(self, number: f64) -> Result<Token, E> {
                Ok(Token::Number(number))
            }
            fn visit_u64<E: Error>(self, number: u64) -> Result<Token, E> {
                Ok(Token::Number(number as f64))
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<Token, E> {
                Ok(Token::Number(number as f64))
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Token, E> {
                match text {
                    "inf" => Ok(Token::Number(f64::INFINITY)),
                    "-inf" => Ok(Token::Number(f64::NEG_INFINITY)),
                    "nan" => Ok(Token::Number(f64::NAN)),
                    other => Err(E::custom(format!("{other:?} is not a number"))),
                }
            }
        }
        deserializer.deserialize_any(TokenVisitor)
    }
}

/// Converts a number that may be missing for writing.
pub(super) fn maybe(number: Option<f64>) -> Option<Number> {
    number.map(Number)
}

/// Converts a number that may be missing after reading.
pub(super) fn read(number: Option<Number>) -> Option<f64> {
    number.map(|number| number.0)
}
