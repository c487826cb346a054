//! The description of a parameter: its name, default, accepted values and meaning.

use crate::{ParamError, ParamValue};

/// The description of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParamInfo {
    /// The parameter's name.
    pub name: &'static str,
    /// The default, written as TOML.
    pub default: &'static str,
    /// The values it accepts.
    pub values: ParamValues,
    /// What it means, with its unit.
    pub about: &'static str,
}

/// The values that a parameter accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamValues {
    /// A number from the first bound to the second, both included.
    Number(f64, f64),
    /// A number within the bounds, or a word such as `off`.
    NumberOr(f64, f64, &'static str),
    /// A whole number from the first bound to the second, both included.
    Whole(u32, u32),
    /// A whole number within the bounds, or a word such as `auto`.
    WholeOr(u32, u32, &'static str),
    /// `true` or `false`.
    Flag,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A list of finite numbers.
    Numbers,
    /// A list of pairs of finite numbers, or a word such as `none`.
    PairsOr(&'static str),
}

impl std::fmt::Display for ParamValues {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(min, max) => write!(f, "{min} to {max}"),
            Self::NumberOr(min, max, word) => write!(f, "{min} to {max}, or {word}"),
            Self::Whole(min, max) => write!(f, "a whole number from {min} to {max}"),
            Self::WholeOr(min, max, word) => {
                write!(f, "a whole number from {min} to {max}, or {word}")
            }
            Self::Flag => f.write_str("true or false"),
            Self::Word(words) => f.write_str(&words.join(" or ")),
            Self::Numbers => f.write_str("a list of numbers"),
            Self::PairsOr(word) => write!(f, "a list of pairs of numbers, or {word}"),
        }
    }
}

impl ParamValues {
    /// Whether `value` is one of these values.
    pub fn accepts(&self, value: &ParamValue) -> bool {
        match (self, value) {
            (Self::Number(min, max) | Self::NumberOr(min, max, _), ParamValue::Number(n)) => {
                (*min..=*max).contains(n)
            }
            (Self::Whole(min, max) | Self::WholeOr(min, max, _), ParamValue::Number(n)) => {
                n.fract() == 0.0 && (f64::from(*min)..=f64::from(*max)).contains(n)
            }
            (
                Self::WholeOr(_, _, word) | Self::NumberOr(_, _, word) | Self::PairsOr(word),
                ParamValue::Text(text),
            ) => text == word,
            (Self::Flag, ParamValue::Flag(_)) => true,
            (Self::Word(words), ParamValue::Text(text)) => words.contains(&text.as_str()),
            (Self::Numbers, ParamValue::List(list)) => list.iter().all(|n| n.is_finite()),
            (Self::PairsOr(_), value) => {
                let finite = |pairs: Vec<[f64; 2]>| pairs.iter().flatten().all(|n| n.is_finite());
                value.pairs().is_some_and(finite)
            }
            _ => false,
        }
    }
}

/// Finds a parameter by name (`-` and `_` are alike) and checks its value. Words are returned in
/// the spelling of the parameter's list.
///
/// # Errors
/// When there is no such parameter, or the parameter does not accept the value.
pub fn find(
    owner: &'static str,
    params: &'static [ParamInfo],
    param: &str,
    value: &ParamValue,
) -> Result<(&'static ParamInfo, ParamValue), ParamError> {
    let name = param.replace('-', "_");
    let Some(known) = params.iter().find(|p| p.name == name) else {
        let names: Vec<_> = params.iter().map(|p| p.name).collect();
        let known = if names.is_empty() {
            "it has none".to_owned()
        } else {
            format!("it has {}", names.join(", "))
        };
        return Err(ParamError::Unknown { owner, param: param.to_owned(), known });
    };
    let value = match value {
        ParamValue::Text(text) => ParamValue::Text(text.replace('-', "_")),
        value => value.clone(),
    };
    if known.values.accepts(&value) {
        Ok((known, value))
    } else {
        Err(known.value_error(owner, &value))
    }
}

impl ParamInfo {
    /// The error for a value that this parameter does not accept.
    pub fn value_error(&self, owner: &'static str, value: &ParamValue) -> ParamError {
        ParamError::Value {
            owner,
            param: self.name,
            value: value.in_words(),
            expected: format!("{}; {}", self.about, self.values),
        }
    }

    /// The default as a value.
    pub fn default_value(&self) -> ParamValue {
        let default = self.default;
        if let Ok(flag) = default.parse::<bool>() {
            ParamValue::Flag(flag)
        } else if let Ok(number) = default.parse::<f64>() {
            ParamValue::Number(number)
        } else if let Some(list) = default.strip_prefix('[') {
            let numbers = list.trim_end_matches(']').split(',');
            ParamValue::List(numbers.filter_map(|n| n.trim().parse().ok()).collect())
        } else {
            ParamValue::Text(default.trim_matches('"').to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMS: &[ParamInfo] = &[
        ParamInfo { name: "a_b", default: "2", values: ParamValues::Number(1.0, 3.0), about: "x" },
        ParamInfo {
            name: "knots",
            default: "\"none\"",
            values: ParamValues::PairsOr("none"),
            about: "y",
        },
    ];

    #[test]
    fn names_and_words_take_either_dash() {
        let (info, value) = find("m", PARAMS, "a-b", &ParamValue::Number(1.5)).unwrap();
        assert_eq!((info.name, value), ("a_b", ParamValue::Number(1.5)));
        let error = find("m", PARAMS, "c", &ParamValue::Number(1.5)).unwrap_err();
        assert_eq!(error.to_string(), "m has no parameter \"c\"; it has a_b, knots");
        let error = find("m", PARAMS, "a_b", &ParamValue::Number(0.0)).unwrap_err();
        assert_eq!(error.to_string(), "m.a_b cannot be 0: x; 1 to 3");
    }

    #[test]
    fn pairs_are_pairs_or_the_word() {
        let values = ParamValues::PairsOr("none");
        assert!(values.accepts(&ParamValue::Text("none".into())));
        assert!(values.accepts(&ParamValue::Pairs(vec![[0.0, 1.0]])));
        assert!(!values.accepts(&ParamValue::Pairs(vec![[0.0, f64::NAN]])));
        assert!(!values.accepts(&ParamValue::List(vec![1.0])));
        assert_eq!(PARAMS[1].default_value(), ParamValue::Text("none".into()));
    }
}
