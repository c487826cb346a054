//! Scores as data: what a run found, its summary, JSON and tidy CSV.

mod csv_table;
mod json;
mod report;
mod summary;

pub use csv_table::{COLUMNS, write_csv};
pub use json::{SCHEMA, write_json};
pub use report::{Failure, FrameResult, ScoreReport, ViewResult};
pub use summary::{BandSummary, Statistics, Summary};
