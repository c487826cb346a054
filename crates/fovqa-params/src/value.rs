//! The value of a parameter as a user writes it.

use serde::{Deserialize, Serialize};

/// The value of a parameter as a user writes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ParamValue {
    /// A number.
    Number(f64),
    /// A word.
    Text(String),
    /// A list of numbers.
    List(Vec<f64>),
    /// A list of pairs of numbers.
    Pairs(Vec<[f64; 2]>),
    /// `true` or `false`.
    Flag(bool),
}

impl ParamValue {
    /// The value as it is written in TOML.
    pub fn in_words(&self) -> String {
        match self {
            ParamValue::Number(n) => n.to_string(),
            ParamValue::Text(t) => format!("{t:?}"),
            ParamValue::List(l) => format!("{l:?}"),
            ParamValue::Pairs(p) => format!("{p:?}"),
            ParamValue::Flag(flag) => flag.to_string(),
        }
    }

    /// The number, if the value is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            ParamValue::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The flag, if the value is one.
    pub fn flag(&self) -> Option<bool> {
        match self {
            ParamValue::Flag(flag) => Some(*flag),
            _ => None,
        }
    }

    /// The list, if the value is one.
    pub fn list(&self) -> Option<Vec<f64>> {
        match self {
            ParamValue::List(list) => Some(list.clone()),
            _ => None,
        }
    }

    /// The pairs, if the value is a list of pairs. An empty list has no pairs.
    pub fn pairs(&self) -> Option<Vec<[f64; 2]>> {
        match self {
            ParamValue::Pairs(pairs) => Some(pairs.clone()),
            ParamValue::List(list) if list.is_empty() => Some(Vec::new()),
            _ => None,
        }
    }

    /// The word, if the value is one.
    pub fn text(&self) -> Option<&str> {
        match self {
            ParamValue::Text(text) => Some(text),
            _ => None,
        }
    }
}
