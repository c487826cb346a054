//! The verdict as JSON, schema `fovqa.gate/1`. New keys may be added, but keys are never renamed.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use super::loss::{Compared, Loss, LossPicture, Place};
use super::verdict::{Check, FrameCheck, RuleVerdict, Verdict};
use crate::json::Number;

/// Name and version of the format.
pub const GATE_SCHEMA: &str = "fovqa.gate/1";

/// The verdict as it is written and read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VerdictRecord {
    /// Name and version of the format.
    pub schema: String,
    /// Version of fovqa.
    pub version: String,
    /// Name of the experiment.
    pub experiment: String,
    /// `passed`, `failed`, `not scored` or `wrong`.
    pub state: String,
    /// The baseline that the run was compared with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub baseline: Option<String>,
    /// The rules.
    pub rules: Vec<RuleRecord>,
    /// The items that could not be scored.
    pub errors: Vec<String>,
    /// Additional remarks.
    pub notes: Vec<String>,
}

/// A rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RuleRecord {
    /// Its title.
    pub title: String,
    /// Its line in the experiment file.
    pub line: usize,
    /// The value that it checks.
    pub quantity: String,
    /// Its limits in words.
    pub limits: String,
    /// Its state.
    pub state: String,
    /// Why there is nothing to check.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Its check of each comparison.
    pub checks: Vec<CheckRecord>,
}

/// The check of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CheckRecord {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub eye: String,
    /// Its state.
    pub state: String,
    /// Why it did not pass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The value.
    pub value: Option<Number>,
    /// The value of the baseline.
    pub baseline: Option<Number>,
    /// The limit.
    pub limit: Option<Number>,
    /// Distance from the limit; below 0 if it is violated.
    pub margin: Option<Number>,
    /// The worst frame.
    pub worst_frame: Option<i64>,
    /// Its value.
    pub worst_value: Option<Number>,
    /// The band in degrees that a test of repeated runs is of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub band_deg: Option<[f64; 2]>,
    /// The p-value of a test of repeated runs, adjusted for all tests of the rule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p: Option<f64>,
    /// The frames that violate a rule per frame, the worst first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<FrameCheckRecord>,
    /// The frames with the largest loss and where it is, the worst first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub losses: Vec<LossRecord>,
}

/// The check of a frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrameCheckRecord {
    /// Its number.
    pub frame: i64,
    /// The value.
    pub value: Number,
    /// The value of the baseline.
    pub baseline: Option<Number>,
    /// The limit.
    pub limit: Number,
    /// Distance from the limit.
    pub margin: Number,
}

/// A frame with a loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LossRecord {
    /// The eye.
    pub eye: String,
    /// The number of the frame.
    pub frame: i64,
    /// The metric that named the frame.
    pub metric: String,
    /// Its statistic; empty for the metric's own value.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub statistic: String,
    /// Its value in this frame.
    pub value: Number,
    /// What the frame is compared with: `baseline`, `neighbours` or `nothing`.
    pub compared: String,
    /// The value that it is compared with.
    pub before: Option<Number>,
    /// The band with the largest loss.
    pub band: Option<BandRecord>,
    /// The place with the largest loss.
    pub place: Option<PlaceRecord>,
    /// Pictures of it.
    pub pictures: Vec<PictureRecord>,
}

/// A band with a loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BandRecord {
    /// Its lower edge in degrees.
    pub from_deg: f64,
    /// Its upper edge in degrees.
    pub to_deg: f64,
    /// The metric.
    pub metric: String,
    /// The value in the band.
    pub value: Number,
    /// What it is compared with: `baseline`, `neighbours` or `nothing`.
    pub compared: String,
    /// The value that it is compared with.
    pub before: Option<Number>,
}

/// A place with a loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaceRecord {
    /// Column in pixels.
    pub x_px: f64,
    /// Row in pixels.
    pub y_px: f64,
    /// Eccentricity in degrees.
    pub eccentricity_deg: Option<f64>,
    /// The map in which it was found.
    pub map: String,
    /// What the map is compared with: `baseline`, `neighbours` or `nothing`.
    pub compared: String,
}

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PictureRecord {
    /// What it shows.
    pub what: String,
    /// Its file, relative to the results folder.
    pub path: String,
}

