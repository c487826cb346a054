//! The values of all frames of a sequence.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_metrics::{Image, MetricKind};
use fovqa_params::Words;
use fovqa_results::ViewImages;

use super::data::SequenceData;
use super::number::{Number, hundredths};
use crate::figures::Source;

/// The longest sequence whose values the page has: with more, it would be too large for a browser.
const MOST_FRAMES: usize = 100_000;

/// The values of a view's frames; `None` for a single frame, and for very many.
pub(super) fn sequence(source: &Source<'_>, view: &ViewImages) -> Option<SequenceData> {
    let eye = view.eye.map(Words::word).unwrap_or_default();
    let mut metrics = Vec::new();
    for metric in source.run.resolved.metrics_in_order() {
        // A measure of each image is shown of the test.
        let image = if metric.is(MetricKind::Fidelity) { Image::Pair } else { Image::Test };
        let of = |method: &String| {
            source.values.of_eye((&view.scene, method, eye), (metric, image)).to_vec()
        };
        let values: Vec<_> = view.methods.iter().map(of).collect();
        if values.iter().any(|values| !values.is_empty()) {
            metrics.push((metric.key(), values));
        }
    }
    let numbers = metrics.iter().flat_map(|(_, methods)| methods.iter().flatten());
    let frames: BTreeSet<i64> = numbers.map(|(frame, _)| *frame).collect();
    if frames.len() < 2 || frames.len() > MOST_FRAMES {
        return None;
    }
    let frames: Vec<i64> = frames.into_iter().collect();
    let along = |values: Vec<(i64, f64)>| {
        let values: BTreeMap<i64, f64> = values.into_iter().collect();
        frames.iter().map(|frame| Number(values.get(frame).copied())).collect()
    };
    let metrics =
        metrics.into_iter().map(|(key, methods)| (key, methods.into_iter().map(along).collect()));
    let gaze: BTreeMap<i64, [f64; 2]> = view.gaze.iter().copied().collect();
    let at = |frame: &i64| gaze.get(frame).map(|gaze| gaze.map(hundredths));
    let gaze_px = (!gaze.is_empty()).then(|| frames.iter().map(at).collect());
    Some(SequenceData { metrics: metrics.collect(), loss: view.ranked_by.clone(), gaze_px, frames })
}
