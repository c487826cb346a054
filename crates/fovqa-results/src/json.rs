//! `--format json`, schema `fovqa.score/1`. Keys may be added, never renamed.

use std::collections::BTreeMap;
use std::io::{self, Write};

use fovqa_metrics::Metric;
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::report::{FrameResult, ScoreReport, ViewResult};
use crate::summary::{BandSummary, Statistics, Summary};

/// Name and version of the format.
pub const SCHEMA: &str = "fovqa.score/1";

/// Writes a report as JSON, indented, with a newline at its end.
///
/// # Errors
/// When the writer refuses.
pub fn write_json(report: &ScoreReport, mut out: impl Write) -> io::Result<()> {
    let summary = Summary::of(report);
    let document = Document {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        view: report.view.as_ref().map(View::of),
        frames: report.frames.iter().map(|f| Frame::of(f, report.view.as_ref())).collect(),
        sequence: BTreeMap::new(),
        summary: MetricMap(
            summary.statistics.iter().map(|(m, s)| (*m, Stats::of(*m, s))).collect(),
        ),
        summary_bands: summary.bands.iter().map(BandStats::of).collect(),
        gaze_held: report.gaze_held,
        errors: report
            .failures
            .iter()
            .map(|f| Error {
                frame: f.frame,
                reference: &f.reference,
                test: &f.test,
                message: &f.message,
            })
            .collect(),
    };
    serde_json::to_writer_pretty(&mut out, &document)?;
    writeln!(out)
}

/// A number, with infinity as the string `"inf"`.
#[derive(Clone, Copy)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_infinite() {
            serializer.serialize_str(if self.0 > 0.0 { "inf" } else { "-inf" })
        } else {
            serializer.serialize_f64(self.0)
        }
    }
}

/// Values under the keys of their metrics, in the order of tables.
struct MetricMap<T>(Vec<(Metric, T)>);

impl<T: Serialize> Serialize for MetricMap<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (metric, value) in &self.0 {
            map.serialize_entry(metric.key(), value)?;
        }
        map.end()
    }
}

#[derive(serde::Serialize)]
struct Document<'a> {
    schema: &'a str,
    version: &'a str,
    view: Option<View<'a>>,
    frames: Vec<Frame<'a>>,
    sequence: BTreeMap<&'a str, Number>,
    summary: MetricMap<Stats>,
    summary_bands: Vec<BandStats>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_held: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Error<'a>>,
}

#[derive(serde::Serialize)]
struct View<'a> {
    width: usize,
    height: usize,
    focal_px: [f64; 2],
    gaze_px: [f64; 2],
    eccentricity: &'a str,
}

impl<'a> View<'a> {
    fn of(view: &'a ViewResult) -> Self {
        Self {
            width: view.size[0],
            height: view.size[1],
            focal_px: view.focal_px,
            gaze_px: view.gaze_px,
            eccentricity: view.eccentricity,
        }
    }
}

#[derive(serde::Serialize)]
struct Frame<'a> {
    frame: u64,
    reference: &'a str,
    test: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_px: Option<[f64; 2]>,
    metrics: MetricMap<Number>,
    bands: Vec<Band>,
    #[serde(skip_serializing_if = "is_zero")]
    pixels_outside_bands: u64,
    #[serde(skip_serializing_if = "is_zero")]
    pixels_left_out: u64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl<'a> Frame<'a> {
    fn of(frame: &'a FrameResult, view: Option<&ViewResult>) -> Self {
        let scores = &frame.scores;
        let edges = view.map(|v| v.bands_deg.as_slice()).unwrap_or_default();
        Self {
            frame: frame.frame,
            reference: &frame.reference,
            test: &frame.test,
            gaze_px: frame.gaze_px,
            metrics: MetricMap(scores.scores.iter().map(|(m, v)| (*m, Number(*v))).collect()),
            bands: edges
                .iter()
                .zip(&scores.bands)
                .map(|(&(from_deg, to_deg), band)| Band {
                    from_deg,
                    to_deg,
                    pixels: band.pixels,
                    scores: band.scores.iter().map(|(m, v)| (*m, v.map(Number))).collect(),
                })
                .collect(),
            // Without a view there are no bands to be outside of.
            pixels_outside_bands: if view.is_some() { scores.outside_bands } else { 0 },
            pixels_left_out: scores.left_out,
        }
    }
}

struct Band {
    from_deg: f64,
    to_deg: f64,
    pixels: u64,
    scores: Vec<(Metric, Option<Number>)>,
}

impl Serialize for Band {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("from_deg", &self.from_deg)?;
        map.serialize_entry("to_deg", &self.to_deg)?;
        map.serialize_entry("pixels", &self.pixels)?;
        for (metric, value) in &self.scores {
            map.serialize_entry(metric.key(), value)?;
        }
        map.end()
    }
}

struct Stats {
    metric: Metric,
    statistics: Statistics,
}

impl Stats {
    fn of(metric: Metric, statistics: &Statistics) -> Self {
        Self { metric, statistics: *statistics }
    }
}

impl Serialize for Stats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("mean", &Number(self.statistics.mean))?;
        map.serialize_entry("min", &Number(self.statistics.min))?;
        map.serialize_entry("max", &Number(self.statistics.max))?;
        if let Some(identical) = self.statistics.identical_frames {
            map.serialize_entry("identical_frames", &identical)?;
        }
        if let Some(pooled) = self.statistics.pooled {
            map.serialize_entry(&format!("{}_pooled", self.metric.key()), &Number(pooled))?;
        }
        map.end()
    }
}

struct BandStats {
    from_deg: f64,
    to_deg: f64,
    pixels: u64,
    statistics: Vec<(Metric, Option<Stats>)>,
}

impl BandStats {
    fn of(band: &BandSummary) -> Self {
        let statistics =
            band.statistics.iter().map(|(m, s)| (*m, s.as_ref().map(|s| Stats::of(*m, s))));
        Self {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            pixels: band.pixels,
            statistics: statistics.collect(),
        }
    }
}

impl Serialize for BandStats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("from_deg", &self.from_deg)?;
        map.serialize_entry("to_deg", &self.to_deg)?;
        map.serialize_entry("pixels", &self.pixels)?;
        for (metric, statistics) in &self.statistics {
            map.serialize_entry(metric.key(), statistics)?;
        }
        map.end()
    }
}

#[derive(serde::Serialize)]
struct Error<'a> {
    frame: Option<u64>,
    reference: &'a str,
    test: &'a str,
    message: &'a str,
}
