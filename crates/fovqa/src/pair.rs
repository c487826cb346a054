//! A pair of pictures in memory, scored.

use std::path::PathBuf;
use std::sync::Arc;

use fovqa_engine::{Entry, Finished, Given};
use fovqa_metrics::{Key, Map, Metric, ParamSet};
use fovqa_plan::{EyeView, MetricChoice, Plan, Scene, Settings, SourceSpec};
use fovqa_results::{FrameResult, ScoreReport};
use ndarray::{Array2, ArrayView3};

use crate::error::{Complaint, Error};
use crate::events::Kept;
use crate::memory::InMemory;
use crate::samples::{Sample, frame};
use crate::score::comparison;

/// How a pair is scored.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScoreOptions {
    /// How the pictures are seen and what becomes of their values: view, gaze, bands, signal, crop, mask.
    pub settings: Settings,
    /// Which metrics; by default [`Metric::DEFAULT`], less what does not fit.
    pub metrics: MetricChoice,
    /// Their parameters.
    pub params: ParamSet,
    /// Whether maps are made of the metrics that have one.
    pub maps: bool,
}

/// What was measured of a pair.
#[derive(Debug, Clone)]
pub struct PairScores {
    /// Every value, as the command writes it ([`write_json`](crate::write_json),
    /// [`write_csv`](crate::write_csv)).
    pub report: ScoreReport,
    /// The maps, where they were asked for.
    pub maps: Vec<ScoreMap>,
    /// What the user should know: a sentence each.
    pub warnings: Vec<String>,
}

/// A value for each pixel, or for each block of pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreMap {
    /// What it is of: `ssim`, `squared_error`.
    pub name: &'static str,
    /// Height x width.
    pub values: Array2<f32>,
}

impl PairScores {
    /// A metric's own value; `None` where it has none, or was not asked for.
    pub fn value(&self, metric: Metric) -> Option<f64> {
        let frame: &FrameResult = self.report.frames.first()?;
        frame.rows.get(Key::of(metric))?.value
    }
}

/// Scores a test picture against a reference: arrays of height x width x channel, with one channel (gray) or
/// three (RGB), of `u8`, `u16` or `f32`. The values are those of `fovqa score` to the last bit.
///
/// # Errors
/// When an array is no picture, the two have different sizes, or what was asked for cannot be.
#[allow(clippy::needless_pass_by_value, reason = "a view is a borrow already")]
pub fn score<R: Sample, T: Sample>(
    reference: ArrayView3<'_, R>,
    test: ArrayView3<'_, T>,
    options: &ScoreOptions,
) -> Result<PairScores, Error> {
    const NAMES: [&str; 2] = ["reference", "test"];
    let [first, second] = NAMES;
    let frames = [frame(first, reference)?, frame(second, test)?];
    let given: Given = NAMES
        .into_iter()
        .zip(frames)
        .map(|(name, frame)| (name.to_owned(), Arc::new(InMemory::new(name, frame)) as _))
        .collect();
    let given_as = |name: &str| SourceSpec::Given(name.to_owned());
    let eye = EyeView {
        reference: given_as(first),
        tests: vec![(0, given_as(second))],
        settings: options.settings.clone(),
        ..EyeView::default()
    };
    let plan = Plan {
        base: PathBuf::new(),
        scenes: vec![Scene { eyes: vec![eye], ..Scene::default() }],
        methods: vec![String::new()],
        metrics: options.metrics.clone(),
        params: options.params.clone(),
        maps: options.maps,
        ..Plan::default()
    };
    let kept = Kept::default();
    let mut maps = Vec::new();
    let report = comparison(&plan, &given, &kept, &mut |entry| {
        if let Entry::Pair(Finished { maps: found, .. }) = entry {
            maps.extend(found.iter().map(array));
        }
        Ok(())
    })?;
    if let Some(failure) = report.failures.first() {
        let (message, help) = (failure.message.clone(), failure.help.clone());
        return Err(Error::Input(vec![Complaint { message, help }]));
    }
    Ok(PairScores { report, maps, warnings: kept.0.into_inner() })
}

fn array(map: &Map) -> ScoreMap {
    let values = Array2::from_shape_vec((map.height, map.width), map.values.clone());
    let values = values.unwrap_or_else(|_| unreachable!("a map has one value a pixel"));
    ScoreMap { name: map.name, values }
}
