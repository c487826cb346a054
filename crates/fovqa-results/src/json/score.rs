//! The output of `--format json`, schema `fovqa.score/1`. New keys may be added, but keys are never
//! renamed.

use std::collections::BTreeMap;
use std::io::{self, Write};

use fovqa_metrics::{Image, Key, Metric, MetricKind, Row, Subject};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::compared::{HaarRecord, SideValues, haar, in_band, name, summary_haar};
use super::doubts::DoubtRecord;
use super::spectrum::{SpectrumRecord, spectra, summary_spectra};
use super::summary::{BandStatistics, ViewRecord, stats};
use super::values::{Each, MetricMap, Number, Stats};
use crate::compared::Sides;
use crate::fvvdp::{FvvdpSummary, SpatialBand, spatial_bands};
use crate::report::{Failure, FrameResult, ScoreReport};
use crate::spread::Spread;
use crate::stereo::StereoReport;
use crate::summary::Summary;
use crate::temporal::{TemporalSummaries, left_out};

/// Name and version of the format.
pub const SCORE_SCHEMA: &str = "fovqa.score/1";

/// Writes a report as indented JSON with a newline at its end.
///
/// # Errors
/// If the writer refuses.
pub fn write_json(report: &ScoreReport, out: impl Write) -> io::Result<()> {
    let errors = report.failures.iter().map(|failure| Error::of("", failure)).collect();
    write(report, errors, None::<()>, out)
}

/// Writes the results of two eyes as indented JSON with a newline at its end. The document is that of
/// both eyes together; `eyes` has the same keys for each eye.
///
/// # Errors
/// If the writer refuses.
pub fn write_stereo_json(report: &StereoReport, out: impl Write) -> io::Result<()> {
    let errors = report.failures().map(|(eye, failure)| Error::of(eye, failure)).collect();
    let of_eye = |report| contents(report, Vec::new());
    let eyes = Eyes { left: of_eye(&report.left), right: of_eye(&report.right) };
    write(&report.both, errors, Some(eyes), out)
}

fn write(
    report: &ScoreReport,
    errors: Vec<Error<'_>>,
    eyes: Option<impl Serialize>,
    mut out: impl Write,
) -> io::Result<()> {
    let document = Document {
        schema: SCORE_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        contents: contents(report, errors),
        eyes,
    };
    serde_json::to_writer_pretty(&mut out, &document)?;
    writeln!(out)
}

/// What a document says about a report.
fn contents<'a>(report: &'a ScoreReport, errors: Vec<Error<'a>>) -> impl Serialize + use<'a> {
    let summary = Summary::of(report);
    Contents {
        view: report.view.as_ref().map(ViewRecord::of),
        frames: Each(move || report.frames.iter().map(|frame| Frame::of(frame, report))),
        sequence: Sequence { temporal: summary.temporal.clone(), fvvdp: summary.fvvdp.clone() },
        summary: stats(&summary.statistics),
        summary_haar: summary_haar(&summary),
        summary_spectrum: summary_spectra(&summary),
        summary_bands: BandStatistics::all(&summary),
        gaze_held: report.gaze_held,
        plausibility: DoubtRecord::all(&report.frames),
        errors,
    }
}

#[derive(serde::Serialize)]
struct Document<C, E> {
    schema: &'static str,
    version: &'static str,
    #[serde(flatten)]
    contents: C,
    #[serde(skip_serializing_if = "Option::is_none")]
    eyes: Option<E>,
}

#[derive(serde::Serialize)]
struct Eyes<L, R> {
    left: L,
    right: R,
}

#[derive(serde::Serialize)]
struct Contents<'a, F> {
    view: Option<ViewRecord>,
    frames: F,
    sequence: Sequence,
    summary: MetricMap<Stats>,
    summary_bands: Vec<BandStatistics>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    summary_haar: Vec<HaarRecord<Spread>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    summary_spectrum: Vec<SpectrumRecord<Spread>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaze_held: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    plausibility: Vec<DoubtRecord>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Error<'a>>,
}

/// Measures of the sequence as a whole.
#[derive(serde::Serialize)]
struct Sequence {
    #[serde(flatten)]
    temporal: TemporalSummaries,
    #[serde(skip_serializing_if = "Option::is_none")]
    fvvdp: Option<FvvdpSummary>,
}

/// FovVideoVDP of a frame.
#[derive(serde::Serialize)]
struct Fvvdp {
    q: f64,
    /// JOD of this frame alone. The mean over frames is not the JOD of the sequence.
    frame_jod: f64,
    spatial_bands: Vec<SpatialBand>,
}

