//! Scores as data: what a run found, its summary, JSON and tidy CSV.

mod both_eyes;
mod csv_table;
mod json;
mod report;
mod summary;

pub use both_eyes::both_eyes;
pub use csv_table::{COLUMNS, write_csv};
pub use json::{SCHEMA, write_json};
pub use report::{Comparison, Failure, FrameResult, Input, RunResults, ScoreReport, ViewResult};
pub use summary::{BandSummary, Statistics, Summary};
