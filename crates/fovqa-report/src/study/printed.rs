//! A paper's numbers beside the results of an analysis.

use fovqa_plan::PrintedNumber;
use fovqa_study::Analysis;
use serde::Serialize;
use serde_json::Value;
use thiserror::Error;

use super::cells::{number, shown};
use super::parts::Part;
use crate::plain_table::{Cell, Column, PlainTable};
use crate::printed::{Printed, PrintedVerdict};

/// A printed number and the result that it is compared with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResultOfPrinted {
    /// What it is.
    pub quantity: String,
    /// Where it is printed; may be empty.
    pub place: String,
    /// As it is printed.
    pub printed: String,
    /// The place of the result in the JSON of the analysis.
    pub at: String,
    /// The result in the unit of the printed number; `None` if it is undefined.
    pub computed: Option<f64>,
    /// What is to be said of it.
    pub verdict: &'static str,
    /// Why they differ; may be empty.
    pub note: String,
}

/// A printed number without a result.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the printed number {quantity:?} has {wrong}")]
pub struct NoResult {
    /// What the number is.
    pub quantity: String,
    /// What is wrong with it.
    pub wrong: String,
}

/// The results that printed numbers are compared with.
///
/// # Errors
/// The first number whose place in the JSON of the analysis has no number.
pub fn printed_results(
    analysis: &Analysis,
    printed: &[PrintedNumber],
) -> Result<Vec<ResultOfPrinted>, NoResult> {
    if printed.is_empty() {
        return Ok(Vec::new());
    }
    let json = serde_json::to_value(analysis).unwrap_or_default();
    let result = |number: &PrintedNumber| {
        let computed = match json.pointer(&number.at) {
            None => Err("nothing"),
            Some(Value::Null) => Ok(None),
            Some(value) => value.as_f64().map(Some).ok_or(match value {
                Value::String(_) => "a text",
                _ => "no number",
            }),
        };
        let computed = computed.map_err(|found| NoResult {
            quantity: number.quantity.clone(),
            wrong: format!("at = {:?}, where there is {found}", number.at),
        })?;
        let printed = as_printed(&number.value).ok_or_else(|| NoResult {
            quantity: number.quantity.clone(),
            wrong: format!(
                "value = {:?}, which is no number as papers print it (.637, < .01, 14.8 %)",
                number.value
            ),
        })?;
        // Shares are printed in percent.
        let is_percent = printed.unit().trim() == "%";
        let computed = computed.map(|value| if is_percent { 100.0 * value } else { value });
        let verdict = match computed.map(|value| printed.verdict(value)) {
            Some(PrintedVerdict::Reproduced) if !number.independent => {
                PrintedVerdict::NotIndependent
            }
            Some(verdict) => verdict,
            None => PrintedVerdict::NotReproduced,
        };
        Ok(ResultOfPrinted {
            quantity: number.quantity.clone(),
            place: number.place.clone(),
            printed: number.value.clone(),
            at: number.at.clone(),
            computed,
            verdict: verdict.words(),
            note: number.note.clone(),
        })
    };
    printed.iter().map(result).collect()
}

/// A number as papers print it: `.637`, `p < .01`, `<.001`, `≤ 5`, `14.8 %`. `None` if a text is none.
fn as_printed(text: &str) -> Option<Printed> {
    let text = text.trim();
    let number = text.strip_prefix(['p', 'P']).map_or(text, |rest| {
        let rest = rest.trim_start();
        rest.strip_prefix('=').unwrap_or(rest).trim_start()
    });
    let bounds = [("<=", "up to "), ("≤", "up to "), ("<", "< "), (">", "> ")];
    let bound =
        bounds.into_iter().find_map(|(sign, word)| Some((word, number.strip_prefix(sign)?)));
    let (word, digits) = bound.unwrap_or(("", number));
    let printed = Printed::new(&format!("{word}{}", digits.trim_start()));
    // `0,681` would be 681.
    let digits = digits.trim_start();
    let is_decimal_comma = digits.starts_with("0,");
    let has_unit = |unit: &str| unit.chars().all(|c| c.is_alphabetic() || " %°".contains(c));
    let fits = printed.value().is_finite() && has_unit(printed.unit()) && !is_decimal_comma;
    // An exponent looks like a unit.
    let is_power = printed.unit().starts_with(['e', 'E']);
    (fits && !is_power).then_some(printed)
}

/// The table of printed numbers; `None` if there is none.
pub(super) fn part(results: &[ResultOfPrinted]) -> Option<Part> {
    if results.is_empty() {
        return None;
    }
    let error = |result: &ResultOfPrinted| {
        let relative = as_printed(&result.printed)?.relative_error(result.computed?)?;
        Some(100.0 * relative).filter(|error| error.is_finite())
    };
    let row = |result: &ResultOfPrinted| {
        let error = error(result).map_or_else(
            || Cell::named("–", ""),
            |error| Cell::number(percent(error), error / 100.0),
        );
        vec![
            Cell::text(&result.place),
            Cell::text(&result.quantity),
            Cell::text(&result.printed),
            computed(result),
            error,
            Cell::text(result.verdict),
            Cell::text(&result.note),
        ]
    };
    let mut columns = vec![
        Column::new("Place", "place"),
        Column::new("Quantity", "quantity").repeated(),
        Column::new("Printed", "printed"),
        Column::new("Computed", "computed"),
        Column::new("Relative error", "relative_error"),
        Column::new("Verdict", "verdict"),
        Column::new("Why", "note"),
    ];
    let mut rows: Vec<Vec<Cell>> = results.iter().map(row).collect();
    for (index, is_empty) in [
        (6, results.iter().all(|result| result.note.is_empty())),
        (0, results.iter().all(|result| result.place.is_empty())),
    ] {
        if is_empty {
            columns.remove(index);
            for row in &mut rows {
                row.remove(index);
            }
        }
    }
    let notes = vec![
        "Reproduced: the computed number, rounded, gives the printed digits, or keeps the printed bound. \
         Close: it is within 0.1 %. Not independent: it gives them, but the data were made from them."
            .to_owned(),
    ];
    let table = PlainTable { caption: "Printed numbers".to_owned(), columns, rows, notes };
    Some(Part::Table { name: "printed", detail: String::new(), table })
}

