//! `--format csv`: one long, tidy table, a row a value. Empty cells where a column does not apply.

use std::io::{self, Write};

use fovqa_metrics::Metric;

use crate::report::ScoreReport;
use crate::summary::{Statistics, Summary};

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

/// A row of the table; `scene`, `method`, `parameters`, `eye` and `level` do not apply to `score`.
#[derive(Default)]
struct Row<'a> {
    frame: Option<u64>,
    metric: &'a str,
    statistic: &'a str,
    band: Option<(f64, f64)>,
    value: Option<f64>,
}

/// Writes a report as CSV: each frame's values and then, without a frame, the statistics over
/// all of them.
///
/// # Errors
/// When the writer refuses.
pub fn write_csv(report: &ScoreReport, out: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COLUMNS).map_err(io_error)?;
    let edges = report.view.as_ref().map(|v| v.bands_deg.as_slice()).unwrap_or_default();
    for frame in &report.frames {
        let row = Row { frame: Some(frame.frame), ..Row::default() };
        for (metric, value) in &frame.scores.scores {
            write(&mut writer, &Row { metric: metric.key(), value: Some(*value), ..row })?;
        }
        for (metric, pixels) in [
            ("pixels_outside_bands", if edges.is_empty() { 0 } else { frame.scores.outside_bands }),
            ("pixels_left_out", frame.scores.left_out),
        ] {
            if pixels > 0 {
                write(&mut writer, &Row { metric, value: Some(pixels as f64), ..row })?;
            }
        }
        for (&band, scores) in edges.iter().zip(&frame.scores.bands) {
            let row = Row { band: Some(band), ..row };
            let pixels = Some(scores.pixels as f64);
            write(&mut writer, &Row { metric: "pixels", value: pixels, ..row })?;
            for (metric, value) in &scores.scores {
                write(&mut writer, &Row { metric: metric.key(), value: *value, ..row })?;
            }
        }
    }
    let summary = Summary::of(report);
    for (metric, statistics) in &summary.statistics {
        write_statistics(&mut writer, *metric, None, statistics)?;
    }
    for band in &summary.bands {
        for (metric, statistics) in &band.statistics {
            if let Some(statistics) = statistics {
                let edges = Some((band.from_deg, band.to_deg));
                write_statistics(&mut writer, *metric, edges, statistics)?;
            }
        }
    }
    writer.flush()
}

fn write_statistics(
    writer: &mut csv::Writer<impl Write>,
    metric: Metric,
    band: Option<(f64, f64)>,
    statistics: &Statistics,
) -> io::Result<()> {
    let identical = statistics.identical_frames.map(|n| n as f64);
    for (statistic, value) in [
        ("mean", Some(statistics.mean)),
        ("min", Some(statistics.min)),
        ("max", Some(statistics.max)),
        ("identical_frames", identical),
        ("pooled", statistics.pooled),
    ] {
        if value.is_some() {
            write(writer, &Row { metric: metric.key(), statistic, band, value, frame: None })?;
        }
    }
    Ok(())
}

fn write(writer: &mut csv::Writer<impl Write>, row: &Row<'_>) -> io::Result<()> {
    let text = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let frame = row.frame.map(|f| f.to_string()).unwrap_or_default();
    let (from, to) = (text(row.band.map(|b| b.0)), text(row.band.map(|b| b.1)));
    let value = text(row.value);
    let cells = ["", "", "", "", &frame, "pair", row.metric, row.statistic, "", &from, &to, &value];
    writer.write_record(cells).map_err(io_error)
}

/// The reason itself, whose kind (a closed pipe, say) csv's own conversion would hide.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
