//! The papers' larger tables, read from CSV files in a folder.

use std::fs;
use std::path::Path;

use fovqa_report::Printed;

/// What a table's file holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Format {
    /// The file's name.
    pub(super) file: &'static str,
    /// Columns that name a row.
    pub(super) keys: &'static [&'static str],
    /// Columns of numbers.
    pub(super) numbers: &'static [&'static str],
    /// Keys of rows there have to be.
    rows: &'static [&'static [&'static str]],
    /// Whether every cell of a number has one.
    full: bool,
}

/// RMFR's Table 1: metrics by scene, with their averages.
pub(super) const RMFR_TABLE: Format = Format {
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
pub(super) const DEAMP_TABLE: Format = Format {
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

/// The tables of a folder.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tables {
    /// RMFR's Table 1.
    pub(super) rmfr: Table,
    /// DEAMP's Table 2.
    pub(super) deamp: Table,
}

impl Tables {
    /// Reads the tables of a folder.
    pub(super) fn read(folder: &Path) -> Self {
        let read = |format: &Format| {
            Table::parse(format, &fs::read_to_string(folder.join(format.file)).unwrap())
        };
        Self { rmfr: read(&RMFR_TABLE), deamp: read(&DEAMP_TABLE) }
    }
}

/// A paper's table.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Table {
    rows: Vec<TableRow>,
}

/// A row of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TableRow {
    keys: Vec<String>,
    numbers: Vec<Option<Printed>>,
}

impl TableRow {
    /// The number of a column, as it is printed.
    pub(super) fn printed(&self, column: usize) -> Option<Printed> {
        self.numbers.get(column).cloned().flatten()
    }

    /// Its value.
    pub(super) fn value(&self, column: usize) -> Option<f64> {
        self.printed(column).map(|printed| printed.value())
    }
}

impl Table {
    /// Reads a table, whose columns may stand in any order and among others.
    pub(super) fn parse(format: &Format, text: &str) -> Self {
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let column = |name: &&str| header.iter().position(|found| found == *name).unwrap();
        let keys: Vec<usize> = format.keys.iter().map(column).collect();
        let numbers: Vec<usize> = format.numbers.iter().map(column).collect();
        let rows = reader.records().map(|record| {
            let record = record.unwrap();
            let number = |column: &usize| match &record[*column] {
                "" if !format.full => None,
                text => {
                    let printed = Printed::new(text);
                    assert!(printed.value().is_finite(), "{}: {text}", format.file);
                    Some(printed)
                }
            };
            TableRow {
                keys: keys.iter().map(|column| record[*column].to_owned()).collect(),
                numbers: numbers.iter().map(number).collect(),
            }
        });
        let table = Self { rows: rows.collect() };
        for keys in format.rows {
            assert!(!table.rows_where(&|found| found == *keys).is_empty(), "{keys:?}");
        }
        table
    }

    pub(super) fn rows_where(&self, keys: &dyn Fn(&[String]) -> bool) -> Vec<&TableRow> {
        self.rows.iter().filter(|row| keys(&row.keys)).collect()
    }
}
