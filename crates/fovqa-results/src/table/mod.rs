//! One long, tidy table of all values, one row per value: its rows, and the files that hold it.

mod csv;
mod reading;
mod row;
mod rows;

use std::path::Path;

pub use csv::{write_csv, write_results_csv};
pub use reading::Which;
pub(crate) use reading::not_results;
pub use row::{ERROR, GAZE_STEP, TableRow, Value};

use crate::files::{FileError, RESULTS_CSV};

/// Reads the table of a results folder, row by row.
///
/// # Errors
/// When it is missing, is not what a run has written, or `take` refuses a row: with its reason, and the line.
pub fn read_results(
    folder: &Path,
    which: Which,
    mut take: impl FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    csv::read_results_csv(&folder.join(RESULTS_CSV), which, &mut take)
}
