//! The papers' larger tables, read from CSV files in a folder.
//!
//! A file has the columns of its [`Format`], in any order and among others; empty cells are allowed
//! where the paper has none.

use std::path::{Path, PathBuf};

use fovqa_io::read_small_file;
use thiserror::Error;

use crate::printed::Printed;

/// What a table's file holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Format {
    /// The file's name.
    pub file: &'static str,
    /// Columns that name a row.
    pub keys: &'static [&'static str],
    /// Columns of numbers.
    pub numbers: &'static [&'static str],
    /// Keys of rows there have to be.
    rows: &'static [&'static [&'static str]],
    /// Whether every cell of a number has one.
    full: bool,
}

/// RMFR's Table 1: metrics by scene, with their averages.
pub const RMFR_TABLE: Format = Format {
    file: "rmfr-table-1.csv",
    keys: &["metric", "scene"],
    numbers: &["hyperbolic", "linear", "kfr", "rmfr"],
    rows: &[
        &["FPSNR", "Average"],
        &["PSNR", "Average"],
        &["SSIM", "Average"],
        &["FovVideoVDP", "Average"],
    ],
    full: true,
};

/// DEAMP's Table 2: milliseconds of each pass.
pub const DEAMP_TABLE: Format = Format {
    file: "deamp-table-2.csv",
    keys: &["pass_ms"],
    numbers: &[
        "full",
        "kfr",
        "rmfr",
        "efr_kfr_dom",
        "efr_kfr_other",
        "2r_dom",
        "2r_other",
        "4r_dom",
        "4r_other",
        "6r_dom",
        "6r_other",
    ],
    rows: &[&["Total GPU Time"], &["Binocular Time"], &["Fps"]],
    full: false,
};

/// A table that cannot be used.
#[derive(Debug, Error)]
pub enum TablesError {
    /// There is no such folder.
    #[error("{}: there is no such folder", folder.display())]
    Folder {
        /// As it was given.
        folder: PathBuf,
    },
    /// A file cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A column is missing.
    #[error("{}: there is no column \"{column}\" (found: {found})", path.display())]
    Column {
        /// The file.
        path: PathBuf,
        /// The column.
        column: &'static str,
        /// The columns there are.
        found: String,
    },
    /// A row is missing.
    #[error("{}: there is no row \"{row}\"", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// Its keys.
        row: String,
    },
    /// A cell is no number.
    #[error("{}, line {line}: \"{cell}\" in column \"{column}\" is no number", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// From 1, which is the header.
        line: u64,
        /// The column.
        column: &'static str,
        /// What is there.
        cell: String,
    },
}

impl TablesError {
    /// How to mend it.
    pub fn help(&self) -> String {
        match self {
            Self::Folder { .. } | Self::Unreadable { .. } => format!(
                "give the folder with {} and {}, typed from the papers, or leave --tables out",
                RMFR_TABLE.file, DEAMP_TABLE.file
            ),
            Self::Column { path, .. } => {
                let format = [RMFR_TABLE, DEAMP_TABLE].into_iter().find(|f| path.ends_with(f.file));
                let columns = format.map(|f| [f.keys, f.numbers].concat().join(","));
                format!("the first line names the columns: {}", columns.unwrap_or_default())
            }
            Self::Row { .. } => "type all rows of the paper's table".to_owned(),
            Self::Cell { .. } => "write numbers as the paper prints them, such as 24.41".to_owned(),
        }
    }
}

/// Far more than a paper's table.
const MOST_BYTES: u64 = 1 << 20;

/// The tables of a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Tables {
    /// RMFR's Table 1.
    pub rmfr: Table,
    /// DEAMP's Table 2.
    pub deamp: Table,
}

impl Tables {
    /// Reads the tables of a folder.
    ///
    /// # Errors
    /// When the folder or a table is not there, or a table has not what is printed in the paper.
    pub fn read(folder: &Path) -> Result<Self, TablesError> {
        if !folder.is_dir() {
            return Err(TablesError::Folder { folder: folder.to_owned() });
        }
        let read = |format: &Format| {
            let path = folder.join(format.file);
            let unreadable =
                |reason: String| TablesError::Unreadable { path: path.clone(), reason };
            let bytes = read_small_file(&path, MOST_BYTES)
                .map_err(|error| unreadable(error.to_string()))?;
            let text = String::from_utf8(bytes)
                .map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
            Table::parse(format, &text, &path)
        };
        Ok(Self { rmfr: read(&RMFR_TABLE)?, deamp: read(&DEAMP_TABLE)? })
    }
}

/// A paper's table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    rows: Vec<TableRow>,
}

/// A row of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TableRow {
    keys: Vec<String>,
    numbers: Vec<Option<Printed>>,
}

