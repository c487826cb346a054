//! The lines of a journal behind its first, one kind after the other.

use std::collections::BTreeMap;

use fovqa_config::Eye;
use fovqa_metrics::{BandScores, Metric, PairScores, Profile};
use fovqa_results::{AtdGuides, Failure, FrameResult, FvvdpSight, ViewResult};
use serde::{Deserialize, Serialize};

use super::measures::{AtdRecord, FvvdpRecord, ProfileRecord, SidesRecord};
use super::number::{Number, maybe, read};
use crate::findings::{Finished, Named, Settled};

/// A pair that was scored.
#[derive(Serialize, Deserialize)]
pub(super) struct FrameRecord {
    pub(super) scene: String,
    pub(super) method: String,
    pub(super) eye: Option<Eye>,
    pub(super) step: usize,
    frame: i64,
    reference: String,
    test: String,
    gaze_px: Option<[f64; 2]>,
    gaze_step_deg: Option<Number>,
    scores: BTreeMap<String, Number>,
    bands: Vec<BandRecord>,
    pixels: u64,
    pixels_outside_bands: u64,
    pixels_left_out: u64,
    squared_error: Option<Number>,
    weighted_squared_error: Option<(Number, Number)>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    profiles: Option<SidesRecord<ProfileRecord>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    atd: Option<AtdRecord>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    fvvdp: Option<FvvdpRecord>,
}

#[derive(Serialize, Deserialize)]
struct BandRecord {
    pixels: u64,
    squared_error: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ssim_map_pixels: Option<u64>,
    #[serde(flatten)]
    scores: BTreeMap<String, Option<Number>>,
}

impl FrameRecord {
    pub(super) fn of(finished: &Finished<'_>, result: &FrameResult) -> Self {
        let scores = &result.scores;
        let key = |metric: &Metric| metric.key().to_owned();
        let bands = scores.bands.iter().map(|band| BandRecord {
            pixels: band.pixels,
            squared_error: maybe(band.mse),
            ssim_map_pixels: band.ssim_map_pixels,
            scores: band.scores.iter().map(|(m, value)| (key(m), maybe(*value))).collect(),
        });
        Self {
            scene: finished.named.scene.to_owned(),
            method: finished.named.method.to_owned(),
            eye: finished.named.eye,
            step: finished.step,
            frame: result.frame,
            reference: result.reference.clone(),
            test: result.test.clone(),
            gaze_px: result.gaze_px,
            gaze_step_deg: maybe(result.gaze_step_deg),
            scores: scores.scores.iter().map(|(m, value)| (key(m), Number(*value))).collect(),
            bands: bands.collect(),
            pixels: scores.pixels,
            pixels_outside_bands: scores.outside_bands,
            pixels_left_out: scores.left_out,
            squared_error: maybe(scores.mse),
            weighted_squared_error: scores
                .weighted_squared_error
                .map(|(a, b)| (Number(a), Number(b))),
            profiles: result.profiles.as_ref().map(|p| SidesRecord::of(p, |side| side.into())),
            atd: result.atd.as_ref().map(|atd| AtdRecord::of(atd, finished.guides)),
            fvvdp: result.fvvdp.as_ref().map(FvvdpRecord::from),
        }
    }

    /// The result, and what its differences over time were taken along; `None` where it names a metric
    /// that there is not.
    pub(super) fn read(self) -> Option<(FrameResult, AtdGuides)> {
        let metric = |(key, value): (String, Number)| Some((Metric::find(&key)?, value.0));
        let in_band =
            |(key, value): (String, Option<Number>)| Some((Metric::find(&key)?, read(value)));
        let bands = self.bands.into_iter().map(|band| {
            let scores = band.scores.into_iter().map(in_band).collect::<Option<_>>()?;
            let (pixels, ssim_map_pixels) = (band.pixels, band.ssim_map_pixels);
            Some(BandScores { pixels, mse: read(band.squared_error), ssim_map_pixels, scores })
        });
        let (atd, guides) = self.atd.map(AtdRecord::read).unzip();
        let result = FrameResult {
            frame: self.frame,
            reference: self.reference,
            test: self.test,
            gaze_px: self.gaze_px,
            gaze_step_deg: read(self.gaze_step_deg),
            scores: PairScores {
                scores: self.scores.into_iter().map(metric).collect::<Option<_>>()?,
                bands: bands.collect::<Option<_>>()?,
                pixels: self.pixels,
                outside_bands: self.pixels_outside_bands,
                left_out: self.pixels_left_out,
                mse: read(self.squared_error),
                weighted_squared_error: self.weighted_squared_error.map(|(a, b)| (a.0, b.0)),
            },
            profiles: self.profiles.map(|profiles| profiles.read(Profile::from)),
            atd,
            fvvdp: self.fvvdp.map(Into::into),
        };
        Some((result, guides.unwrap_or_default()))
    }
}

