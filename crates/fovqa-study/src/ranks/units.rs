//! Values per unit and method.

use std::collections::HashMap;

use super::options::Options;
use crate::StudyError;
use crate::input::{Column, Data, Levels};
use crate::options::Ties;
use crate::pairs::{Outcome, Votes};

/// The largest number of methods: every method is compared with every other one.
const MOST_METHODS: usize = 200;

/// Values per unit and method.
pub(super) struct Units {
    /// The methods, in their order.
    pub(super) methods: Levels,
    /// The units in which a method has a value, ascending, and the values.
    pub(super) by_method: Vec<Vec<(usize, f64)>>,
    units: usize,
}

/// Whether the table has values, and not pairwise comparisons.
pub(super) fn has_values(data: &Data) -> Result<bool, StudyError> {
    let has_answers = data.optional("answer")?.is_some();
    Ok(data.optional("value")?.is_some() || !has_answers)
}

/// The methods, by first appearance.
pub(super) fn methods(data: &Data, has_values: bool) -> Result<Levels, StudyError> {
    if !has_values {
        return crate::pairs::methods(data);
    }
    let methods = data.levels("method")?;
    if methods.len() > MOST_METHODS {
        return Err(StudyError::Setting {
            message: format!(
                "{}: {} methods are too many; rank tests can have {MOST_METHODS}",
                data.table().file(),
                methods.len()
            ),
            help: "select rows with --where or --by, or check the column of the methods".to_owned(),
        });
    }
    Ok(methods)
}

impl Units {
    /// Reads the values of a group.
    pub(super) fn read(
        data: &Data,
        options: &Options,
        has_values: bool,
    ) -> Result<Self, StudyError> {
        let mut numbers = UnitNumbers::new(data, &options.unit)?;
        let mut sums: HashMap<(usize, usize), (f64, f64)> = HashMap::new();
        let mut add = |method: usize, unit: usize, value: f64, count: f64| {
            let (sum, n) = sums.entry((method, unit)).or_default();
            *sum += value;
            *n += count;
        };
        let methods = if has_values {
            let methods = methods(data, has_values)?.in_order(&options.order);
            let (method, value) = (data.column("method")?, data.column("value")?);
            for &row in data.rows() {
                let value = data.number(value, row)?;
                add(methods.of_row(method, row), numbers.of_row(row), value, 1.0);
            }
            methods
        } else {
            let votes = Votes::read(data, options.ties, &options.order)?;
            for vote in &votes.votes {
                let is_left_out = vote.outcome == Outcome::Tie && votes.ties == Ties::Drop;
                if is_left_out || vote.count == 0.0 {
                    continue;
                }
                let unit = numbers.of_row(vote.row);
                let [a, b] = vote.won(votes.ties);
                add(vote.a, unit, a, 0.0);
                add(vote.b, unit, b, 0.0);
            }
            votes.methods
        };
        let mut by_method = vec![Vec::new(); methods.len()];
        for ((method, unit), (sum, n)) in sums {
            by_method[method].push((unit, if n > 0.0 { sum / n } else { sum }));
        }
        for values in &mut by_method {
            values.sort_by_key(|(unit, _)| *unit);
        }
        Ok(Self { methods, by_method, units: numbers.known.len() })
    }

    /// The values of each method.
    pub(super) fn values(&self) -> Vec<Vec<f64>> {
        let values = |units: &Vec<(usize, f64)>| units.iter().map(|(_, value)| *value).collect();
        self.by_method.iter().map(values).collect()
    }

    /// The units with a value of each method: their values, in the order of the methods.
    pub(super) fn whole(&self) -> Vec<Vec<f64>> {
        let mut rows: Vec<Vec<f64>> = vec![Vec::new(); self.units];
        for (method, values) in self.by_method.iter().enumerate() {
            for &(unit, value) in values {
                // A unit that lacks an earlier method cannot become whole.
                if rows[unit].len() == method {
                    rows[unit].push(value);
                }
            }
        }
        rows.retain(|row| row.len() == self.methods.len());
        rows
    }

    /// The values of two methods in the units that have both.
    pub(super) fn both(&self, a: usize, b: usize) -> Vec<(f64, f64)> {
        let other: HashMap<usize, f64> = self.by_method[b].iter().copied().collect();
        let pair = |&(unit, value): &(usize, f64)| other.get(&unit).map(|other| (value, *other));
        self.by_method[a].iter().filter_map(pair).collect()
    }
}

/// Numbers the units, by first appearance.
struct UnitNumbers<'d> {
    columns: Vec<&'d Column>,
    known: HashMap<Vec<u32>, usize>,
}

impl<'d> UnitNumbers<'d> {
    fn new(data: &'d Data, unit: &[String]) -> Result<Self, StudyError> {
        let mut columns = Vec::new();
        for role in unit {
            data.levels(role)?;
            columns.push(data.column(role)?);
        }
        Ok(Self { columns, known: HashMap::new() })
    }

    fn of_row(&mut self, row: usize) -> usize {
        let key: Vec<u32> = self.columns.iter().map(|column| column.code(row)).collect();
        let next = self.known.len();
        *self.known.entry(key).or_insert(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    fn read(csv: &str, unit: &[&str]) -> Units {
        let table = Table::read("r.csv", csv.as_bytes()).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let unit = unit.iter().map(|role| (*role).to_owned()).collect();
        let options = Options { unit, ties: Ties::Half, ..Options::default() };
        Units::read(&data, &options, has_values(&data).unwrap()).unwrap()
    }

    #[test]
    fn rows_of_a_unit_are_averaged() {
        let csv = "participant,scene,method,value\nP,s,A,1\nP,t,A,3\nP,s,B,5\nQ,s,A,7\n";
        let units = read(csv, &["participant"]);
        assert_eq!(units.values(), [vec![2.0, 7.0], vec![5.0]]);
        assert_eq!(units.whole(), [vec![2.0, 5.0]]);
        assert_eq!(units.both(0, 1), [(2.0, 5.0)]);
        assert_eq!(read(csv, &["participant", "scene"]).values()[0], [1.0, 3.0, 7.0]);
    }

    #[test]
    fn votes_are_counted() {
        let csv = "participant,method_a,method_b,answer\nP,A,B,a\nP,A,B,tie\nP,B,C,b\n";
        assert_eq!(read(csv, &["participant"]).values(), [vec![1.5], vec![0.5], vec![1.0]]);
    }
}
