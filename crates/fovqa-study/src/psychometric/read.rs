//! The trials of a psychometric function in a table.

use super::levels::Level;
use crate::StudyError;
use crate::input::Data;
use crate::options::Sigmoid;

/// The most trials that a row may stand for. A bootstrap draws each of them.
const MOST_TRIALS: u64 = 10_000_000;

/// The trials of all rows. Without a column `trials`, a row is one trial.
///
/// # Errors
///
/// If a column is missing, a cell is no number of the right kind, or a level is not above 0 for
/// `weibull`.
pub(super) fn read(data: &Data, sigmoid: Sigmoid) -> Result<Vec<Level>, StudyError> {
    let (level, correct) = (data.column("level")?, data.column("correct")?);
    let trials = data.optional("trials")?;
    let mut rows = Vec::with_capacity(data.rows().len());
    for &row in data.rows() {
        let value = data.number(level, row)?;
        if sigmoid.is_logarithmic() && value <= 0.0 {
            let help = "use --sigmoid logistic or gaussian, or leave the level out with --where";
            return Err(data.wrong_cell(level, row, "above 0, as --sigmoid weibull needs", help));
        }
        let count = match trials {
            Some(trials) => data.count(trials, row)?,
            None => 1,
        };
        if let Some(trials) = trials.filter(|_| count > MOST_TRIALS) {
            let help = "divide the block into several rows if it really has that many trials";
            let wanted = format!("at most {MOST_TRIALS}");
            return Err(data.wrong_cell(trials, row, &wanted, help));
        }
        let right = correct
            .number(row)
            .filter(|right| right.fract() == 0.0 && (0.0..=count as f64).contains(right));
        let Some(right) = right else {
            let (wanted, help) = if trials.is_some() {
                (format!("a whole number from 0 to {count}, the trials of the row"), COUNT_HELP)
            } else {
                ("0 or 1".to_owned(), ANSWER_HELP)
            };
            return Err(data.wrong_cell(correct, row, &wanted, help));
        };
        rows.push(Level { level: value, correct: right as u64, trials: count });
    }
    Ok(rows)
}

const COUNT_HELP: &str = "write how many of the trials of the row were answered correctly";
const ANSWER_HELP: &str =
    "write 1 for a correct answer and 0 for a wrong one, or add a column trials for counts";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    fn levels(csv: &str, sigmoid: Sigmoid) -> Result<Vec<Level>, String> {
        let table = Table::read("t.csv", csv.as_bytes()).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        read(&data, sigmoid).map_err(|error| error.to_string())
    }

    #[test]
    fn rows_are_trials_or_blocks() {
        let one = levels("level,correct\n2,1\n3,0\n", Sigmoid::Logistic).unwrap();
        assert_eq!(one[1], Level { level: 3.0, correct: 0, trials: 1 });
        let block = levels("level,correct,trials\n2,7,9\n", Sigmoid::Weibull).unwrap();
        assert_eq!(block, [Level { level: 2.0, correct: 7, trials: 9 }]);
    }

    #[test]
    fn unusable_cells_are_errors() {
        let of = |csv, sigmoid| levels(csv, sigmoid).unwrap_err();
        let error = of("level,correct\n1,1\n0,1\n", Sigmoid::Weibull);
        assert!(error.contains("line 3") && error.contains("above 0"), "{error}");
        assert!(of("level,correct\n1,2\n", Sigmoid::Logistic).contains("0 or 1"));
        assert!(of("level,correct,trials\n1,5,4\n", Sigmoid::Logistic).contains("0 to 4"));
    }
}
