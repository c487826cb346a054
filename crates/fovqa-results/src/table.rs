//! One long, tidy table, a row a value: what `score --format csv` prints, and results.csv, read
//! here alone. Empty cells where a column does not apply. Measured values and edges keep their point
//! (`5.0`): readers that guess a column's type from its first rows are not misled. Counts are whole.

use std::path::Path;

use fovqa_metrics::Image;

use crate::files::{FileError, RESULTS_CSV, open_result_file};

/// The columns, in order.
pub const COLUMNS: [&str; 12] = [
    "scene",
    "method",
    "parameters",
    "eye",
    "frame",
    "image",
    "metric",
    "statistic",
    "level",
    "from_deg",
    "to_deg",
    "value",
];

/// The metric of a row that stands for something that could not be scored.
pub const ERROR: &str = "error";

/// The metric of rows that say how far the gaze has moved since the frame before, degrees.
pub const GAZE_STEP: &str = "gaze_step_deg";

/// A row of the table; `parameters` belongs to sweeps to come.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct TableRow<'a> {
    /// The scene.
    pub scene: &'a str,
    /// The method.
    pub method: &'a str,
    /// `left`, `right` or `both`; empty in a scene with one picture a frame.
    pub eye: &'a str,
    /// The frame; `None`: of the whole sequence.
    pub frame: Option<i64>,
    /// Of which picture.
    pub image: Image,
    /// What is measured or counted, or [`ERROR`].
    pub metric: &'a str,
    /// Which statistic of it; empty for the metric's own value.
    pub statistic: &'a str,
    /// The level, from 1 on.
    pub level: Option<usize>,
    /// Edges of the band, degrees; `None`: the whole frame.
    pub band: Option<[f64; 2]>,
    /// The value; `None` where there is nothing to have one of.
    pub value: Option<f64>,
}

/// Reads results.csv of a folder, row by row.
///
/// # Errors
/// When it is missing, is not what was written, or `take` says that it is wrong: in words, behind which
/// the line is named.
pub fn read_results_csv(
    folder: &Path,
    mut take: impl FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    let path = folder.join(RESULTS_CSV);
    let mut reader = csv::Reader::from_reader(open_result_file(&path)?);
    let headers = reader.headers().map_err(|error| unreadable(&path, error))?.clone();
    if !headers.iter().eq(COLUMNS) {
        return Err(not_results(&path, "its columns are others".to_owned()));
    }
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| unreadable(&path, error))? {
        let line = record.position().map_or(0, csv::Position::line);
        let taken = row_of(&record).and_then(|row| take(&row));
        taken.map_err(|detail| not_results(&path, format!("line {line}: {detail}")))?;
    }
    Ok(())
}

/// The error of a file that is not what a run has written.
pub(crate) fn not_results(path: &Path, detail: String) -> FileError {
    FileError::Format { path: path.to_owned(), expected: "the results of a run", detail }
}

fn row_of(record: &csv::StringRecord) -> Result<TableRow<'_>, String> {
    let cell = |index: usize| record.get(index).unwrap_or_default();
    let is_error = cell(6) == ERROR;
    let image = Image::find(cell(5)).ok_or_else(|| format!("there is no image {:?}", cell(5)))?;
    let value = if is_error { None } else { number(cell(11))? };
    Ok(TableRow {
        scene: cell(0),
        method: cell(1),
        eye: cell(3),
        frame: whole(cell(4))?,
        image,
        metric: cell(6),
        statistic: cell(7),
        level: whole(cell(8))?,
        band: number(cell(9))?.zip(number(cell(10))?).map(Into::into),
        value,
    })
}

/// A file that is not there is said as such.
fn unreadable(path: &Path, error: csv::Error) -> FileError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => FileError::Read { path: path.to_owned(), error },
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.map_or(0, |at| at.line());
            not_results(path, format!("line {line}: it has {len} cells, not {expected_len}"))
        }
        other => not_results(path, format!("{other:?}")),
    }
}

/// A number of a cell, as it is written there: of what is infinite, `inf` alone, and no NaN.
fn number(cell: &str) -> Result<Option<f64>, String> {
    if cell.is_empty() {
        return Ok(None);
    }
    let wrong = || format!("{cell:?} is no number");
    let value: f64 = cell.parse().map_err(|_| wrong())?;
    if value.is_finite() || matches!(cell, "inf" | "-inf") { Ok(Some(value)) } else { Err(wrong()) }
}

fn whole<T: std::str::FromStr>(cell: &str) -> Result<Option<T>, String> {
    if cell.is_empty() {
        return Ok(None);
    }
    cell.parse().map(Some).map_err(|_| format!("{cell:?} is no whole number"))
}
