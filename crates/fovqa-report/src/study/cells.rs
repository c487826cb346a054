//! Numbers of a study's tables.

use fovqa_study::adjust;

use crate::plain_table::Cell;

/// What stands for an undefined value.
const UNDEFINED: &str = "–";
/// Smaller p-values are only said to be smaller.
const SMALLEST_P: f64 = 1e-4;

/// A number with about four digits.
pub(super) fn shown(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        None => UNDEFINED.to_owned(),
        Some(value) if value == 0.0 || (1e-3..1e6).contains(&value.abs()) => {
            let decimals = if value == 0.0 { 0.0 } else { 3.0 - value.abs().log10().floor() };
            let text = format!("{value:.*}", decimals.clamp(0.0, 6.0) as usize);
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        }
        Some(value) => format!("{value:.3e}"),
    }
}

/// A cell for a value that is not defined.
fn undefined() -> Cell {
    Cell { shown: UNDEFINED.to_owned(), value: String::new(), is_number: true }
}

/// A number with about four digits; in CSV with all of them.
pub(super) fn number(value: impl Into<Option<f64>>) -> Cell {
    let value = value.into();
    value.map_or_else(undefined, |value| Cell::number(shown(value), value))
}

/// A whole number.
pub(super) fn whole(count: impl ToString + Copy) -> Cell {
    let text = count.to_string();
    Cell { shown: text.clone(), value: text, is_number: true }
}

/// A whole number that may be undefined.
pub(super) fn whole_or(count: Option<impl ToString + Copy>) -> Cell {
    count.map_or_else(undefined, whole)
}

/// A p-value.
pub(super) fn p_value(p: Option<f64>) -> Cell {
    match p {
        None => undefined(),
        Some(p) if p < SMALLEST_P => Cell::named(format!("< {SMALLEST_P}"), format!("{p:?}")),
        Some(p) => Cell::number(format!("{p:.4}"), p),
    }
}

/// A number of participants in words.
pub(super) fn participants(count: usize) -> String {
    if count == 1 { "1 participant".to_owned() } else { format!("{count} participants") }
}

/// The stars of a p-value.
pub(super) fn stars(p: Option<f64>) -> Cell {
    Cell::text(adjust::stars(p))
}

/// An interval with defined limits.
pub(super) fn interval(limits: Option<[f64; 2]>) -> Cell {
    half_open(limits.map(|limits| limits.map(Some)))
}

/// An interval whose limits may be undefined. In CSV, an undefined limit is `null`.
pub(super) fn half_open(limits: Option<[Option<f64>; 2]>) -> Cell {
    let Some([low, high]) = limits.filter(|limits| limits.iter().any(Option::is_some)) else {
        return undefined();
    };
    let full = |limit: Option<f64>| limit.map_or_else(|| "null".to_owned(), |l| format!("{l:?}"));
    Cell::named(
        format!("[{}, {}]", shown(low), shown(high)),
        format!("[{}, {}]", full(low), full(high)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_about_four_digits() {
        let short = [0.0, 0.5, 0.012_345_6, 123.456, -2.0, 12_345.6, 1e-9, 1e9].map(shown);
        assert_eq!(short, ["0", "0.5", "0.01235", "123.5", "-2", "12346", "1.000e-9", "1.000e9"]);
        assert_eq!((shown(None), number(None).shown), ("–".into(), "–".into()));
        assert_eq!(p_value(Some(1e-9)), Cell::named("< 0.0001", "1e-9"));
        assert_eq!(half_open(Some([None, Some(2.0)])), Cell::named("[–, 2]", "[null, 2.0]"));
        assert_eq!(interval(None).value, "");
        assert_eq!(number(0.123_456_789).value, "0.123456789");
        assert_eq!((whole(12).shown, whole_or(None::<u64>).shown), ("12".into(), "–".into()));
    }
}
