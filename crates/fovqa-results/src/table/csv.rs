//! Writes the table as CSV (the output of `score --format csv`, and results.csv) and reads it. A
//! cell is empty if its column does not apply. Measured values and edges keep their decimal point
//! (`5.0`), because some readers guess a column's type from its first rows. Counts are integers.

use std::io::{self, Write};
use std::path::Path;

use fovqa_metrics::Image;

use super::reading::{Which, not_results};
use super::row::{COLUMNS, ERROR, TableRow, Value};
use super::rows::{rows_of_report, rows_of_run};
use crate::csv_names::CsvNames;
use crate::files::{FileError, open_result_file};
use crate::report::{RunResults, ScoreReport};
use crate::stereo::StereoReport;

/// The column with the lower edge of a band.
const FROM: usize = 9;

/// Writes a report as CSV: the values of each frame, followed by the statistics over all frames,
/// which have no frame number.
///
/// # Errors
/// If the writer refuses.
pub fn write_csv(report: &ScoreReport, out: impl Write) -> io::Result<()> {
    let mut table = CsvTable::new(out, CsvNames::Plain)?;
    rows_of_report(report, &mut |row| table.write(row))?;
    table.writer.flush()
}

/// Writes the results of two eyes as CSV: those of the left eye, of the right eye and of both together,
/// each as [`write_csv`] writes them.
///
/// # Errors
/// If the writer refuses.
pub fn write_stereo_csv(report: &StereoReport, out: impl Write) -> io::Result<()> {
    let mut table = CsvTable::new(out, CsvNames::Plain)?;
    for (eye, report) in report.named() {
        rows_of_report(report, &mut |row| table.write(&TableRow { eye, ..*row }))?;
    }
    table.writer.flush()
}

/// Writes the values of a run as results.csv, in the order of [`rows_of_run`].
///
/// # Errors
/// If the writer refuses.
pub fn write_results_csv(results: &RunResults, names: CsvNames, out: impl Write) -> io::Result<()> {
    let mut table = CsvTable::new(out, names)?;
    rows_of_run(results, &mut |row| table.write(row))?;
    table.writer.flush()
}

struct CsvTable<W: Write> {
    writer: csv::Writer<W>,
    names: CsvNames,
}

impl<W: Write> CsvTable<W> {
    fn new(out: W, names: CsvNames) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS).map_err(io_error)?;
        Ok(Self { writer, names })
    }

    fn write(&mut self, row: &TableRow<'_>) -> io::Result<()> {
        let text = |value: Option<Value>| value.map(|v| v.to_string()).unwrap_or_default();
        let edge = |edge: Option<f64>| text(edge.map(Value::Measured));
        let frame = row.frame.map(|f| f.to_string()).unwrap_or_default();
        let [from, to] = [0, 1].map(|side: usize| edge(row.band.map(|band| band[side])));
        let value = text(row.value);
        let level = row.level.map(|level| level.to_string()).unwrap_or_default();
        let TableRow { scene, method, parameters, eye, metric, statistic, .. } = *row;
        let [scene, method] = [scene, method].map(|name| self.names.written(name));
        let image = row.image.name();
        let cells = [
            &*scene, &*method, parameters, eye, &frame, image, metric, statistic, &level, &from,
            &to, &value,
        ];
        self.writer.write_record(cells).map_err(io_error)
    }
}

/// The original error. The conversion of the csv crate would hide its kind, for example a closed
/// pipe.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Reads results.csv, row by row.
///
/// # Errors
/// If it is missing, was changed after it was written, or `take` refuses a row. The reason from
/// `take` is reported with the line number.
pub(super) fn read_results_csv(
    path: &Path,
    names: CsvNames,
    which: Which,
    take: &mut dyn FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    let mut reader = csv::Reader::from_reader(open_result_file(path)?);
    let headers = reader.headers().map_err(|error| unreadable(path, error))?.clone();
    if !headers.iter().eq(COLUMNS) {
        let missing = COLUMNS.into_iter().find(|column| !headers.iter().any(|of| of == *column));
        let detail = match missing {
            Some(column) => format!("it has no column {column}"),
            None => format!("its columns are not these: {}", COLUMNS.join(", ")),
        };
        return Err(not_results(path, detail));
    }
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| unreadable(path, error))? {
        // Most rows belong to bands. If bands are not wanted, their cells need not be valid
        // numbers.
        let is_of_band = record.get(FROM).is_some_and(|cell| !cell.is_empty());
        if which == Which::WholeFrames && is_of_band {
            continue;
        }
        let line = record.position().map_or(0, csv::Position::line);
        let taken = row_of(&record).and_then(|row| take(&names.of_row(row)));
        taken.map_err(|detail| not_results(path, format!("line {line}: {detail}")))?;
    }
    Ok(())
}

fn row_of(record: &csv::StringRecord) -> Result<TableRow<'_>, String> {
    let cell = |index: usize| record.get(index).unwrap_or_default();
    let is_error = cell(6) == ERROR;
    let image = Image::find(cell(5)).ok_or_else(|| format!("there is no image {:?}", cell(5)))?;
    let value = if is_error { None } else { number(cell(11))? };
    Ok(TableRow {
        scene: cell(0),
        method: cell(1),
        parameters: cell(2),
        eye: cell(3),
        frame: whole(cell(4))?,
        image,
        metric: cell(6),
        statistic: cell(7),
        level: whole(cell(8))?,
        band: number(cell(FROM))?.zip(number(cell(10))?).map(Into::into),
        value: value.map(Value::Measured),
    })
}

/// Reports a file that does not exist as such.
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

/// The number in a cell, in the format that is written: infinity only as `inf`, and no NaN.
fn number(cell: &str) -> Result<Option<f64>, String> {
    if cell.is_empty() {
        return Ok(None);
    }
    let wrong = || format!("{cell:?} is not a number");
    let value: f64 = cell.parse().map_err(|_| wrong())?;
    if value.is_finite() || matches!(cell, "inf" | "-inf") { Ok(Some(value)) } else { Err(wrong()) }
}

fn whole<T: std::str::FromStr>(cell: &str) -> Result<Option<T>, String> {
    if cell.is_empty() {
        return Ok(None);
    }
    cell.parse().map(Some).map_err(|_| format!("{cell:?} is not a whole number"))
}