impl From<&FrameCheck> for FrameCheckRecord {
    fn from(check: &FrameCheck) -> Self {
        Self {
            frame: check.frame,
            value: Number(check.value),
            baseline: check.baseline.map(Number),
            limit: Number(check.limit.value),
            margin: Number(check.limit.margin),
        }
    }
}

impl From<&Loss> for LossRecord {
    fn from(loss: &Loss) -> Self {
        let band = loss.band.as_ref().map(|band| BandRecord {
            from_deg: band.band_deg[0],
            to_deg: band.band_deg[1],
            metric: band.metric.clone(),
            value: Number(band.value),
            compared: band.compared.name().to_owned(),
            before: band.before.map(Number),
        });
        let place = loss.place.as_ref().map(|place| PlaceRecord {
            x_px: place.px[0],
            y_px: place.px[1],
            eccentricity_deg: place.eccentricity_deg,
            map: place.map.clone(),
            compared: place.compared.name().to_owned(),
        });
        let pictures = loss.pictures.iter().map(|picture| PictureRecord {
            what: picture.what.clone(),
            path: picture.path.clone(),
        });
        Self {
            eye: loss.eye.clone(),
            frame: loss.frame,
            metric: loss.metric.clone(),
            statistic: loss.statistic.clone(),
            value: Number(loss.value),
            compared: loss.compared.name().to_owned(),
            before: loss.before.map(Number),
            band,
            place,
            pictures: pictures.collect(),
        }
    }
}

impl Loss {
    /// Takes place and pictures from an earlier record of the same loss. Whether there were any.
    pub fn restore(&mut self, was: &LossRecord) -> bool {
        let place = was.place.as_ref().and_then(|place| {
            let all = [Compared::Baseline, Compared::Neighbours, Compared::Nothing];
            let compared = all.into_iter().find(|compared| compared.name() == place.compared)?;
            Some(Place {
                px: [place.x_px, place.y_px],
                eccentricity_deg: place.eccentricity_deg,
                map: place.map.clone(),
                compared,
            })
        });
        let pictures = was
            .pictures
            .iter()
            .map(|picture| LossPicture { what: picture.what.clone(), path: picture.path.clone() });
        self.place = place;
        self.pictures = pictures.collect();
        self.place.is_some() || !self.pictures.is_empty()
    }
}

impl From<&Check> for CheckRecord {
    fn from(check: &Check) -> Self {
        Self {
            scene: check.place.0.clone(),
            method: check.place.1.clone(),
            eye: check.place.2.clone(),
            state: check.outcome.state().name().to_owned(),
            reason: check.outcome.reason().map(str::to_owned),
            value: check.value.map(Number),
            baseline: check.baseline.map(Number),
            limit: check.limit.map(|limit| Number(limit.value)),
            margin: check.limit.map(|limit| Number(limit.margin)),
            worst_frame: check.worst.map(|worst| worst.0),
            worst_value: check.worst.map(|worst| Number(worst.1)),
            band_deg: check.band,
            p: check.p,
            frames: check.frames.iter().map(FrameCheckRecord::from).collect(),
            losses: check.losses.iter().map(LossRecord::from).collect(),
        }
    }
}

impl From<&RuleVerdict> for RuleRecord {
    fn from(verdict: &RuleVerdict) -> Self {
        Self {
            title: verdict.title(),
            line: verdict.rule.line,
            quantity: verdict.rule.quantity.to_string(),
            limits: verdict.rule.limits(),
            state: verdict.state().name().to_owned(),
            reason: verdict.failure.clone(),
            checks: verdict.checks.iter().map(CheckRecord::from).collect(),
        }
    }
}

impl From<&Verdict> for VerdictRecord {
    fn from(verdict: &Verdict) -> Self {
        Self {
            schema: GATE_SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            experiment: verdict.experiment.clone(),
            state: verdict.state().name().to_owned(),
            baseline: verdict.baseline.clone(),
            rules: verdict.rules.iter().map(RuleRecord::from).collect(),
            errors: verdict.errors.clone(),
            notes: verdict.notes.clone(),
        }
    }
}

/// Writes a verdict as indented JSON with a newline at its end.
///
/// # Errors
/// If the writer refuses.
pub fn write_verdict_json(verdict: &Verdict, mut out: impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut out, &VerdictRecord::from(verdict))?;
    writeln!(out)
}
