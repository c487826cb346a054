//! Mean scores of each participant and condition.

use crate::StudyError;
use crate::input::{Column, Data};

/// Means by participant and condition. A condition is the numbers in one or more columns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scores<const N: usize> {
    /// The conditions, ascending by the first column, then the next.
    pub(super) conditions: Vec<[f64; N]>,
    /// Per participant, by first appearance: the conditions with scores, ascending, and the means.
    pub(super) means: Vec<Vec<(usize, f64)>>,
}

impl<const N: usize> Scores<N> {
    /// Reads the column `value` and those of the conditions.
    ///
    /// # Errors
    ///
    /// If a column is missing or a cell is no number.
    pub(super) fn read(data: &Data, columns: [&str; N]) -> Result<Self, StudyError> {
        let participants = data.levels("participant")?;
        let participant = data.column("participant")?;
        let value = data.column("value")?;
        let columns: Vec<&Column> =
            columns.iter().map(|role| data.column(role)).collect::<Result<_, _>>()?;
        let mut rows = Vec::with_capacity(data.rows().len());
        for &row in data.rows() {
            let mut condition = [0.0; N];
            for (number, column) in condition.iter_mut().zip(&columns) {
                // Zero has one sign only.
                *number = data.number(column, row)? + 0.0;
            }
            let score = data.number(value, row)?;
            rows.push((participants.of_row(participant, row), condition, score));
        }
        let mut conditions: Vec<[f64; N]> = rows.iter().map(|row| row.1).collect();
        conditions.sort_by(compare);
        conditions.dedup_by(|a, b| compare(a, b).is_eq());
        let mut scores = vec![Vec::new(); participants.len()];
        for (participant, condition, score) in rows {
            let index = conditions.partition_point(|other| compare(other, &condition).is_lt());
            scores[participant].push((index, score));
        }
        let means = scores.into_iter().map(means_by_condition).collect();
        Ok(Self { conditions, means })
    }

    /// Per condition: the means of the participants who have scores of it.
    pub(super) fn by_condition(&self) -> Vec<Vec<f64>> {
        let mut values = vec![Vec::new(); self.conditions.len()];
        for (condition, mean) in self.means.iter().flatten() {
            values[*condition].push(*mean);
        }
        values
    }
}

/// The mean score of each condition.
fn means_by_condition(mut scores: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    scores.sort_by_key(|(condition, _)| *condition);
    let runs = scores.chunk_by(|a, b| a.0 == b.0);
    runs.map(|run| (run[0].0, run.iter().map(|(_, score)| score).sum::<f64>() / run.len() as f64))
        .collect()
}

fn compare<const N: usize>(a: &[f64; N], b: &[f64; N]) -> std::cmp::Ordering {
    let pairs = a.iter().zip(b);
    pairs
        .map(|(a, b)| a.total_cmp(b))
        .find(|order| order.is_ne())
        .unwrap_or(std::cmp::Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    #[test]
    fn rows_are_averaged_by_participant_first() {
        let csv = b"participant,level,value\nP2,1.0,2\nP1,0.5,1\nP2,1,4\nP1,1,5\n";
        let table = Table::read("r.csv", csv).unwrap();
        let selection = Selection::default();
        let scores = Scores::read(&Data::new(&table, &selection).unwrap(), ["level"]).unwrap();
        assert_eq!(scores.conditions, [[0.5], [1.0]]);
        assert_eq!(scores.means, [vec![(1, 3.0)], vec![(0, 1.0), (1, 5.0)]]);
        assert_eq!(scores.by_condition(), [vec![1.0], vec![3.0, 5.0]]);
    }
}