/// A temporal metric of a frame.
#[derive(serde::Serialize)]
struct Temporal {
    #[serde(flatten)]
    sides: SideValues<f64>,
    /// Share of pixels left out, for the reference and for the test.
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
    metrics: NamedValues,
    bands: Vec<Band>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    haar: Vec<HaarRecord<f64>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    spectrum: Vec<SpectrumRecord<f64>>,
    #[serde(flatten)]
    temporal: BTreeMap<&'static str, Temporal>,
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
    fn of(frame: &'a FrameResult, report: &ScoreReport) -> Self {
        let rows = &frame.rows;
        // FovVideoVDP has its own entry.
        let of_pair = |row: &Row| {
            let Key { image, level, band, .. } = row.key;
            let fvvdp = row.key.metric() == Some(Metric::Fvvdp);
            image == Image::Pair && level.is_none() && band.is_none() && !fvvdp
        };
        let measured = |row: &Row| row.key.metric().is_some() && row.key.statistic().has_row;
        let scores = rows.iter().filter(|row| of_pair(row) && measured(row));
        let scores = scores.map(|row| (name(&row.key), row.value.map(Number)));
        let bands = report.edges().iter().enumerate();
        Self {
            frame: frame.frame,
            reference: &frame.reference,
            test: &frame.test,
            gaze_px: frame.gaze_px,
            gaze_step_deg: frame.gaze_step_deg,
            metrics: NamedValues(scores.collect()),
            bands: bands.map(|(index, edges)| Band::of(frame, index, *edges)).collect(),
            haar: haar(frame, report.view.as_ref()),
            spectrum: spectra(frame, report.view.as_ref()),
            temporal: Temporal::all(frame),
            fvvdp: Fvvdp::of(frame, report),
            // Without a view there are no bands, so no pixels can lie outside them.
            pixels_outside_bands: rows.number(Key::pixels(Subject::PixelsOutsideBands)),
            pixels_left_out: rows.number(Key::pixels(Subject::PixelsLeftOut)),
        }
    }
}

impl Temporal {
    fn all(frame: &FrameResult) -> BTreeMap<&'static str, Self> {
        let whole = |key: &Key| key.band.is_none() && key.statistic().name.is_empty();
        let of = |(key, sides): (Key, Sides<Option<f64>>)| {
            let metric = key.metric().filter(|metric| metric.is(MetricKind::Temporal))?;
            let left_out = left_out(metric)?;
            let share = |image| frame.rows.value(left_out.of_image(image)).unwrap_or_default();
            let left_out = share(Image::Reference);
            let sides = SideValues::of_frame(&sides, key.statistic());
            let of = Self { sides, left_out, left_out_test: share(Image::Test) };
            whole(&key).then_some((metric.key(), of))
        };
        frame.compared().filter_map(of).collect()
    }
}

impl Fvvdp {
    fn of(frame: &FrameResult, report: &ScoreReport) -> Option<Self> {
        let key = |statistic| Key::named(Subject::Metric(Metric::Fvvdp), statistic);
        let value = |statistic| frame.rows.value(key(statistic)?);
        let bands = report.fvvdp.as_ref();
        let bands = bands.map(|sight| spatial_bands(sight, std::slice::from_ref(frame)));
        Some(Self {
            q: value("q")?,
            frame_jod: value("frame_jod")?,
            spatial_bands: bands.unwrap_or_default(),
        })
    }
}

/// Values with their names, in the order of results.
struct NamedValues(Vec<(String, Option<Number>)>);

impl Serialize for NamedValues {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

struct Band {
    from_deg: f64,
    to_deg: f64,
    pixels: u64,
    /// The counts that the scores of the band are pooled by.
    counts: Vec<(String, u64)>,
    scores: Vec<(String, Option<Number>)>,
    compared: Vec<(String, SideValues<f64>)>,
    /// Other statistics of a pair.
    others: Vec<(String, Option<Number>)>,
}

impl Band {
    fn of(frame: &FrameResult, index: usize, (from_deg, to_deg): (f64, f64)) -> Self {
        let of_pair = |row: &Row| {
            let Key { image, level, band, .. } = row.key;
            let here = band.map(usize::from) == Some(index) && level.is_none();
            here && image == Image::Pair && row.key.metric().is_some()
        };
        let (mut counts, mut scores, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for Row { key, value, .. } in frame.rows.iter().filter(of_pair) {
            match key {
                key if key.statistic().is_count => {
                    counts.push((name(&key), value.unwrap_or_default() as u64));
                }
                key if key.is_score() => scores.push((name(&key), value.map(Number))),
                key => others.push((name(&key), value.map(Number))),
            }
        }
        let pixels = frame.rows.number(Key::pixels(Subject::Pixels).in_band(index));
        let compared = in_band(frame, index);
        Self { from_deg, to_deg, pixels, counts, scores, compared, others }
    }
}

impl Serialize for Band {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("from_deg", &self.from_deg)?;
        map.serialize_entry("to_deg", &self.to_deg)?;
        map.serialize_entry("pixels", &self.pixels)?;
        for (name, count) in &self.counts {
            map.serialize_entry(name, count)?;
        }
        for (name, value) in &self.scores {
            map.serialize_entry(name, value)?;
        }
        for (name, sides) in &self.compared {
            map.serialize_entry(name, sides)?;
        }
        for (name, value) in &self.others {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

#[derive(serde::Serialize)]
struct Error<'a> {
    /// The eye, if there are two.
    #[serde(skip_serializing_if = "str::is_empty")]
    eye: &'static str,
    frame: Option<i64>,
    reference: &'a str,
    test: &'a str,
    message: &'a str,
}

impl<'a> Error<'a> {
    fn of(eye: &'static str, failure: &'a Failure) -> Self {
        let Failure { frame, reference, test, message, .. } = failure;
        Self { eye, frame: *frame, reference, test, message }
    }
}
