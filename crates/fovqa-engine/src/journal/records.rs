//! The lines of a journal after the first, one type per kind of line.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_metrics::{FrameRows, Image, Key, Layout, Layouts, Metric, MetricKind, Parts, Subject};
use fovqa_plan::Eye;
use fovqa_results::{Doubt, Failure, FrameResult, FvvdpViewing, GuideSources, ViewResult};
use fovqa_vision::EccentricityKind;
use serde::{Deserialize, Serialize};

use super::number::{Number, Token, maybe, read};
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
    /// Number of the line of keys that describes the values.
    keys: usize,
    values: Vec<Token>,
    /// Which motion and depth temporal metrics used, if there are any.
    #[serde(default, alias = "atd", skip_serializing_if = "Option::is_none")]
    guides: Option<GuideSources>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    doubts: Vec<Doubt>,
}

/// The keys that describe the values of the frames after this line.
#[derive(Serialize, Deserialize)]
pub(super) struct KeysRecord {
    pub(super) number: usize,
    layout: Vec<KeyRecord>,
}

/// A key as a list: metric or measure, statistic, image, level, band, and the number of its parts.
#[derive(Serialize, Deserialize)]
struct KeyRecord(String, String, String, Option<i16>, Option<u16>, usize);

impl KeysRecord {
    pub(super) fn of(number: usize, layout: &Layout) -> Self {
        let record = |(key, parts): (Key, usize)| {
            let [subject, statistic, image] =
                [key.subject.name(), key.statistic().name, key.image.name()].map(str::to_owned);
            KeyRecord(subject, statistic, image, key.level, key.band, parts)
        };
        Self { number, layout: layout.keys().map(record).collect() }
    }

    /// The layout of these keys; `None` if a name is unknown, or a level is one that no key has.
    pub(super) fn read(self) -> Option<Layout> {
        let key = |KeyRecord(subject, statistic, image, level, band, parts): KeyRecord| {
            let mut key = Key::named(Subject::find(&subject)?, &statistic)?;
            if level.is_some_and(|level| !Key::LEVELS.contains(&level)) {
                return None;
            }
            (key.level, key.band, key.image) = (level, band, Image::find(&image)?);
            Some((key, parts))
        };
        Layout::new(self.layout.into_iter().map(key).collect::<Option<Vec<_>>>()?)
    }
}

/// The values of a frame, each followed by its parts. A value that is the mean of its parts, as
/// most are, is only marked as such.
fn tokens(rows: &FrameRows) -> Vec<Token> {
    let mut tokens = Vec::new();
    for row in rows.iter() {
        let mut numbers = row.numbers();
        let value = numbers.next().flatten();
        tokens.push(match (value, row.parts) {
            (None, _) => Token::Nothing,
            (Some(value), Parts::Mean { sum, weight }) if same(value, sum / weight) => Token::Mean,
            (Some(value), _) => Token::Number(value),
        });
        tokens.extend(numbers.flatten().map(Token::Number));
    }
    tokens
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}

/// Turns the items back into values and parts.
fn numbers(tokens: &[Token]) -> Option<Vec<Option<f64>>> {
    let number = |token: Option<&Token>| match token {
        Some(Token::Number(number)) => Some(*number),
        _ => None,
    };
    let read = |(index, token): (usize, &Token)| match token {
        Token::Nothing => Some(None),
        Token::Number(number) => Some(Some(*number)),
        Token::Mean => {
            let [sum, weight] = [1, 2].map(|behind| number(tokens.get(index + behind)));
            Some(Some(sum? / weight?))
        }
    };
    tokens.iter().enumerate().map(read).collect()
}

impl FrameRecord {
    pub(super) fn of(finished: &Finished<'_>, result: &FrameResult, keys: usize) -> Self {
        Self {
            scene: finished.named.scene.to_owned(),
            method: finished.named.method.to_owned(),
            eye: finished.named.eye,
            step: finished.step,
            frame: result.frame,
            reference: result.reference.to_string(),
            test: result.test.to_string(),
            gaze_px: result.gaze_px,
            gaze_step_deg: maybe(result.gaze_step_deg),
            keys,
            values: tokens(&result.rows),
            guides: result.rows.has_kind(MetricKind::Temporal).then_some(finished.guides),
            doubts: result.doubts.clone(),
        }
    }

    /// The result, and which motion and depth its temporal differences used; `None` if the name of
    /// a metric is unknown. `values` keeps the values, and `name` the names of files.
    pub(super) fn read(
        self,
        layouts: &BTreeMap<usize, Layout>,
        values: &mut Layouts,
        name: impl Fn(String) -> Arc<str>,
    ) -> Option<(FrameResult, GuideSources)> {
        let result = FrameResult {
            frame: self.frame,
            reference: name(self.reference),
            test: name(self.test),
            gaze_px: self.gaze_px,
            gaze_step_deg: read(self.gaze_step_deg),
            doubts: self.doubts,
            rows: values.read(layouts.get(&self.keys)?, &numbers(&self.values)?)?,
        };
        Some((result, self.guides.unwrap_or_default()))
    }
}

/// Something that could not be scored: a pair, a comparison (without a frame), or a view (without a
/// frame and a method).
#[derive(Serialize, Deserialize)]
pub(super) struct ErrorRecord {
    pub(super) scene: String,
    pub(super) method: Option<String>,
    pub(super) eye: Option<Eye>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<usize>,
    /// Whether the pair was read only because later pairs need it.
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

/// What holds for a whole view.
#[derive(Serialize, Deserialize)]
pub(super) struct SettledRecord {
    pub(super) scene: String,
    pub(super) eye: Option<Eye>,
    view: Option<ViewRecord>,
    metrics: Vec<String>,
    gaze_held: Option<usize>,
    /// The viewing conditions of FovVideoVDP, by the name of the method.
    fvvdp: BTreeMap<String, FvvdpViewing>,
    missing: BTreeMap<String, String>,
    /// Number of pairs without a line, because a source ended before them.
    #[serde(default, skip_serializing_if = "is_zero")]
    passed_over: usize,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

#[derive(Serialize, Deserialize)]
struct ViewRecord {
    size: [usize; 2],
    focal_px: [f64; 2],
    gaze_px: [f64; 2],
    eccentricity: EccentricityKind,
    bands_deg: Vec<(f64, f64)>,
}

impl SettledRecord {
    pub(super) fn of(scene: &str, eye: Option<Eye>, settled: &Settled, methods: &[String]) -> Self {
        let view = settled.view.clone().map(|view| ViewRecord {
            size: view.size,
            focal_px: view.focal_px,
            gaze_px: view.gaze_px,
            eccentricity: view.eccentricity,
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
            passed_over: settled.passed_over,
        }
    }

    /// Reads the line; `None` if the name of a metric or a method is unknown.
    pub(super) fn read(self, method: impl Fn(&str) -> Option<usize>) -> Option<Settled> {
        let view = self.view.map(|view| {
            let ViewRecord { size, focal_px, gaze_px, eccentricity, bands_deg } = view;
            ViewResult { size, focal_px, gaze_px, eccentricity, bands_deg }
        });
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
            passed_over: self.passed_over,
        })
    }
}
