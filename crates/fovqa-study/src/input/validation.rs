//! Validation trials: trials with a known answer, which show whether a participant paid attention.

use super::data::Data;
use crate::StudyError;

/// The options `--validation-expected` and `--max-errors`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Validation {
    /// The value that a validation trial should have.
    pub expected: f64,
    /// The number of other values with which a participant is left out.
    pub max_errors: usize,
}

/// The data without validation rows, and the participants who were left out, by first appearance. A
/// row is a validation row if its cell in the column `validation` is 1. Without that column, no row
/// is one; without `rule`, no participant is left out.
///
/// # Errors
///
/// If `rule` is given and there is no validation column, a cell of that column is not 0, 1 or empty, a
/// value of a validation row is no number, or no row remains.
pub fn without_validation<'t>(
    data: &Data<'t>,
    rule: Option<Validation>,
) -> Result<(Data<'t>, Vec<String>), StudyError> {
    let column = match rule {
        Some(_) => Some(data.column("validation")?),
        None => data.optional("validation")?,
    };
    let Some(column) = column else { return Ok((data.clone(), Vec::new())) };
    let participants = data.levels("participant")?;
    let participant = data.column("participant")?;
    let value = data.column("value")?;
    let mut errors = vec![0_usize; participants.len()];
    let mut rows = Vec::new();
    for &row in data.rows() {
        let is_validation = match column.text(row) {
            "" => false,
            _ => match column.number(row) {
                Some(0.0) => false,
                Some(1.0) => true,
                _ => {
                    let help = "write 1 in rows of validation trials, and 0 or nothing in others";
                    return Err(data.wrong_cell(column, row, "0 or 1", help));
                }
            },
        };
        if !is_validation {
            rows.push(row);
        } else if let Some(rule) = rule {
            let is_wrong = (data.number(value, row)? - rule.expected).abs() > 0.0;
            errors[participants.of_row(participant, row)] += usize::from(is_wrong);
        }
    }
    let is_all_out = |rule: Validation| {
        !participants.is_empty() && errors.iter().all(|errors| *errors >= rule.max_errors)
    };
    if rule.is_some_and(is_all_out) {
        return Err(StudyError::Setting {
            message: "every participant is left out because of validation trials".to_owned(),
            help: "check --validation-expected, or raise --max-errors".to_owned(),
        });
    }
    let is_out = |index: usize| rule.is_some_and(|rule| errors[index] >= rule.max_errors);
    rows.retain(|&row| !is_out(participants.of_row(participant, row)));
    let names = participants.names().iter().enumerate();
    let excluded = names.filter(|(index, _)| is_out(*index)).map(|(_, name)| name.clone());
    Ok((data.with_rows(rows)?, excluded.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    #[test]
    fn participants_with_too_many_errors_are_left_out() {
        let csv = b"participant,value,validation\nP1,3,1\nP1,2,0\nP2,1,1\nP2,2,1\nP2,2,0\nP3,1,1\nP3,2,\n";
        let table = Table::read("v.csv", csv).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let (all, excluded) = without_validation(&data, None).unwrap();
        assert_eq!((all.rows(), excluded.len()), (&[1, 4, 6][..], 0));
        let rule = Validation { expected: 3.0, max_errors: 2 };
        let (kept, excluded) = without_validation(&data, Some(rule)).unwrap();
        assert_eq!((kept.rows(), excluded), (&[1, 6][..], vec!["P2".to_owned()]));
    }
}
