//! Finds what is wrong with figures before anything is scored: sizes that they cannot have, and
//! settings without effect.

use fovqa_engine::{Events, FoundInputs};
use fovqa_methods::curves::trace_all;
use fovqa_metrics::Metric;
use fovqa_params::Words;
use fovqa_plan::{
    CurvesFile, Experiment, FigureForm, FigureSettings, Plot, PlotKind, without_effect_on_all,
};
use fovqa_report::{ExpectedScore, ReportError, impossible_curves, impossible_figures};

use crate::error::{Complaint, Error};
use crate::events::Silent;

/// The help for figures that cannot have their size.
pub(crate) const CHANGE: &str = "change its `figure`, or [figures]";

/// Scenes up to this number have room in a figure of bars of any size.
const FEW_SCENES: usize = 20;

/// Checks the figures of an experiment before anything is scored. Warns of settings in `[figures]`
/// that no figure has. `metrics` are those that will be scored.
///
/// # Errors
/// If figures cannot have the size that the experiment asks for.
pub fn foresee_figures(
    experiment: &Experiment,
    found: &FoundInputs,
    metrics: &[Metric],
    events: &dyn Events,
) -> Result<(), Error> {
    let plots = experiment.plots.iter();
    let kinds = plots.map(|plot| (plot.kind.word(), FigureForm::of(plot.kind)));
    warn(&experiment.figures, kinds, events);
    if !has_sizes(experiment) {
        return Ok(());
    }
    let plan = &experiment.plan;
    let mut scores: Vec<ExpectedScore> = Vec::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let eye = &scene.eyes[view.eye];
        for (method, _) in &eye.tests {
            let has =
                |frame: &&fovqa_engine::FoundFrame| frame.tests.iter().any(|t| t.0 == *method);
            let score = ExpectedScore {
                scene: scene.name.clone(),
                method: plan.methods[*method].clone(),
                frames: view.frames.iter().filter(has).count(),
                has_bands: eye.settings.view.is_some(),
            };
            // Both eyes have one value.
            let is_same = |other: &ExpectedScore| {
                (&other.scene, &other.method) == (&score.scene, &score.method)
            };
            if eye.eye.is_none() || !scores.iter().any(is_same) {
                scores.push(score);
            }
        }
    }
    let levels = plan.params.haar.levels as usize;
    let errors = impossible_figures(&experiment.resolved(), &scores, metrics, levels);
    refuse(errors)
}

/// The same as [`foresee_figures`], with the metrics that a run will score.
pub(crate) fn foresee_figures_of_run(
    experiment: &Experiment,
    found: &FoundInputs,
    events: &dyn Events,
) -> Result<(), Error> {
    let metrics = if has_sizes(experiment) {
        fovqa_engine::foresee(&experiment.plan, found, &Silent)?
    } else {
        Vec::new()
    };
    foresee_figures(experiment, found, &metrics, events)
}

/// Checks the figures of a curves file. Warns of settings in `[figures]` that no figure has.
///
/// # Errors
/// If a curve is not possible, or a figure cannot have the size that the file asks for.
pub fn check_curves(file: &CurvesFile, events: &dyn Events) -> Result<(), Error> {
    warn_of_curves(file, events);
    if !file.plan.plots.iter().any(|plot| is_sized(&plot.figure)) {
        return Ok(());
    }
    let failed =
        |error: &dyn std::fmt::Display| Error::usage(format!("{}: {error}", file.name), "");
    let curves = trace_all(&file.plan.curves, file.plan.range, &file.plan.acuity)
        .map_err(|error| failed(&error))?;
    let error = impossible_curves(file, &curves).map_err(|error| failed(&error))?;
    refuse(error.into_iter().collect())
}

/// Warns of settings in `[figures]` of a curves file that no figure has.
pub(crate) fn warn_of_curves(file: &CurvesFile, events: &dyn Events) {
    let plots = file.plan.plots.iter();
    let kinds = plots.map(|plot| (plot.kind.word(), Some(FigureForm::of_curves(plot.kind))));
    warn(&file.plan.figures, kinds, events);
}

fn refuse(errors: Vec<ReportError>) -> Result<(), Error> {
    if errors.is_empty() {
        return Ok(());
    }
    let complaint =
        |error: ReportError| Complaint { message: error.to_string(), help: CHANGE.to_owned() };
    Err(Error::Usage(errors.into_iter().map(complaint).collect()))
}

/// Whether the size of any figure may be impossible.
fn has_sizes(experiment: &Experiment) -> bool {
    let is_of = |plot: &Plot| plot.kind == PlotKind::Crops || is_sized(&plot.figure);
    is_sized(&experiment.figures)
        || experiment.plots.iter().any(is_of)
        || experiment.plan.scenes.len() > FEW_SCENES
}

fn is_sized(settings: &FigureSettings) -> bool {
    settings.width_in.or(settings.height_in).or(settings.aspect).is_some()
}

/// Warns of settings that none of the figures has, with the kinds of the figures.
fn warn(
    settings: &FigureSettings,
    kinds: impl Iterator<Item = (&'static str, Option<FigureForm>)>,
    events: &dyn Events,
) {
    let mut words: Vec<&str> = Vec::new();
    let mut forms = Vec::new();
    for (word, form) in kinds {
        forms.extend(form);
        if !words.contains(&word) {
            words.push(word);
        }
    }
    // A file that names no plot has figures of all forms.
    if words.is_empty() {
        return;
    }
    for key in without_effect_on_all(settings, &forms) {
        events.warn(&format!("{key} in [figures] has no effect on {}", words.join(", ")));
    }
}
