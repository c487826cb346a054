//! Means per participant and cell.

use std::collections::HashMap;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::StudyError;
use crate::input::{Column, Data, Levels};
use crate::moments::{Moments, sd};

/// The largest number of cells.
const MOST_CELLS: usize = 400;

/// Keys of a cell in the result, which no factor can have as a name.
const KEYS: [&str; 7] = ["n", "mean", "sd", "se", "ci", "se_within", "reason"];

/// A factor and its levels.
#[derive(Debug, Clone)]
pub(super) struct Factor {
    /// The name, as in the option.
    pub(super) name: String,
    /// The levels, by first appearance.
    pub(super) levels: Levels,
}

/// Means of the participants who have a value in each cell.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    /// One or two factors.
    pub(super) factors: Vec<Factor>,
    /// Per participant, the means of all cells, the last factor fastest.
    pub(super) values: Vec<Vec<f64>>,
    /// Participants who lack a cell.
    pub(super) left_out: Vec<String>,
}

/// A cell of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The factors and their levels.
    pub levels: Vec<(String, String)>,
    /// Moments of the participants' means.
    pub moments: Moments,
    /// The standard error without differences between participants (Cousineau 2005, with the
    /// correction of Morey 2008).
    pub se_within: Option<f64>,
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (factor, level) in &self.levels {
            map.serialize_entry(factor, level)?;
        }
        map.serialize_entry("n", &self.moments.n)?;
        map.serialize_entry("mean", &self.moments.mean)?;
        map.serialize_entry("sd", &self.moments.sd)?;
        map.serialize_entry("se", &self.moments.se)?;
        map.serialize_entry("ci", &self.moments.ci)?;
        map.serialize_entry("se_within", &self.se_within)?;
        if let Some(reason) = self.reason() {
            map.serialize_entry("reason", reason)?;
        }
        map.end()
    }
}

impl Cell {
    /// Why a value is undefined.
    pub fn reason(&self) -> Option<&str> {
        let one_cell =
            self.se_within.is_none().then_some("one cell has no error within participants");
        self.moments.reason.as_deref().or(one_cell)
    }
}

/// Checks the names of factors.
pub(super) fn check_factors(within: &[String]) -> Result<(), StudyError> {
    let error =
        |message: String, help: &str| Err(StudyError::Options { message, help: help.to_owned() });
    if within.is_empty() || within.len() > 2 {
        let message = format!("--within names {} factors", within.len());
        return error(message, "name one or two columns, such as --within method,eye");
    }
    if within.first() == within.get(1) {
        return error(
            format!("--within names {:?} twice", within[0]),
            "name two different columns",
        );
    }
    if let Some(name) = within.iter().find(|name| ["participant", "value"].contains(&name.as_str()))
    {
        let message = format!("--within names {name}, which is no factor");
        return error(message, "name one or two columns of conditions, such as method");
    }
    if let Some(name) = within.iter().find(|name| KEYS.contains(&name.as_str())) {
        return error(
            format!("the factor {name:?} has the name of a result"),
            &format!("give it another name, such as --within condition --column condition={name}"),
        );
    }
    Ok(())
}

