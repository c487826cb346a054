//! Scores as data: what a run found, its summary, JSON and tidy CSV.

mod both_eyes;
mod csv_table;
mod files;
mod json;
mod report;
mod summary;

pub use both_eyes::both_eyes;
pub use csv_table::{COLUMNS, ERROR, write_csv, write_results_csv};
pub use files::{
    FileError, REPORT_JSON, RESULTS_CSV, RUN_JSON, SUMMARY_JSON, read_json_file, write_json_file,
    write_whole,
};
pub use json::{
    BandStatistics, ComparisonSummary, ErrorRecord, ExperimentRecord, RUN_SCHEMA, RunRecord,
    SCORE_SCHEMA, SUMMARY_SCHEMA, SummaryRecord, ViewRecord, write_json,
};
pub use report::{Comparison, Failure, FrameResult, Input, RunResults, ScoreReport, ViewResult};
pub use summary::{BandSummary, Statistics, Summary};
