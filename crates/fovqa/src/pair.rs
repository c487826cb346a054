//! Scores a pair of images in memory.

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
    /// How the images are viewed and how their values are interpreted: view, gaze, bands, signal,
    /// crop and mask.
    pub settings: Settings,
    /// The metrics; by default [`Metric::DEFAULT`], without those that do not fit.
    pub metrics: MetricChoice,
    /// Parameters of the metrics.
    pub params: ParamSet,
    /// Whether to make maps for the metrics that have one.
    pub maps: bool,
}

/// The scores of a pair.
#[derive(Debug, Clone)]
pub struct PairScores {
    /// All values, in the form that the command writes ([`write_json`](crate::write_json),
    /// [`write_csv`](crate::write_csv)).
    pub report: ScoreReport,
    /// The maps, if they were requested.
    pub maps: Vec<ScoreMap>,
    /// Warnings for the user. Each is one sentence.
    pub warnings: Vec<String>,
}

/// A value for each pixel, or for each block of pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreMap {
    /// Name of the map, such as `ssim` or `squared_error`.
    pub name: &'static str,
    /// Values with the shape height x width.
    pub values: Array2<f32>,
}

impl PairScores {
    /// A metric's own value; `None` if it has none or was not requested.
    pub fn value(&self, metric: Metric) -> Option<f64> {
        let frame: &FrameResult = self.report.frames.first()?;
        frame.rows.get(Key::of(metric))?.value
    }
}

/// Scores a test image against a reference. Both are arrays of height x width x channel with one
/// channel (gray) or three (RGB), of type `u8`, `u16`, `f16` or `f32`. The values are exactly those of
/// `fovqa score`.
///
/// # Errors
/// If an array is not an image, the two have different sizes, or the request is not possible.
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
    let (width, height) = map.info.size(map.frame_size);
    let values = Array2::from_shape_vec((height, width), map.values.clone());
    let values = values.unwrap_or_else(|_| unreachable!("a map has one value a pixel"));
    ScoreMap { name: map.info.name, values }
}
