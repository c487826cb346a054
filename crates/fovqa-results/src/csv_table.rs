//! One long, tidy table, a row a value: what `score --format csv` prints, and results.csv. Empty
//! cells where a column does not apply. Measured values and edges keep their point (`5.0`):
//! readers that guess a column's type from its first rows are not misled. Counts are whole.

use std::fmt;
use std::io::{self, Write};

use fovqa_metrics::{Image, Metric};

use crate::compared::{Compared, HaarStatistic};
use crate::fvvdp::{FvvdpSummary, SpatialBand};
use crate::report::{Comparison, FrameResult, RunResults, ScoreReport};
use crate::summary::{Statistics, Summary};
use crate::table::{COLUMNS, ERROR};

const FVVDP: &str = "fvvdp";

/// A row of the table; `parameters` belongs to sweeps to come.
#[derive(Default, Clone, Copy)]
struct Row<'a> {
    scene: &'a str,
    method: &'a str,
    eye: &'a str,
    frame: Option<i64>,
    image: Image,
    metric: &'a str,
    statistic: &'a str,
    level: Option<usize>,
    band: Option<(f64, f64)>,
    value: Option<Value>,
}

/// A cell of the last column.
#[derive(Clone, Copy)]
enum Value {
    Measured(f64),
    Count(u64),
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
    table.frames(&Row::default(), report)?;
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
        let row = Row { scene, method, eye, ..Row::default() };
        table.frames(&row, report)?;
        if let Some(summary) = FvvdpSummary::of(report) {
            table.fvvdp_sequence(&row, &summary)?;
        }
        for failure in &report.failures {
            let value = Some(Value::Measured(f64::NAN));
            table.write(&Row { frame: failure.frame, metric: ERROR, value, ..row })?;
        }
    }
    table.0.flush()
}

struct Table<W: Write>(csv::Writer<W>);

