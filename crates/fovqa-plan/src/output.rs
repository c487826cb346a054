//! How the results of a run are written.

use fovqa_params::words;

/// How the results of a run are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputSettings {
    /// The files that hold the table of all values; at least one.
    pub tables: Vec<TableFormat>,
    /// Whether no name in a CSV file can be taken for a formula.
    pub spreadsheet_safe: bool,
}

impl Default for OutputSettings {
    fn default() -> Self {
        Self { tables: vec![TableFormat::Csv], spreadsheet_safe: false }
    }
}

words! {
    /// A file that holds the table of all values.
    pub enum TableFormat {
        /// results.csv.
        Csv "csv" "results.csv";
        /// results.parquet.
        Parquet "parquet" "results.parquet, for polars, DuckDB and pandas";
    }
}
