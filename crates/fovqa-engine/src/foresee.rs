//! Predicts the warnings of a run from its settings, frame numbers and the headers of its files.

use fovqa_metrics::Metric;
use fovqa_plan::Plan;
use fovqa_results::Failure;
use fovqa_vision::BandEdges;

use crate::error::EngineError;
use crate::events::{Events, Warnings};
use crate::found::{FoundInputs, FoundView};
use crate::plausibility::Checks;
use crate::regions::warn_of_regions;
use crate::scoring::{Scoring, scene_bands};
use crate::setup::{Inputs, Setup};
use crate::view::warn_of_gaze;

/// Reports the warnings of [`crate::run`] that can be known without reading a pixel. Returns the
/// metrics that the run will score in any of the views.
///
/// # Errors
/// If the plan itself is not possible ([`crate::check`]).
pub fn foresee(
    plan: &Plan,
    found: &FoundInputs,
    events: &dyn Events,
) -> Result<Vec<Metric>, EngineError> {
    let mut warnings = Warnings::new(events);
    let mut metrics = Vec::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let bands = scene_bands(scene, found, view.scene);
        let (bands, range) = (bands.as_ref(), 0..view.pairs());
        let scoring = Scoring { plan, scene, view, bands, dominant: None, range };
        let wanted = scoring.begin(&mut warnings)?;
        match scoring.fits(&wanted) {
            Ok(much) => warnings.note_of_view(much.as_deref()),
            Err(error) => warnings.once_a_view("memory", &format!("{error}; {}", error.help())),
        }
        Checks::new(plan, view).foresee(&mut warnings);
        metrics.extend(settle(plan, view, bands, wanted, &mut warnings));
    }
    warn_of_regions(plan, found, events);
    metrics.sort_unstable();
    metrics.dedup();
    Ok(metrics)
}

/// Reads some frames of each view, without scoring them: reports the warnings that they would bring, and
/// returns those that could not be scored, with the name of their scene.
///
/// # Errors
/// If the plan itself is not possible ([`crate::check`]).
pub fn preview(
    plan: &Plan,
    found: &FoundInputs,
    events: &dyn Events,
) -> Result<Vec<(String, Failure)>, EngineError> {
    let mut warnings = Warnings::new(events);
    let mut failures = Vec::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let bands = scene_bands(scene, found, view.scene);
        let (bands, range) = (bands.as_ref(), 0..view.pairs());
        let scoring = Scoring { plan, scene, view, bands, dominant: None, range };
        let of_view = scoring.preview(&mut warnings)?;
        failures.extend(of_view.into_iter().map(|failure| (scene.name.clone(), failure)));
    }
    Ok(failures)
}

/// Prepares a view as its first frame will, and returns the metrics that fit.
fn settle(
    plan: &Plan,
    view: &FoundView,
    scene_bands: Option<&BandEdges>,
    metrics: Vec<Metric>,
    warnings: &mut Warnings<'_>,
) -> Vec<Metric> {
    let settings = &plan.scenes[view.scene].eyes[view.eye].settings;
    // A file that cannot be read now becomes an error of its frame during the run.
    let reference = &view.sources.reference;
    let first = view.frames.iter().find_map(|f| Some((f, reference.size(f.reference).ok()?)));
    let Some((first, file_size)) = first else { return metrics };
    let size = settings.crop.map_or(file_size, |crop| (crop.width, crop.height));
    let inputs = Inputs {
        plan,
        settings,
        scene_bands,
        metrics: &metrics,
        mask: None,
        trace: view.trace.as_deref(),
        pairs: &view.frames.iter().map(|frame| frame.tests.len()).collect::<Vec<_>>(),
        file_size,
    };
    let name = reference.listing().name(first.reference).to_owned();
    let Ok(setup) = Setup::new(&inputs, size, name, warnings) else {
        return metrics;
    };
    if let Some(seen) = &setup.view {
        let fixed = [seen.gaze_px];
        let gazes = view.trace.as_ref().map(|trace| trace.iter().map(|gaze| gaze.px).collect());
        for gaze in gazes.unwrap_or_else(|| Vec::from(fixed)) {
            warn_of_gaze(gaze, size, warnings);
        }
    }
    setup.metrics
}
