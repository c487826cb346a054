//! The values of a finished run, from results.csv and summary.json. A file that lacks rows, or has others
//! than were written, must not pass for a run: the two files have to agree.

use std::collections::BTreeSet;
use std::path::Path;

use super::values::{Place, Row, RunValues, Values};
use crate::csv_table::{COLUMNS, ERROR};
use crate::files::{FileError, RESULTS_CSV, SUMMARY_JSON, open_result_file, read_json_file};
use crate::json::{ComparisonSummary, SUMMARY_SCHEMA, SummaryRecord};

impl RunValues {
    /// Reads those of a folder of results.
    ///
    /// # Errors
    /// When its files are missing or not what they should be.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(SUMMARY_JSON);
        let summary: SummaryRecord = read_json_file(&path, SUMMARY_SCHEMA, "a summary of a run")?;
        let mut values = Self::default();
        let path = folder.join(RESULTS_CSV);
        let broken = |detail: String| broken(&path, detail);
        values.read_csv(&path)?;
        for comparison in summary.comparisons {
            let place = place(&comparison);
            let entry = values.places.entry(place).or_default();
            agrees(entry, &comparison).map_err(broken)?;
            entry.errors = comparison.errors;
            entry.summary = Some(comparison);
        }
        let stranger = values.places.iter().find(|(_, values)| values.summary.is_none());
        if let Some(((scene, method, _), _)) = stranger {
            return Err(broken(format!(
                "it has values of {scene}, {method} that {SUMMARY_JSON} has not"
            )));
        }
        values.errors = summary
            .errors
            .iter()
            .map(|error| {
                let frame = error.frame.map(|frame| format!("frame {frame}"));
                let eye = Some(error.eye.clone()).filter(|eye| !eye.is_empty());
                let place = [Some(error.scene.clone()), Some(error.method.clone()), eye, frame];
                let place: Vec<String> = place.into_iter().flatten().collect();
                format!("{}: {}", place.join(", "), error.message)
            })
            .collect();
        Ok(values)
    }

    fn read_csv(&mut self, path: &Path) -> Result<(), FileError> {
        let mut reader = csv::Reader::from_reader(open_result_file(path)?);
        let headers = reader.headers().map_err(|error| unreadable(path, error))?.clone();
        if !headers.iter().eq(COLUMNS) {
            return Err(broken(path, "its columns are others".to_owned()));
        }
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|error| unreadable(path, error))? {
            let cell = |index: usize| record.get(index).unwrap_or_default();
            let line = record.position().map_or(0, csv::Position::line);
            let at = |detail: String| broken(path, format!("line {line}: {detail}"));
            let text = |index: usize| cell(index).to_owned();
            let values = self.places.entry((text(0), text(1), text(3))).or_default();
            if cell(6) == ERROR {
                continue;
            }
            let row = Row {
                frame: whole(cell(4)).map_err(at)?,
                band: number(cell(9))
                    .map_err(at)?
                    .zip(number(cell(10)).map_err(at)?)
                    .map(Into::into),
                value: number(cell(11)).map_err(at)?,
            };
            let level = whole(cell(8)).map_err(at)?;
            values.rows.entry((text(6), text(7), text(5), level)).or_default().push(row);
        }
        Ok(())
    }
}

fn place(comparison: &ComparisonSummary) -> Place {
    (comparison.scene.clone(), comparison.method.clone(), comparison.eye.clone())
}

fn broken(path: &Path, detail: String) -> FileError {
    FileError::Format { path: path.to_owned(), expected: "the results of a run", detail }
}

/// A file that is not there is said as such.
fn unreadable(path: &Path, error: csv::Error) -> FileError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => FileError::Read { path: path.to_owned(), error },
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.map_or(0, |at| at.line());
            broken(path, format!("line {line}: it has {len} cells, not {expected_len}"))
        }
        other => broken(path, format!("{other:?}")),
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

/// Whether the rows of a comparison are those that its summary is of.
fn agrees(values: &Values, comparison: &ComparisonSummary) -> Result<(), String> {
    let ComparisonSummary { scene, method, .. } = comparison;
    let lacks =
        |what: &str| format!("it has other {what} of {scene}, {method} than {SUMMARY_JSON}");
    let rows = values.rows.values().flatten();
    let frames: BTreeSet<i64> = rows.filter_map(|row| row.frame).collect();
    if frames.len() != comparison.frames {
        return Err(lacks("frames"));
    }
    let rows = |metric: &str| {
        let kind = (metric.to_owned(), String::new(), "pair".to_owned(), None);
        values.rows.get(&kind).map(Vec::as_slice).unwrap_or_default()
    };
    for (metric, statistics) in &comparison.metrics {
        let whole = rows(metric.key()).iter().filter(|row| row.band.is_none());
        let values: Vec<f64> = whole.filter_map(|row| row.value).collect();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if min.to_bits() != statistics.min.to_bits() || max.to_bits() != statistics.max.to_bits() {
            return Err(lacks(&format!("values of {}", metric.key())));
        }
    }
    for band in &comparison.bands {
        let edges = [band.from_deg, band.to_deg].map(f64::to_bits);
        let of = |row: &&Row| row.band.is_some_and(|band| band.map(f64::to_bits) == edges);
        let pixels: f64 = rows("pixels").iter().filter(of).filter_map(|row| row.value).sum();
        if pixels as u64 != band.pixels {
            return Err(lacks("pixels"));
        }
    }
    let bands = comparison.bands.len();
    let every_band = ["coefficients", "mean_abs", "max_abs", "energy"];
    let short = values.rows.iter().find(|((metric, statistic, _, _), rows)| {
        metric == "haar"
            && every_band.contains(&statistic.as_str())
            && rows.len() != frames.len() * bands
    });
    if short.is_some() { Err(lacks("values of haar")) } else { Ok(()) }
}
