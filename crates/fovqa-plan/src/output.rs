//! How the results of a run are written.

use fovqa_metrics::Metric;
use fovqa_params::words;

/// How the results of a run are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputSettings {
    /// The files that contain the table of all values. There is at least one.
    pub tables: Vec<TableFormat>,
    /// Whether names in CSV files are protected so that a spreadsheet does not read them as
    /// formulas.
    pub spreadsheet_safe: bool,
    /// The metrics whose maps are written for every frame, into the folder `maps` of the results.
    pub maps: Vec<Metric>,
}

impl Default for OutputSettings {
    fn default() -> Self {
        Self { tables: vec![TableFormat::Csv], spreadsheet_safe: false, maps: Vec::new() }
    }
}

words! {
    /// The format of a file that contains the table of all values.
    pub enum TableFormat {
        /// results.csv.
        Csv "csv" "results.csv";
        /// results.parquet.
        Parquet "parquet" "results.parquet, for polars, DuckDB and pandas";
    }
}
