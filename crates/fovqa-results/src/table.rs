//! One long, tidy table, a row a value: what `score --format csv` prints, and results.csv, written and read
//! here alone. Empty cells where a column does not apply. Measured values and edges keep their point
//! (`5.0`): readers that guess a column's type from its first rows are not misled. Counts are whole.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use fovqa_metrics::{Image, Metric, Row, Subject};

use crate::compared::Sides;
use crate::files::{FileError, RESULTS_CSV, open_result_file};
use crate::fvvdp::{FvvdpSummary, SpatialBand};
use crate::report::{Comparison, FrameResult, RunResults, ScoreReport};
use crate::summary::{Statistics, Summary};

/// The columns, in order.
const COLUMNS: [&str; 12] = [
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

/// The column of the lower edge of a band.
const FROM: usize = 9;

/// The metric of a row that stands for something that could not be scored.
pub const ERROR: &str = "error";

/// The metric of rows that say how far the gaze has moved since the frame before, degrees.
pub const GAZE_STEP: &str = "gaze_step_deg";

const FVVDP: &str = "fvvdp";

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
    pub value: Option<Value>,
}

/// A cell of the last column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// Measured: it keeps its point.
    Measured(f64),
    /// Counted: whole.
    Count(u64),
}

impl Value {
    /// The number.
    pub fn number(self) -> f64 {
        match self {
            Value::Measured(value) => value,
            Value::Count(count) => count as f64,
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // As readers of CSV know it.
            Value::Measured(value) if value.is_nan() => f.write_str("nan"),
            Value::Measured(value) => write!(f, "{value:?}"),
            Value::Count(count) => write!(f, "{count}"),
        }
    }
}

/// Writes a report as CSV: each frame's values and then, without a frame, the statistics over
/// all of them.
///
/// # Errors
/// When the writer refuses.
pub fn write_csv(report: &ScoreReport, out: impl Write) -> io::Result<()> {
    let mut table = Table::new(out)?;
    table.frames(&TableRow::default(), report)?;
    table.statistics(report)?;
    table.0.flush()
}

/// Writes the values of a run as results.csv: each frame's values, comparison by comparison; behind
/// those of a comparison, a row [`ERROR`] with the value `nan` for each frame that could not be scored,
/// or one without a frame where the whole could not be. Without a frame stands FovVideoVDP of a sequence.
///
/// # Errors
/// When the writer refuses.
pub fn write_results_csv(results: &RunResults, out: impl Write) -> io::Result<()> {
    let mut table = Table::new(out)?;
    for Comparison { scene, method, eye, report } in &results.comparisons {
        let row = TableRow { scene, method, eye, ..TableRow::default() };
        table.frames(&row, report)?;
        if let Some(summary) = FvvdpSummary::of(report) {
            table.fvvdp_sequence(&row, &summary)?;
        }
        for failure in &report.failures {
            let value = Some(Value::Measured(f64::NAN));
            table.write(&TableRow { frame: failure.frame, metric: ERROR, value, ..row })?;
        }
    }
    table.0.flush()
}

/// Which rows of results.csv are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// All.
    All,
    /// Those of whole frames.
    WholeFrames,
}