impl Cells {
    /// Reads the means of a group.
    pub(super) fn read(data: &Data, within: &[String]) -> Result<Self, StudyError> {
        let participants = data.levels("participant")?;
        let participant = data.column("participant")?;
        let value = data.column("value")?;
        let mut factors = Vec::new();
        let mut columns: Vec<&Column> = Vec::new();
        for name in within {
            factors.push(Factor { name: name.clone(), levels: data.levels(name)? });
            columns.push(data.column(name)?);
        }
        let cells = factors.iter().map(|factor| factor.levels.len()).fold(1, usize::saturating_mul);
        if cells > MOST_CELLS {
            return Err(StudyError::Setting {
                message: format!(
                    "{}: {cells} cells are too many; an analysis of variance can have {MOST_CELLS}",
                    data.table().file()
                ),
                help: "check the columns of --within".to_owned(),
            });
        }
        let mut sums: HashMap<(usize, usize), (f64, f64)> = HashMap::new();
        for &row in data.rows() {
            let number = data.number(value, row)?;
            let cell = factors.iter().zip(&columns).fold(0, |cell, (factor, column)| {
                cell * factor.levels.len() + factor.levels.of_row(column, row)
            });
            let (sum, n) = sums.entry((participants.of_row(participant, row), cell)).or_default();
            *sum += number;
            *n += 1.0;
        }
        let mean = |participant: usize, cell: usize| {
            sums.get(&(participant, cell)).map(|(sum, n)| sum / n)
        };
        let (mut values, mut left_out) = (Vec::new(), Vec::new());
        for (index, name) in participants.names().iter().enumerate() {
            match (0..cells).map(|cell| mean(index, cell)).collect::<Option<Vec<f64>>>() {
                Some(means) => values.push(means),
                None => left_out.push(name.clone()),
            }
        }
        Ok(Self { factors, values, left_out })
    }

    /// The number of cells.
    pub(super) fn count(&self) -> usize {
        self.factors.iter().map(|factor| factor.levels.len()).product()
    }

    /// The level of a factor in a cell.
    pub(super) fn level(&self, factor: usize, cell: usize) -> usize {
        let after: usize = self.factors[factor + 1..].iter().map(|f| f.levels.len()).product();
        cell / after % self.factors[factor].levels.len()
    }

    /// The mean over all cells of each participant.
    pub(super) fn participant_means(&self) -> Vec<f64> {
        let mean = |values: &Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
        self.values.iter().map(mean).collect()
    }

    /// The table of the cells.
    pub(super) fn table(&self, confidence: f64) -> Vec<Cell> {
        let count = self.count();
        let means = self.participant_means();
        let correction = libm::sqrt(count as f64 / (count as f64 - 1.0));
        let of = |cell: usize| {
            let values: Vec<f64> = self.values.iter().map(|values| values[cell]).collect();
            let within: Vec<f64> = values.iter().zip(&means).map(|(y, mean)| y - mean).collect();
            let se = sd(&within).map(|sd| sd / libm::sqrt(within.len() as f64));
            let factors = self.factors.iter().enumerate();
            let levels = factors.map(|(index, factor)| {
                (factor.name.clone(), factor.levels.names()[self.level(index, cell)].clone())
            });
            Cell {
                levels: levels.collect(),
                moments: Moments::of(&values, confidence),
                se_within: se.filter(|_| count > 1).map(|se| se * correction),
            }
        };
        (0..count).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    #[test]
    fn participants_without_a_cell_are_left_out() {
        let csv = b"participant,a,b,value\nP,x,u,1\nP,x,v,2\nP,y,u,3\nP,y,v,4\nP,x,u,3\nQ,x,u,9\n";
        let table = Table::read("c.csv", csv).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let cells = Cells::read(&data, &["a".to_owned(), "b".to_owned()]).unwrap();
        assert_eq!(cells.values, [[2.0, 2.0, 3.0, 4.0]]);
        assert_eq!(cells.left_out, ["Q"]);
        let levels = |factor| (0..4).map(|cell| cells.level(factor, cell)).collect::<Vec<_>>();
        assert_eq!((levels(0), levels(1)), (vec![0, 0, 1, 1], vec![0, 1, 0, 1]));
        let json = serde_json::to_value(&cells.table(0.95)[1]).unwrap();
        assert_eq!(
            (&json["a"], &json["b"], &json["mean"]),
            (&"x".into(), &"v".into(), &2.0.into())
        );
    }

    #[test]
    fn factors_need_names_of_their_own() {
        let check = |names: &[&str]| {
            check_factors(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>())
        };
        assert!(check(&["a"]).is_ok() && check(&["a", "b"]).is_ok());
        assert!(check(&[]).is_err() && check(&["a", "b", "c"]).is_err());
        assert!(check(&["a", "a"]).is_err() && check(&["mean"]).is_err());
    }
}