impl<W: Write> Table<W> {
    fn new(out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS).map_err(io_error)?;
        Ok(Self(writer))
    }

    fn frames(&mut self, row: &Row<'_>, report: &ScoreReport) -> io::Result<()> {
        let edges = report.view.as_ref().map(|v| v.bands_deg.as_slice()).unwrap_or_default();
        for frame in &report.frames {
            let row = Row { frame: Some(frame.frame), ..*row };
            self.gaze(&row, frame)?;
            for (metric, value) in &frame.scores.scores {
                let value = Some(Value::Measured(*value));
                self.write(&Row { metric: metric.key(), value, ..row })?;
            }
            self.fvvdp(&row, frame)?;
            self.whole_frame_compared(&row, frame)?;
            let outside = if edges.is_empty() { 0 } else { frame.scores.outside_bands };
            for (metric, pixels) in
                [("pixels_outside_bands", outside), ("pixels_left_out", frame.scores.left_out)]
            {
                if pixels > 0 {
                    self.write(&Row { metric, value: Some(Value::Count(pixels)), ..row })?;
                }
            }
            for (index, (&band, scores)) in edges.iter().zip(&frame.scores.bands).enumerate() {
                let row = Row { band: Some(band), ..row };
                let pixels = Some(Value::Count(scores.pixels));
                self.write(&Row { metric: "pixels", value: pixels, ..row })?;
                if let Some(pixels) = scores.ssim_map_pixels {
                    let (metric, value) = (Metric::Ssim.key(), Some(Value::Count(pixels)));
                    self.write(&Row { metric, statistic: "map_pixels", value, ..row })?;
                }
                for (metric, value) in &scores.scores {
                    self.write(&Row {
                        metric: metric.key(),
                        value: value.map(Value::Measured),
                        ..row
                    })?;
                }
                if let Some(fvvdp) = &frame.fvvdp {
                    let value = fvvdp.share(index).map(Value::Measured);
                    self.write(&Row { metric: FVVDP, statistic: "share", value, ..row })?;
                }
                self.compared(&row, &frame.compared_in(index))?;
            }
            for level in 1..=frame.haar_levels() {
                for (index, &band) in edges.iter().enumerate() {
                    let row = Row { band: Some(band), level: Some(level), ..row };
                    let coefficients = Some(Value::Count(frame.coefficients(level, index)));
                    let (metric, statistic) = (Metric::Haar.key(), "coefficients");
                    self.write(&Row { metric, statistic, value: coefficients, ..row })?;
                    self.compared(&row, &frame.compared_haar(level, index))?;
                }
            }
        }
        Ok(())
    }

    /// Where the eye looks, where that moves.
    fn gaze(&mut self, row: &Row<'_>, frame: &FrameResult) -> io::Result<()> {
        let [x, y] = frame.gaze_px.map_or([None; 2], |px| px.map(Some));
        for (metric, value) in
            [("gaze_x_px", x), ("gaze_y_px", y), ("gaze_step_deg", frame.gaze_step_deg)]
        {
            if value.is_some() {
                self.write(&Row { metric, value: value.map(Value::Measured), ..*row })?;
            }
        }
        Ok(())
    }

    /// FovVideoVDP of a frame, and Q by spatial frequency, the finest first.
    fn fvvdp(&mut self, row: &Row<'_>, frame: &FrameResult) -> io::Result<()> {
        let Some(fvvdp) = &frame.fvvdp else { return Ok(()) };
        let row = Row { metric: FVVDP, ..*row };
        for (statistic, value) in [("frame_jod", fvvdp.frame_jod), ("q", fvvdp.q)] {
            self.write(&Row { statistic, value: Some(Value::Measured(value)), ..row })?;
        }
        for (index, band) in fvvdp.bands.iter().enumerate() {
            self.spatial_band(&row, index, &SpatialBand::from(band))?;
        }
        Ok(())
    }

    fn spatial_band(&mut self, row: &Row<'_>, index: usize, band: &SpatialBand) -> io::Result<()> {
        let row = Row { level: Some(index + 1), ..*row };
        let values =
            [("q_sustained", Some(band.sustained)), ("q_transient", band.transient)].into_iter();
        for (statistic, value) in values {
            if value.is_some() {
                self.write(&Row { statistic, value: value.map(Value::Measured), ..row })?;
            }
        }
        Ok(())
    }

    /// FovVideoVDP of a sequence.
    fn fvvdp_sequence(&mut self, row: &Row<'_>, summary: &FvvdpSummary) -> io::Result<()> {
        let row = Row { metric: FVVDP, ..*row };
        let value = summary.jod.map(Value::Measured);
        self.write(&Row { statistic: "jod", value, ..row })
    }

    /// What is compared of whole frames, with the share of pixels that could not be.
    fn whole_frame_compared(&mut self, row: &Row<'_>, frame: &FrameResult) -> io::Result<()> {
        self.compared(row, frame.compared().as_slice())?;
        let Some(atd) = &frame.atd else { return Ok(()) };
        for (image, side) in [(Image::Reference, &atd.reference), (Image::Test, &atd.test)] {
            let share = side.left_out() as f64 / (side.pixels as f64).max(1.0);
            let (metric, statistic) = (Metric::Atd.key(), "left_out");
            let value = Some(Value::Measured(share));
            self.write(&Row { image, metric, statistic, value, ..*row })?;
        }
        Ok(())
    }

    /// Three rows each: of the reference, of the test, and their ratio.
    fn compared(&mut self, row: &Row<'_>, compared: &[Compared]) -> io::Result<()> {
        for (measure, sides) in compared {
            let statistic = measure.statistic.map(HaarStatistic::name).unwrap_or_default();
            for (image, value) in [
                (Image::Reference, sides.reference),
                (Image::Test, sides.test),
                (Image::Ratio, sides.ratio()),
            ] {
                let metric = measure.metric.key();
                let value = value.map(Value::Measured);
                self.write(&Row { image, metric, statistic: &statistic, value, ..*row })?;
            }
        }
        Ok(())
    }

    fn statistics(&mut self, report: &ScoreReport) -> io::Result<()> {
        let summary = Summary::of(report);
        for (metric, statistics) in &summary.statistics {
            self.statistics_of(*metric, None, statistics)?;
        }
        for band in &summary.bands {
            for (metric, statistics) in &band.statistics {
                if let Some(statistics) = statistics {
                    let edges = Some((band.from_deg, band.to_deg));
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
        let row = Row { metric: FVVDP, ..Row::default() };
        self.fvvdp_sequence(&row, summary)?;
        let value = summary.q.map(Value::Measured);
        self.write(&Row { statistic: "q", value, ..row })?;
        for (index, band) in summary.spatial_bands.iter().enumerate() {
            self.spatial_band(&row, index, band)?;
        }
        for share in &summary.shares {
            let (band, value) = (Some((share.from_deg, share.to_deg)), share.share);
            let value = value.map(Value::Measured);
            self.write(&Row { statistic: "share", band, value, ..row })?;
        }
        Ok(())
    }

    fn compared_statistics(&mut self, summary: &Summary) -> io::Result<()> {
        for (measure, statistics) in &summary.compared {
            let band = measure.band.and_then(|index| summary.bands.get(index));
            let of = measure.statistic.map(|statistic| format!("{}_", statistic.name()));
            let of = of.unwrap_or_default();
            let row = Row {
                metric: measure.metric.key(),
                level: measure.level,
                band: band.map(|band| (band.from_deg, band.to_deg)),
                ..Row::default()
            };
            for (image, spread) in
                [(Image::Reference, statistics.reference), (Image::Test, statistics.test)]
            {
                let Some(spread) = spread else { continue };
                for (statistic, value) in
                    [("mean", spread.mean), ("min", spread.min), ("max", spread.max)]
                {
                    let (statistic, value) = (format!("{of}{statistic}"), Value::Measured(value));
                    self.write(&Row { image, statistic: &statistic, value: Some(value), ..row })?;
                }
            }
            if let Some(ratio) = statistics.ratio {
                let maximum = measure.statistic.is_some_and(HaarStatistic::is_maximum);
                let statistic = format!("{of}{}", if maximum { "max" } else { "mean" });
                let (image, value) = (Image::Ratio, Some(Value::Measured(ratio)));
                self.write(&Row { image, statistic: &statistic, value, ..row })?;
            }
        }
        Ok(())
    }

    fn statistics_of(
        &mut self,
        metric: Metric,
        band: Option<(f64, f64)>,
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
                let row = Row { metric: metric.key(), statistic, band, value, ..Row::default() };
                self.write(&row)?;
            }
        }
        Ok(())
    }

    fn write(&mut self, row: &Row<'_>) -> io::Result<()> {
        let text = |value: Option<Value>| value.map(|v| v.to_string()).unwrap_or_default();
        let edge = |edge: Option<f64>| text(edge.map(Value::Measured));
        let frame = row.frame.map(|f| f.to_string()).unwrap_or_default();
        let (from, to) = (edge(row.band.map(|b| b.0)), edge(row.band.map(|b| b.1)));
        let value = text(row.value);
        let level = row.level.map(|level| level.to_string()).unwrap_or_default();
        let Row { scene, method, eye, metric, statistic, .. } = row;
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
