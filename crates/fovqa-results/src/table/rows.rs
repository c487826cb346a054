//! All values of a report or a run as rows of one long, tidy table: one row per value.

use std::io;

use fovqa_metrics::{Image, Metric, Row, Subject};

use super::row::{ERROR, GAZE_STEP, TableRow, Value};
use crate::compared::Sides;
use crate::fvvdp::{FvvdpSummary, SpatialBand};
use crate::report::{Comparison, FrameResult, RunResults, ScoreReport};
use crate::summary::{Statistics, Summary};

const FVVDP: &str = "fvvdp";

/// The rows of a report: the values of each frame, followed by the statistics over all frames,
/// which have no frame number.
///
/// # Errors
/// If the sink refuses a row.
pub(super) fn rows_of_report(report: &ScoreReport, sink: &mut Sink<'_>) -> io::Result<()> {
    let mut table = Table(sink);
    table.frames(&TableRow::default(), report)?;
    table.statistics(report)
}

/// The rows of a run: the values of each frame, comparison by comparison. After the rows of a
/// comparison, each frame that could not be scored has a row [`ERROR`] with the value `nan`. If the
/// whole comparison could not be scored, there is one such row without a frame. FovVideoVDP of a
/// sequence is in a row without a frame.
///
/// # Errors
/// If the sink refuses a row.
pub(crate) fn rows_of_run(results: &RunResults, sink: &mut Sink<'_>) -> io::Result<()> {
    let mut table = Table(sink);
    for comparison in &results.comparisons {
        let Comparison { scene, eye, report, .. } = comparison;
        let (method, parameters) = comparison.written();
        let row = TableRow { scene, method, parameters, eye, ..TableRow::default() };
        table.frames(&row, report)?;
        if let Some(summary) = FvvdpSummary::of(report) {
            table.fvvdp_sequence(&row, &summary)?;
        }
        for failure in &report.failures {
            let value = Some(Value::Measured(f64::NAN));
            table.write(&TableRow { frame: failure.frame, metric: ERROR, value, ..row })?;
        }
    }
    Ok(())
}

/// Whether a pixel count is written only if it is not 0.
fn is_seldom(subject: Subject) -> bool {
    matches!(subject, Subject::PixelsOutsideBands | Subject::PixelsLeftOut)
}

/// Receives one row.
pub(crate) type Sink<'s> = dyn FnMut(&TableRow<'_>) -> io::Result<()> + 's;

struct Table<'s, 'a>(&'a mut Sink<'s>);

impl Table<'_, '_> {
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

    /// Writes a measured value. After the values of both images, it writes their ratio.
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
            level: key.level.map(i64::from),
            band,
            value: value.map(cell),
            ..*row
        };
        self.write(&row)?;
        if key.image == Image::Test && statistic.has_ratio {
            // The row of the reference comes directly before this one.
            let of_reference = |row: &Row| row.key == key.of_image(Image::Reference);
            let reference = before.filter(of_reference).and_then(|row| row.value);
            let value = Sides { reference, test: value }.ratio(statistic).map(Value::Measured);
            self.write(&TableRow { image: Image::Ratio, value, ..row })?;
        }
        Ok(())
    }

    /// Writes the gaze, if it moves.
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
        let row = TableRow { level: Some(index as i64 + 1), ..*row };
        let values =
            [("q_sustained", Some(band.sustained)), ("q_transient", band.transient)].into_iter();
        for (statistic, value) in values {
            if value.is_some() {
                self.write(&TableRow { statistic, value: value.map(Value::Measured), ..row })?;
            }
        }
        Ok(())
    }

    /// Writes FovVideoVDP of a sequence.
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

    /// Writes the measures of each image over the frames.
    fn compared_statistics(&mut self, summary: &Summary) -> io::Result<()> {
        for (key, statistics) in summary.compared_by_metric() {
            let band = key.band.and_then(|index| summary.bands.get(usize::from(index)));
            let of = match key.statistic().name {
                "" => String::new(),
                name => format!("{name}_"),
            };
            let row = TableRow {
                metric: key.subject.name(),
                level: key.level.map(i64::from),
                band: band.map(|band| [band.from_deg, band.to_deg]),
                ..TableRow::default()
            };
            for (image, spread) in
                [(Image::Reference, statistics.reference), (Image::Test, statistics.test)]
            {
                let Some(spread) = spread else { continue };
                let pooled = spread.pooled.map(|pooled| ("pooled", pooled));
                for (statistic, value) in
                    [("mean", spread.mean), ("min", spread.min), ("max", spread.max)]
                        .into_iter()
                        .chain(pooled)
                {
                    let (statistic, value) = (format!("{of}{statistic}"), Value::Measured(value));
                    let value = Some(value);
                    self.write(&TableRow { image, statistic: &statistic, value, ..row })?;
                }
            }
            if let Some(ratio) = statistics.ratio {
                let what = match key.statistic() {
                    statistic if statistic.is_maximum() => "max",
                    statistic if statistic.pools_values() => "pooled",
                    _ => "mean",
                };
                let statistic = format!("{of}{what}");
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
        (self.0)(row)
    }
}
