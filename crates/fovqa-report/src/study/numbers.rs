//! Numbers of a study's tables.

/// What stands for an undefined value.
const UNDEFINED: &str = "–";

/// A number with about four digits.
pub(super) fn number(value: impl Into<Option<f64>>) -> String {
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

/// A p-value.
pub(super) fn p_value(p: Option<f64>) -> String {
    match p {
        None => UNDEFINED.to_owned(),
        Some(p) if p < 1e-4 => "< 0.0001".to_owned(),
        Some(p) => format!("{p:.4}"),
    }
}

/// An interval with defined limits.
pub(super) fn interval(limits: Option<[f64; 2]>) -> String {
    half_open(limits.map(|limits| limits.map(Some)))
}

/// An interval whose limits may be undefined.
pub(super) fn half_open(limits: Option<[Option<f64>; 2]>) -> String {
    match limits {
        None | Some([None, None]) => UNDEFINED.to_owned(),
        Some([low, high]) => format!("[{}, {}]", number(low), number(high)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_about_four_digits() {
        let shown = [0.0, 0.5, 0.012_345_6, 123.456, -2.0, 12_345.6, 1e-9, 1e9].map(number);
        assert_eq!(shown, ["0", "0.5", "0.01235", "123.5", "-2", "12346", "1.000e-9", "1.000e9"]);
        assert_eq!((number(None), p_value(Some(1e-9))), ("–".into(), "< 0.0001".into()));
        assert_eq!(half_open(Some([None, Some(2.0)])), "[–, 2]");
        assert_eq!(interval(None), "–");
    }
}
