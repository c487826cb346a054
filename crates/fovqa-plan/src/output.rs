//! How the results of a run are written.

use fovqa_params::words;

/// How the results of a run are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputSettings {
    /// The files that hold the table of all values; at least one.
    pub tables: Vec<TableFormat>,
}

impl Default for OutputSettings {
    fn default() -> Self {
        Self { tables: vec![TableFormat::Csv] }
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