/// Reads results.csv of a folder, row by row.
///
/// # Errors
/// When it is missing, is not what was written, or `take` says that it is wrong: in words, behind which
/// the line is named.
pub fn read_results_csv(
    folder: &Path,
    which: Which,
    mut take: impl FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    let path = folder.join(RESULTS_CSV);
    let mut reader = csv::Reader::from_reader(open_result_file(&path)?);
    let headers = reader.headers().map_err(|error| unreadable(&path, error))?.clone();
    if !headers.iter().eq(COLUMNS) {
        let missing = COLUMNS.into_iter().find(|column| !headers.iter().any(|of| of == *column));
        let detail = match missing {
            Some(column) => format!("it has no column {column}"),
            None => format!("its columns are not these: {}", COLUMNS.join(", ")),
        };
        return Err(not_results(&path, detail));
    }
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| unreadable(&path, error))? {
        // Most rows are of bands; to whom they are of no interest they need not be numbers.
        let is_of_band = record.get(FROM).is_some_and(|cell| !cell.is_empty());
        if which == Which::WholeFrames && is_of_band {
            continue;
        }
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
        band: number(cell(FROM))?.zip(number(cell(10))?).map(Into::into),
        value: value.map(Value::Measured),
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

/// Whether a number of pixels is of interest where it is 0.
fn is_seldom(subject: Subject) -> bool {
    matches!(subject, Subject::PixelsOutsideBands | Subject::PixelsLeftOut)
}

struct Table<W: Write>(csv::Writer<W>);

impl<W: Write> Table<W> {
    fn new(out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS).map_err(io_error)?;
        Ok(Self(writer))
    }

    fn frames(&mut self, row: &TableRow<'_>, report: &ScoreReport) -> io::Result<()> {
        let edges = report.edges();
        for frame in &report.frames {
            let row = TableRow { frame: Some(frame.frame), ..*row };
            self.gaze(&row, frame)?;
            let mut before = None;
            for measured in frame.rows.iter().filter(|row| row.key.statistic().has_row) {
                self.measured(&row, measured, edges, before)?;
                before = Some(measured);
            }
        }
        Ok(())
    }

    /// A measured value; behind those of both pictures, their ratio.
    fn measured(
        &mut self,
        row: &TableRow<'_>,
        Row { key, value, .. }: Row,
        edges: &[(f64, f64)],
        before: Option<Row>,
    ) -> io::Result<()> {
        let band = match key.band {
            None => None,
            Some(index) => match edges.get(usize::from(index)) {
                Some(&(from, to)) => Some([from, to]),
                None => return Ok(()),
            },
        };
        if is_seldom(key.subject) && value == Some(0.0) {
            return Ok(());
        }
        let statistic = key.statistic();
        let cell = |value: f64| {
            if statistic.is_count { Value::Count(value as u64) } else { Value::Measured(value) }
        };
        let row = TableRow {
            image: key.image,
            metric: key.subject.name(),
            statistic: statistic.name,
            level: key.level.map(usize::from),
            band,
            value: value.map(cell),
            ..*row
        };
        self.write(&row)?;
        if key.image == Image::Test && statistic.has_ratio {
            // The reference's row is the one before.
            let of_reference = |row: &Row| row.key == key.of_image(Image::Reference);
            let reference = before.filter(of_reference).and_then(|row| row.value);
            let value = Sides { reference, test: value }.ratio().map(Value::Measured);
            self.write(&TableRow { image: Image::Ratio, value, ..row })?;
        }
        Ok(())
    }

    /// Where the eye looks, where that moves.
    fn gaze(&mut self, row: &TableRow<'_>, frame: &FrameResult) -> io::Result<()> {
        let [x, y] = frame.gaze_px.map_or([None; 2], |px| px.map(Some));
        for (metric, value) in
            [("gaze_x_px", x), ("gaze_y_px", y), (GAZE_STEP, frame.gaze_step_deg)]
        {
            if value.is_some() {
                self.write(&TableRow { metric, value: value.map(Value::Measured), ..*row })?;
            }
        }
        Ok(())
    }

    fn spatial_band(
        &mut self,
        row: &TableRow<'_>,
        index: usize,
        band: &SpatialBand,
    ) -> io::Result<()> {
        let row = TableRow { level: Some(index + 1), ..*row };
        let values =
            [("q_sustained", Some(band.sustained)), ("q_transient", band.transient)].into_iter();
        for (statistic, value) in values {
            if value.is_some() {
                self.write(&TableRow { statistic, value: value.map(Value::Measured), ..row })?;
            }
        }
        Ok(())
    }

    /// FovVideoVDP of a sequence.
    fn fvvdp_sequence(&mut self, row: &TableRow<'_>, summary: &FvvdpSummary) -> io::Result<()> {
        let row = TableRow { metric: FVVDP, ..*row };
        let value = summary.jod.map(Value::Measured);
        self.write(&TableRow { statistic: "jod", value, ..row })
    }

    fn statistics(&mut self, report: &ScoreReport) -> io::Result<()> {
        let summary = Summary::of(report);
        for (metric, statistics) in &summary.statistics {
            self.statistics_of(*metric, None, statistics)?;
        }
        for band in &summary.bands {
            for (metric, statistics) in &band.statistics {
                if let Some(statistics) = statistics {
                    let edges = Some([band.from_deg, band.to_deg]);
                    self.statistics_of(*metric, edges, statistics)?;
                }
            }
        }
        if let Some(fvvdp) = &summary.fvvdp {
            self.fvvdp_statistics(fvvdp)?;
        }
        self.compared_statistics(&summary)
    }

    fn fvvdp_statistics(&mut self, summary: &FvvdpSummary) -> io::Result<()> {
        let row = TableRow { metric: FVVDP, ..TableRow::default() };
        self.fvvdp_sequence(&row, summary)?;
        let value = summary.q.map(Value::Measured);
        self.write(&TableRow { statistic: "q", value, ..row })?;
        for (index, band) in summary.spatial_bands.iter().enumerate() {
            self.spatial_band(&row, index, band)?;
        }
        for share in &summary.shares {
            let (band, value) = (Some([share.from_deg, share.to_deg]), share.share);
            let value = value.map(Value::Measured);
            self.write(&TableRow { statistic: "share", band, value, ..row })?;
        }
        Ok(())
    }

    /// What is measured of each picture, over the frames.
    fn compared_statistics(&mut self, summary: &Summary) -> io::Result<()> {
        for (key, statistics) in summary.compared_by_metric() {
            let band = key.band.and_then(|index| summary.bands.get(usize::from(index)));
            let of = match key.statistic().name {
                "" => String::new(),
                name => format!("{name}_"),
            };
            let row = TableRow {
                metric: key.subject.name(),
                level: key.level.map(usize::from),
                band: band.map(|band| [band.from_deg, band.to_deg]),
                ..TableRow::default()
            };
            for (image, spread) in
                [(Image::Reference, statistics.reference), (Image::Test, statistics.test)]
            {
                let Some(spread) = spread else { continue };
                for (statistic, value) in
                    [("mean", spread.mean), ("min", spread.min), ("max", spread.max)]
                {
                    let (statistic, value) = (format!("{of}{statistic}"), Value::Measured(value));
                    let value = Some(value);
                    self.write(&TableRow { image, statistic: &statistic, value, ..row })?;
                }
            }
            if let Some(ratio) = statistics.ratio {
                let maximum = key.statistic().is_maximum();
                let statistic = format!("{of}{}", if maximum { "max" } else { "mean" });
                let (image, value) = (Image::Ratio, Some(Value::Measured(ratio)));
                self.write(&TableRow { image, statistic: &statistic, value, ..row })?;
            }
        }
        Ok(())
    }

    fn statistics_of(
        &mut self,
        metric: Metric,
        band: Option<[f64; 2]>,
        statistics: &Statistics,
    ) -> io::Result<()> {
        let identical = statistics.identical_frames.map(|n| Value::Count(n as u64));
        let measured = |value| Some(Value::Measured(value));
        for (statistic, value) in [
            ("mean", measured(statistics.mean)),
            ("min", measured(statistics.min)),
            ("max", measured(statistics.max)),
            ("identical_frames", identical),
            ("pooled", statistics.pooled.map(Value::Measured)),
        ] {
            if value.is_some() {
                let metric = metric.key();
                self.write(&TableRow { metric, statistic, band, value, ..TableRow::default() })?;
            }
        }
        Ok(())
    }

    fn write(&mut self, row: &TableRow<'_>) -> io::Result<()> {
        let text = |value: Option<Value>| value.map(|v| v.to_string()).unwrap_or_default();
        let edge = |edge: Option<f64>| text(edge.map(Value::Measured));
        let frame = row.frame.map(|f| f.to_string()).unwrap_or_default();
        let [from, to] = [0, 1].map(|side: usize| edge(row.band.map(|band| band[side])));
        let value = text(row.value);
        let level = row.level.map(|level| level.to_string()).unwrap_or_default();
        let TableRow { scene, method, eye, metric, statistic, .. } = *row;
        let image = row.image.name();
        let cells =
            [scene, method, "", eye, &frame, image, metric, statistic, &level, &from, &to, &value];
        self.0.write_record(cells).map_err(io_error)
    }
}

/// The reason itself, whose kind (a closed pipe, say) csv's own conversion would hide.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