/// A result with more decimals than the printed number.
fn computed(result: &ResultOfPrinted) -> Cell {
    let Some(value) = result.computed else { return number(None) };
    let short = shown(value);
    let decimals = |text: &str| {
        let behind = text.split_once('.').map_or("", |(_, behind)| behind);
        behind.chars().take_while(char::is_ascii_digit).count()
    };
    let wanted = decimals(&result.printed) + 1;
    if short.contains('e') || decimals(&short) >= wanted || decimals(&result.printed) == 0 {
        return Cell::number(short, value);
    }
    Cell::number(format!("{value:.wanted$}"), value)
}

/// A relative error with two digits.
fn percent(error: f64) -> String {
    // Less than this is the rounding of the computation.
    const NOTHING: f64 = 1e-6;
    if error.abs() < NOTHING {
        return "0 %".to_owned();
    }
    let decimals = (1.0 - error.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{error:+.decimals$} %")
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_study::options::Alternative;
    use fovqa_study::plan::{PairsOptions, plan_pairs};

    fn compared(value: &str, at: &str) -> Result<Vec<ResultOfPrinted>, NoResult> {
        let options = PairsOptions {
            share: 0.65,
            alpha: 0.05,
            power: 0.8,
            alternative: Alternative::TwoSided,
            trials: Some(72),
            width: None,
        };
        let plan = Analysis::PlanPairs(plan_pairs(&options, &fovqa_study::Settings::default()));
        let number = PrintedNumber {
            quantity: "trials".to_owned(),
            place: String::new(),
            value: value.to_owned(),
            at: at.to_owned(),
            note: String::new(),
            independent: value != "90.0",
        };
        printed_results(&plan, &[number])
    }

    #[test]
    fn results_are_found_by_their_place() {
        // docs/studies.md: 90 trials, and a power of 0.7178 with 72.
        let found = |value: &str, at: &str| compared(value, at).unwrap()[0].clone();
        assert_eq!(found("90", "/trials").verdict, "reproduced");
        assert_eq!(found("90.0", "/trials").verdict, "not independent");
        assert_eq!(found("91", "/trials").verdict, "not reproduced");
        assert_eq!(found("< 91", "/trials").verdict, "reproduced");
        let percent = found("71.8 %", "/power_at_trials");
        assert_eq!(percent.verdict, "reproduced");
        assert!((percent.computed.unwrap() - 71.78).abs() < 0.01);
        let undefined = found("1", "/trials_for_width");
        assert_eq!((undefined.verdict, undefined.computed), ("not reproduced", None));
    }

    #[test]
    fn places_without_a_number_are_errors() {
        assert_eq!(
            compared("1", "/nothing").unwrap_err().wrong,
            "at = \"/nothing\", where there is nothing"
        );
        assert_eq!(
            compared("1", "/plan").unwrap_err().wrong,
            "at = \"/plan\", where there is a text"
        );
        assert!(compared("1", "/excluded").unwrap_err().wrong.ends_with("there is no number"));
        for wrong in ["abc", "NS", "0,681", "1e400", "6.81e-1", "0.68 ± 0.05", ".681*", ""] {
            assert!(as_printed(wrong).is_none(), "{wrong}");
            assert!(compared(wrong, "/trials").unwrap_err().wrong.contains("value = "), "{wrong}");
        }
        let verdict = |text: &str| compared(text, "/power").unwrap()[0].verdict;
        // The power is 0.8123.
        for right in ["<.9", "p < .9", "≤ .9", "<= .9", "p = .812", "> .8", "81.2 %", " .812 "] {
            assert_eq!(verdict(right), "reproduced", "{right}");
        }
        assert_eq!(verdict("<.8"), "not reproduced");
    }

    #[test]
    fn results_have_more_decimals_than_printed_numbers() {
        let of = |printed: &str, value: f64| {
            let mut result = compared("90", "/trials").unwrap().remove(0);
            (result.printed, result.computed) = (printed.to_owned(), Some(value));
            computed(&result).shown
        };
        assert_eq!(of("28.315", 28.315), "28.3150");
        assert_eq!(of(".637", 0.640_876), "0.6409");
        assert_eq!(of("12", 12.0), "12");
        assert_eq!(of("< .01", 0.012_77), "0.01277");
        assert_eq!(of("68.1 %", 68.055_6), "68.06");
    }

    #[test]
    fn errors_have_two_digits() {
        let shown = [4.6e-12, 0.6071, -14.3, 0.065_26, -0.000_13].map(percent);
        assert_eq!(shown, ["0 %", "+0.61 %", "-14 %", "+0.065 %", "-0.00013 %"]);
    }

    #[test]
    fn empty_columns_are_left_out() {
        let results = compared("90", "/trials").unwrap();
        let Some(Part::Table { table, .. }) = part(&results) else { panic!() };
        let expected =
            "quantity,printed,computed,relative_error,verdict\ntrials,90,90.0,0.0,reproduced\n";
        assert_eq!(table.csv(), expected);
        assert_eq!(part(&[]), None);
    }
}