impl TableRow {
    /// The number of a column, as it is printed.
    pub(crate) fn printed(&self, column: usize) -> Option<Printed> {
        self.numbers.get(column).cloned().flatten()
    }

    /// Its value.
    pub(crate) fn value(&self, column: usize) -> Option<f64> {
        self.printed(column).map(|printed| printed.value())
    }
}

impl Table {
    /// Reads a table; `path` is for messages.
    ///
    /// # Errors
    /// When a column, a row or a number is missing.
    pub fn parse(format: &Format, text: &str, path: &Path) -> Result<Self, TablesError> {
        let path = || path.to_owned();
        let broken = |error: csv::Error| TablesError::Unreadable {
            path: path(),
            reason: format!("this is no table: {error}"),
        };
        let text = text.trim_start_matches('\u{feff}');
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(broken)?.clone();
        let index = |column: &&'static str| {
            header.iter().position(|found| found == *column).ok_or_else(|| TablesError::Column {
                path: path(),
                column,
                found: header.iter().collect::<Vec<_>>().join(", "),
            })
        };
        let keys: Vec<usize> = format.keys.iter().map(index).collect::<Result<_, _>>()?;
        let numbers: Vec<usize> = format.numbers.iter().map(index).collect::<Result<_, _>>()?;
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(broken)?;
            let text = |i: &usize| record.get(*i).unwrap_or_default();
            let number = |(i, column): (&usize, &&'static str)| {
                let printed = Printed::new(text(i));
                let is_number = printed.value().is_finite() && printed.unit().is_empty();
                match (text(i).is_empty() && !format.full, is_number) {
                    (true, _) => Ok(None),
                    (false, true) => Ok(Some(printed)),
                    (false, false) => Err(TablesError::Cell {
                        path: path(),
                        line: record.position().map_or(0, csv::Position::line),
                        column,
                        cell: text(i).to_owned(),
                    }),
                }
            };
            rows.push(TableRow {
                keys: keys.iter().map(|i| text(i).to_owned()).collect(),
                numbers: numbers
                    .iter()
                    .zip(format.numbers)
                    .map(number)
                    .collect::<Result<_, _>>()?,
            });
        }
        let table = Self { rows };
        for keys in format.rows {
            if table.rows_where(&|found| found == *keys).is_empty() {
                return Err(TablesError::Row { path: path(), row: keys.join(", ") });
            }
        }
        Ok(table)
    }

    pub(crate) fn rows_where(&self, keys: &dyn Fn(&[String]) -> bool) -> Vec<&TableRow> {
        self.rows.iter().filter(|row| keys(&row.keys)).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use super::*;

    fn parse(format: &Format, text: &str) -> Result<Table, String> {
        Table::parse(format, text, Path::new(format.file))
            .map_err(|error| format!("{error}; {}", error.help()))
    }

    const HEADER: &str = "metric,scene,hyperbolic,linear,kfr,rmfr\n";

    #[test]
    fn says_what_a_table_lacks() {
        let refused = |text: &str, words: &[&str]| {
            let error = parse(&RMFR_TABLE, text).unwrap_err();
            for word in words {
                assert!(error.contains(word), "{word:?} is not in {error}");
            }
        };
        refused("metric,scene,hyperbolic,linear,rmfr\n", &["no column \"kfr\"", "found: metric"]);
        refused(
            "metric,scene,hyperbolic,linear,rmfr\n",
            &["metric,scene,hyperbolic,linear,kfr,rmfr"],
        );
        refused("", &["no column \"metric\""]);
        refused(HEADER, &["no row \"FPSNR, Average\""]);
        for cell in ["", "n/a", "27.4 dB", "-3", "1e5"] {
            let text = format!("{HEADER}FPSNR,Average,1,2,{cell},4\n");
            refused(&text, &["line 2", "\"kfr\" is no number", "as the paper prints them"]);
        }
        refused(&format!("{HEADER}FPSNR,Average,1,2\n"), &["this is no table", "--tables"]);
    }

    #[test]
    fn columns_may_stand_in_any_order() {
        let mut text = "\u{feff}note,rmfr,kfr, linear,hyperbolic,scene,metric\n".to_owned();
        for metric in ["FPSNR", "PSNR", "SSIM", "FovVideoVDP"] {
            let _ = writeln!(text, "x,4.0,3.00,2,1,Average,{metric}");
        }
        let table = parse(&RMFR_TABLE, &text).unwrap();
        let rows = table.rows_where(&|keys| keys[0] == "SSIM");
        let values: Vec<_> = (0..4).map(|column| rows[0].value(column).unwrap()).collect();
        assert_eq!(values, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(rows[0].printed(2).unwrap().text(), "3.00");
    }
}
