//! `--format json`, schema `fovqa.score/1`. Keys may be added, never renamed.

use std::io::{self, Write};

use fovqa_metrics::Metric;
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::compared::{HaarRecord, SideValues, haar, in_band, summary_haar};
use super::summary::{BandStatistics, ViewRecord, stats};
use super::values::{MetricMap, Number, Stats};
use crate::fvvdp::{FvvdpSummary, SpatialBand};
use crate::report::{FrameResult, ScoreReport, ViewResult};
use crate::summary::{AtdSummary, Spread, Summary};

/// Name and version of the format.
pub const SCORE_SCHEMA: &str = "fovqa.score/1";

/// Writes a report as JSON, indented, with a newline at its end.
///
/// # Errors
/// When the writer refuses.
pub fn write_json(report: &ScoreReport, mut out: impl Write) -> io::Result<()> {
    let summary = Summary::of(report);
    let document = Document {
        schema: SCORE_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        view: report.view.as_ref().map(ViewRecord::of),
        frames: report.frames.iter().map(|f| Frame::of(f, report.view.as_ref())).collect(),
        sequence: Sequence { atd: summary.atd.clone(), fvvdp: summary.fvvdp.clone() },
        summary: stats(&summary.statistics),
        summary_haar: summary_haar(&summary),
        summary_bands: BandStatistics::all(&summary),
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

#[derive(serde::Serialize)]
struct Document<'a> {
    schema: &'a str,
    version: &'static str,
    view: Option<ViewRecord>,
    frames: Vec<Frame<'a>>,
    sequence: Sequence,
    summary: MetricMap<Stats>,
    summary_bands: Vec<BandStatistics>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    summary_haar: Vec<HaarRecord<Spread>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_held: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Error<'a>>,
}

/// Measures of the sequence as a whole.
#[derive(serde::Serialize)]
struct Sequence {
    #[serde(skip_serializing_if = "Option::is_none")]
    atd: Option<AtdSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fvvdp: Option<FvvdpSummary>,
}

/// FovVideoVDP of a frame.
#[derive(serde::Serialize)]
struct Fvvdp {
    q: f64,
    /// Of this frame alone: it does not average to the sequence's.
    frame_jod: f64,
    spatial_bands: Vec<SpatialBand>,
}

/// Differences of a frame to the one before it.
#[derive(serde::Serialize)]
struct Atd {
    #[serde(flatten)]
    sides: SideValues<f64>,
    /// Share of pixels left out, of the reference and of the test.
    left_out: f64,
    left_out_test: f64,
}

#[derive(serde::Serialize)]
struct Frame<'a> {
    frame: i64,
    reference: &'a str,
    test: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_px: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_step_deg: Option<f64>,
    metrics: MetricMap<Number>,
    bands: Vec<Band>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    haar: Vec<HaarRecord<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    atd: Option<Atd>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fvvdp: Option<Fvvdp>,
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
            gaze_step_deg: frame.gaze_step_deg,
            metrics: MetricMap(scores.scores.iter().map(|(m, v)| (*m, Number(*v))).collect()),
            bands: edges
                .iter()
                .zip(&scores.bands)
                .enumerate()
                .map(|(index, (&(from_deg, to_deg), band))| Band {
                    from_deg,
                    to_deg,
                    pixels: band.pixels,
                    ssim_map_pixels: band.ssim_map_pixels,
                    scores: band.scores.iter().map(|(m, v)| (*m, v.map(Number))).collect(),
                    compared: in_band(frame, index),
                    fvvdp_share: frame.fvvdp.iter().map(|fvvdp| fvvdp.share(index)).collect(),
                })
                .collect(),
            haar: haar(frame, view),
            atd: frame.atd.as_ref().zip(frame.compared()).map(|(atd, (_, sides))| {
                let share = atd.map(|side| side.left_out() as f64 / (side.pixels as f64).max(1.0));
                Atd { sides: sides.into(), left_out: share.reference, left_out_test: share.test }
            }),
            fvvdp: frame.fvvdp.as_ref().map(|fvvdp| Fvvdp {
                q: fvvdp.q,
                frame_jod: fvvdp.frame_jod,
                spatial_bands: fvvdp.bands.iter().map(SpatialBand::from).collect(),
            }),
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
    ssim_map_pixels: Option<u64>,
    scores: Vec<(Metric, Option<Number>)>,
    compared: Vec<(Metric, SideValues<f64>)>,
    /// What of FovVideoVDP's Q lies in the band: one value where that is asked for, else none.
    fvvdp_share: Vec<Option<f64>>,
}

impl Serialize for Band {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("from_deg", &self.from_deg)?;
        map.serialize_entry("to_deg", &self.to_deg)?;
        map.serialize_entry("pixels", &self.pixels)?;
        if let Some(pixels) = self.ssim_map_pixels {
            map.serialize_entry("ssim_map_pixels", &pixels)?;
        }
        for (metric, value) in &self.scores {
            map.serialize_entry(metric.key(), value)?;
        }
        for (metric, sides) in &self.compared {
            map.serialize_entry(metric.key(), sides)?;
        }
        for share in &self.fvvdp_share {
            map.serialize_entry("fvvdp_share", share)?;
        }
        map.end()
    }
}

#[derive(serde::Serialize)]
struct Error<'a> {
    frame: Option<i64>,
    reference: &'a str,
    test: &'a str,
    message: &'a str,
}
