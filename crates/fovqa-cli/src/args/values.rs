//! Parses values that are more than one word: numbers with commas, and TOML literals.

use std::str::FromStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use fovqa_frame::Crop;
use fovqa_params::{ParamValue, Words};

/// A parser for the words of a type, with `-` between the parts of a word.
pub(crate) fn words<T: Words>() -> impl TypedValueParser<Value = T> {
    let option = |value: T| value.word().replace('_', "-");
    let value =
        move |value: T| PossibleValue::new(option(value)).alias(value.word()).help(value.about());
    let values = PossibleValuesParser::new(T::all().into_iter().map(value));
    values.map(move |word| {
        let is_it = |value: &T| word == value.word() || word == option(*value);
        T::all().into_iter().find(is_it).unwrap_or_else(|| unreachable!("it is one of them"))
    })
}

/// `N` numbers, separated by commas.
pub(crate) fn numbers<const N: usize>(text: &str, form: &str) -> Result<[f64; N], String> {
    let parsed: Result<Vec<f64>, _> =
        text.split(',').map(|part| f64::from_str(part.trim())).collect();
    let numbers: Option<[f64; N]> = parsed.ok().and_then(|list| list.try_into().ok());
    numbers
        .filter(|numbers| numbers.iter().all(|n| n.is_finite()))
        .ok_or_else(|| format!("write {form}"))
}

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    numbers::<1>(text, "a number").map(|[number]| number)
}

/// A number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    finite(text)
        .ok()
        .filter(|number| *number > 0.0)
        .ok_or_else(|| "write a number above 0".to_owned())
}

/// `X,Y,W,H` in whole pixels.
pub(crate) fn crop(text: &str) -> Result<Crop, String> {
    let parts: Result<Vec<usize>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match parts.as_deref() {
        Ok(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Crop { x, y, width, height }),
        _ => Err("write X,Y,W,H in whole pixels, W and H above 0".to_owned()),
    }
}

/// A TOML literal, otherwise the text itself.
pub(crate) fn literal(text: &str) -> Result<ParamValue, String> {
    let number = |value: &toml::Value| match value {
        toml::Value::Integer(n) => Some(*n as f64),
        toml::Value::Float(n) => Some(*n),
        _ => None,
    };
    let parsed = format!("value = {text}").parse::<toml::Table>().ok();
    let value =
        parsed.and_then(|mut table| if table.len() == 1 { table.remove("value") } else { None });
    match value {
        None => Ok(ParamValue::Text(text.to_owned())),
        Some(toml::Value::String(text)) => Ok(ParamValue::Text(text)),
        Some(toml::Value::Boolean(flag)) => Ok(ParamValue::Flag(flag)),
        Some(toml::Value::Array(list)) => {
            let numbers =
                |list: &[toml::Value]| list.iter().map(number).collect::<Option<Vec<_>>>();
            let pair = |item: &toml::Value| <[f64; 2]>::try_from(numbers(item.as_array()?)?).ok();
            let list_of = numbers(&list).map(ParamValue::List);
            list_of
                .or_else(|| list.iter().map(pair).collect::<Option<_>>().map(ParamValue::Pairs))
                .ok_or_else(|| {
                    "a list must contain only numbers, or only pairs of numbers".to_owned()
                })
        }
        Some(value) => number(&value)
            .map(ParamValue::Number)
            .ok_or_else(|| "write a number, a word or a list of numbers".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_are_toml_or_bare_words() {
        assert_eq!(literal("1.5"), Ok(ParamValue::Number(1.5)));
        assert_eq!(literal("3"), Ok(ParamValue::Number(3.0)));
        assert_eq!(literal("[0, 1.5]"), Ok(ParamValue::List(vec![0.0, 1.5])));
        assert_eq!(
            literal("[[0, 1], [30, 0.5]]"),
            Ok(ParamValue::Pairs(vec![[0.0, 1.0], [30.0, 0.5]]))
        );
        assert_eq!(literal("acuity"), Ok(ParamValue::Text("acuity".into())));
        assert_eq!(literal("\"acuity\""), Ok(ParamValue::Text("acuity".into())));
        assert_eq!(literal("true"), Ok(ParamValue::Flag(true)));
        assert_eq!(literal("1\nother = 2"), Ok(ParamValue::Text("1\nother = 2".into())));
        for bad in ["[1, \"a\"]", "[[1, 2], [3]]", "[1, [2, 3]]"] {
            assert!(literal(bad).is_err(), "{bad}");
        }
        assert!(literal("{ a = 1 }").is_err());
    }

    #[test]
    fn numbers_come_in_the_right_count() {
        assert_eq!(numbers::<2>("1, 2.5", ""), Ok([1.0, 2.5]));
        for bad in ["1", "1,2,3", "a,b", "1,nan", "1,inf", ""] {
            assert!(numbers::<2>(bad, "X,Y").is_err(), "{bad}");
        }
        assert!(crop("0,0,10,0").is_err());
        assert!(positive("0").is_err());
    }
}