/// Something that could not be scored: a pair; a comparison, without a frame; or a view, without a
/// method either.
#[derive(Serialize, Deserialize)]
pub(super) struct ErrorRecord {
    pub(super) scene: String,
    pub(super) method: Option<String>,
    pub(super) eye: Option<Eye>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<usize>,
    /// Whether it was looked at for the sake of pairs after it alone.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) before: bool,
    pub(super) frame: Option<i64>,
    pub(super) reference: String,
    pub(super) test: String,
    pub(super) error: String,
    pub(super) help: String,
}

impl ErrorRecord {
    pub(super) fn of(named: Named<'_>, failure: &Failure) -> Self {
        let Failure { frame, reference, test, message, help } = failure.clone();
        Self {
            scene: named.scene.to_owned(),
            method: Some(named.method.to_owned()),
            eye: named.eye,
            step: None,
            before: false,
            frame,
            reference,
            test,
            error: message,
            help,
        }
    }

    pub(super) fn read(self) -> Failure {
        let Self { frame, reference, test, error: message, help, .. } = self;
        Failure { frame, reference, test, message, help }
    }
}

/// What holds for a view.
#[derive(Serialize, Deserialize)]
pub(super) struct SettledRecord {
    pub(super) scene: String,
    pub(super) eye: Option<Eye>,
    view: Option<ViewRecord>,
    metrics: Vec<String>,
    gaze_held: Option<usize>,
    /// By the names of methods.
    fvvdp: BTreeMap<String, FvvdpSight>,
    missing: BTreeMap<String, String>,
}

#[derive(Serialize, Deserialize)]
struct ViewRecord {
    size: [usize; 2],
    focal_px: [f64; 2],
    gaze_px: [f64; 2],
    eccentricity: String,
    bands_deg: Vec<(f64, f64)>,
}

impl SettledRecord {
    pub(super) fn of(scene: &str, eye: Option<Eye>, settled: &Settled, methods: &[String]) -> Self {
        let view = settled.view.clone().map(|view| ViewRecord {
            size: view.size,
            focal_px: view.focal_px,
            gaze_px: view.gaze_px,
            eccentricity: view.eccentricity.to_owned(),
            bands_deg: view.bands_deg,
        });
        let name = |method: &usize| methods[*method].clone();
        let (fvvdp, missing) = (settled.fvvdp.iter(), settled.missing.iter());
        Self {
            scene: scene.to_owned(),
            eye,
            view,
            metrics: settled.metrics.iter().map(|metric| metric.key().to_owned()).collect(),
            gaze_held: settled.gaze_held,
            fvvdp: fvvdp.map(|(method, sight)| (name(method), sight.clone())).collect(),
            missing: missing.map(|(method, why)| (name(method), why.clone())).collect(),
        }
    }

    /// `None` where it names a metric or a method that there is not.
    pub(super) fn read(self, method: impl Fn(&str) -> Option<usize>) -> Option<Settled> {
        let view = self.view.map(|view| {
            let eccentricity =
                ["angular", "planar"].into_iter().find(|kind| *kind == view.eccentricity)?;
            let ViewRecord { size, focal_px, gaze_px, bands_deg, .. } = view;
            Some(ViewResult { size, focal_px, gaze_px, eccentricity, bands_deg })
        });
        let view = match view {
            Some(view) => Some(view?),
            None => None,
        };
        let metrics = self.metrics.iter().map(|key| Metric::find(key));
        let fvvdp = self.fvvdp.into_iter();
        let fvvdp = fvvdp.map(|(name, sight)| Some((method(&name)?, sight)));
        let missing = self.missing.into_iter();
        let missing = missing.map(|(name, why)| Some((method(&name)?, why)));
        Some(Settled {
            view,
            metrics: metrics.collect::<Option<_>>()?,
            gaze_held: self.gaze_held,
            fvvdp: fvvdp.collect::<Option<_>>()?,
            missing: missing.collect::<Option<_>>()?,
        })
    }
}
