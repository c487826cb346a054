//! Turns the frames of a plan into findings, in one pass over the files of each view for all
//! methods and metrics.

use fovqa_plan::{Plan, SourceSpec};
use fovqa_results::RunResults;

use crate::assemble::{results, whole};
use crate::dominant_eye::DominantEye;
use crate::error::EngineError;
use crate::events::{Events, Progress, Warnings};
use crate::findings::{ComparisonIndex, Entry, Findings, Named, Record};
use crate::found::{FoundInputs, FoundView, Problem};
use crate::scoring::{Recorder, Scoring, scene_bands};
use crate::unit::{Unit, units};

/// Checks everything that needs no file: parameters, and whether metrics that need a view have one.
///
/// # Errors
/// The first error that is found.
pub fn check(plan: &Plan) -> Result<(), EngineError> {
    let mut views = plan.scenes.iter().flat_map(|scene| &scene.eyes);
    views.try_for_each(|view| {
        crate::settle::metrics(plan, &view.settings)?;
        let angles = |(_, test): &(usize, SourceSpec)| match test {
            SourceSpec::Emulated(emulation) => emulation.spec.needs_view(),
            SourceSpec::Files(_) | SourceSpec::Given(_) | SourceSpec::Builtin(_) => None,
        };
        match view.tests.iter().find_map(angles).filter(|_| view.settings.view.is_none()) {
            Some(what) => Err(EngineError::NoView { what: format!("emulating {what}") }),
            None => Ok(()),
        }
    })
}

/// Scores every frame that was found. Items that cannot be scored become failures of their
/// comparison.
///
/// # Errors
/// If the plan itself is not possible ([`check`]), or a result cannot be recorded.
pub fn run(
    plan: &Plan,
    found: &FoundInputs,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<RunResults, EngineError> {
    let findings = score(plan, found, &units(found, None), Findings::default(), events, record)?;
    Ok(results(plan, events, findings))
}

/// Scores the pairs of some units that are not `known` yet (see [`crate::resume`]), and returns all
/// findings. Each new finding is recorded; the known ones are not recorded again.
///
/// # Errors
/// See [`run`].
pub fn score(
    plan: &Plan,
    found: &FoundInputs,
    units: &[Unit],
    mut known: Findings,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<Findings, EngineError> {
    check(plan)?;
    let pairs = units.iter().map(|unit| unit.pairs.len()).sum();
    let mut progress = Progress::new(events, pairs);
    let mut warnings = Warnings::new(events);
    let mut findings = Findings { inputs: known.inputs, ..Findings::default() };
    for problem in &found.problems {
        let failure = whole(problem.error.to_string(), problem.error.help());
        for place in places(plan, problem) {
            record(Entry::Problem(Named::of(plan, place), &failure))?;
            findings.problems.push((place, failure.clone()));
        }
    }
    for unit in units {
        let is_it = |view: &&FoundView| (view.scene, view.eye) == (unit.scene, unit.eye);
        let Some(view) = found.views.iter().find(is_it) else { continue };
        let range = unit.pairs.clone();
        let scene = &plan.scenes[view.scene];
        let bands = scene_bands(scene, found, view.scene);
        let dominant = DominantEye::of(plan, found, view);
        let scoring = Scoring { plan, scene, view, bands: bands.as_ref(), dominant, range };
        let mut recorder = Recorder {
            inputs: &mut findings.inputs,
            warnings: &mut warnings,
            progress: &mut progress,
            record,
        };
        let place = (view.scene, view.eye);
        let known = known.views.remove(&place).unwrap_or_default();
        let scored = scoring.run(known, &mut recorder)?;
        findings.join_view(place, scored);
    }
    Ok(findings)
}

/// The comparisons that a problem affects.
fn places(plan: &Plan, problem: &Problem) -> Vec<ComparisonIndex> {
    let tests = &plan.scenes[problem.scene].eyes[problem.eye].tests;
    let methods = tests.iter().map(|(method, _)| *method);
    methods
        .filter(|method| problem.method.is_none_or(|only| only == *method))
        .map(|method| (problem.scene, method, problem.eye))
        .collect()
}
