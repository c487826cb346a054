//! Selected rows of a table, whose columns are found by their role.

use std::collections::HashMap;

use super::levels::Levels;
use super::selection::Selection;
use super::table::{Column, Table};
use crate::json::By;
use crate::{StudyError, WrongCell};

/// Selected rows of a table.
#[derive(Debug, Clone)]
pub struct Data<'t> {
    table: &'t Table,
    selection: &'t Selection,
    rows: Vec<usize>,
}

impl<'t> Data<'t> {
    /// The rows for which all conditions of `--where` hold.
    ///
    /// # Errors
    ///
    /// If a column of a condition is missing, or no row remains.
    pub fn new(table: &'t Table, selection: &'t Selection) -> Result<Self, StudyError> {
        let all = Self { table, selection, rows: (0..table.rows()).collect() };
        let mut rows = all.rows.clone();
        for (role, value) in &selection.filters {
            let column = all.column(role)?;
            rows.retain(|&row| column.text(row) == value);
        }
        all.with_rows(rows)
    }

    /// The same with other rows.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn with_rows(&self, rows: Vec<usize>) -> Result<Self, StudyError> {
        if rows.is_empty() {
            let conditions: Vec<String> =
                self.selection.filters.iter().map(|(c, v)| format!("{c} = {v}")).collect();
            let mut selected = conditions.join(" and ");
            if !selected.is_empty() {
                selected.insert_str(0, " with ");
            }
            return Err(StudyError::NoRows { file: self.table.file().to_owned(), selected });
        }
        Ok(Self { table: self.table, selection: self.selection, rows })
    }

    /// The rows whose cell of this role is not empty. An empty `value` is no row.
    ///
    /// # Errors
    ///
    /// If the column is missing, or no row remains.
    pub fn without_empty(&self, role: &str) -> Result<Self, StudyError> {
        let column = self.column(role)?;
        let has = |row: &&usize| !column.text(**row).is_empty();
        self.with_rows(self.rows.iter().filter(has).copied().collect())
    }

    /// The indices of the rows in the table, ascending.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// The table.
    pub fn table(&self) -> &'t Table {
        self.table
    }

    /// The column of a role.
    ///
    /// # Errors
    ///
    /// If there is none, or more than one.
    pub fn column(&self, role: &str) -> Result<&'t Column, StudyError> {
        let missing = || StudyError::MissingColumn {
            file: self.table.file().to_owned(),
            role: role.to_owned(),
            column: self.selection.name(role).to_owned(),
            present: self.table.names(),
        };
        self.table.find(self.selection.name(role))?.ok_or_else(missing)
    }

    /// The column of an optional role. If the role was renamed with `--column`, its column must be
    /// there.
    ///
    /// # Errors
    ///
    /// If there is more than one, or none in spite of `--column`.
    pub fn optional(&self, role: &str) -> Result<Option<&'t Column>, StudyError> {
        if self.selection.name(role) == role {
            self.table.find(role)
        } else {
            self.column(role).map(Some)
        }
    }

    /// The number in a cell.
    ///
    /// # Errors
    ///
    /// If the cell holds no finite number.
    pub fn number(&self, column: &Column, row: usize) -> Result<f64, StudyError> {
        column.number(row).ok_or_else(|| {
            let help = "correct the cell; in the value column, an empty cell leaves the row out";
            self.wrong_cell(column, row, "a finite number of at most 1e50", help)
        })
    }

    /// The whole number of 0 or more in a cell, at most 10⁹.
    ///
    /// # Errors
    ///
    /// If the cell holds something else.
    pub fn count(&self, column: &Column, row: usize) -> Result<u64, StudyError> {
        let whole = |number: &f64| number.fract() == 0.0 && (0.0..=1e9).contains(number);
        column.number(row).filter(whole).map(|number| number as u64).ok_or_else(|| {
            let help = "write how many trials the row stands for";
            self.wrong_cell(column, row, "a whole number from 0 to 1e9", help)
        })
    }

    /// The numbered values of a role, by first appearance.
    ///
    /// # Errors
    ///
    /// If the column is missing or a cell is empty.
    pub fn levels(&self, role: &str) -> Result<Levels, StudyError> {
        let column = self.column(role)?;
        for &row in &self.rows {
            if column.text(row).is_empty() {
                let help = "write the name, or remove the row";
                return Err(self.wrong_cell(column, row, &format!("a name of a {role}"), help));
            }
        }
        Ok(Levels::of_column(column, &self.rows))
    }

    /// The error of a cell.
    pub fn wrong_cell(&self, column: &Column, row: usize, wanted: &str, help: &str) -> StudyError {
        StudyError::Cell(Box::new(WrongCell {
            file: self.table.file().to_owned(),
            line: self.table.line(row),
            column: column.name().to_owned(),
            cell: column.text(row).chars().take(80).collect(),
            wanted: wanted.to_owned(),
            help: help.to_owned(),
        }))
    }

    /// The groups of `--by`, by first appearance; one group of all rows without the option.
    ///
    /// # Errors
    ///
    /// If a column is missing.
    pub fn groups(&self) -> Result<Vec<(By, Data<'t>)>, StudyError> {
        let by = &self.selection.by;
        let columns: Vec<&Column> =
            by.iter().map(|role| self.column(role)).collect::<Result<_, _>>()?;
        let mut known: HashMap<Vec<u32>, usize> = HashMap::new();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &row in &self.rows {
            let key: Vec<u32> = columns.iter().map(|column| column.code(row)).collect();
            let index = *known.entry(key).or_insert(groups.len());
            if index == groups.len() {
                groups.push(Vec::new());
            }
            groups[index].push(row);
        }
        let with_name = |rows: Vec<usize>| {
            let first = rows[0];
            let values = by.iter().zip(&columns);
            let values = values.map(|(role, column)| (role.clone(), column.text(first).to_owned()));
            (By(values.collect()), Data { table: self.table, selection: self.selection, rows })
        };
        Ok(groups.into_iter().map(with_name).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CSV: &[u8] = b"who,scene,value\nP1,b,1\nP2,a,\nP1,a,3\nP2,b,x\n";

    fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
    }

    #[test]
    fn roles_conditions_and_groups_select_rows() {
        let table = Table::read("s.csv", CSV).unwrap();
        let columns = pairs(&[("participant", "who")]);
        let selection = Selection {
            by: vec!["scene".into()],
            filters: pairs(&[("participant", "P1")]),
            columns,
        };
        let data = Data::new(&table, &selection).unwrap();
        assert_eq!(data.rows(), [0, 2]);
        let groups = data.groups().unwrap();
        let names: Vec<_> =
            groups.iter().map(|(by, data)| (by.0[0].1.as_str(), data.rows())).collect();
        assert_eq!(names, [("b", &[0][..]), ("a", &[2][..])]);
        assert_eq!(data.levels("participant").unwrap().names(), ["P1"]);
    }

    #[test]
    fn errors_name_file_column_and_line() {
        let table = Table::read("s.csv", CSV).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap().without_empty("value").unwrap();
        assert_eq!(data.rows(), [0, 2, 3]);
        let value = data.column("value").unwrap();
        let error = data.number(value, 3).unwrap_err().to_string();
        assert!(error.contains("s.csv, line 5, column \"value\": \"x\""), "{error}");
        let error = data.column("participant").unwrap_err();
        assert!(
            error.help().contains("--column participant=NAME; the file has who, scene"),
            "{error}"
        );
        let nobody = Selection { filters: pairs(&[("who", "P9")]), ..Selection::default() };
        assert!(matches!(Data::new(&table, &nobody), Err(StudyError::NoRows { .. })));
    }
}
