//! A plan's frames to results: one pass over the files of each view, all methods and all metrics.

use std::collections::BTreeMap;

use fovqa_config::{Eye, Plan};
use fovqa_results::{Comparison, Failure, FrameResult, Input, RunResults, ScoreReport, both_eyes};

use crate::error::EngineError;
use crate::events::{Events, Progress, Warnings};
use crate::find::{Found, FoundView, Problem};
use crate::inputs::Inputs;
use crate::light::FvvdpMaps;
use crate::scoring::{Scoring, TakenDown, scene_bands};

/// A frame of a comparison, scored or not, as soon as it is finished.
#[derive(Debug)]
pub struct Finished<'a> {
    /// The scene.
    pub scene: &'a str,
    /// The method.
    pub method: &'a str,
    /// The eye, in a scene with two.
    pub eye: Option<Eye>,
    /// Inputs that were read for it, and for nothing before it, where they were hashed.
    pub inputs: Vec<Input>,
    /// Its result.
    pub result: Result<&'a FrameResult, &'a Failure>,
    /// Its heat maps, where they are asked for.
    pub maps: Option<&'a FvvdpMaps>,
}

/// Takes down what is finished; an error ends the run.
pub type Record<'a> = dyn FnMut(Finished<'_>) -> Result<(), EngineError> + 'a;

/// Checks what needs no file: parameters, and that what needs a view has one.
///
/// # Errors
/// The first that cannot be.
pub fn check(plan: &Plan) -> Result<(), EngineError> {
    let mut views = plan.scenes.iter().flat_map(|scene| &scene.eyes);
    views.try_for_each(|view| crate::settle::metrics(plan, &view.settings).map(|_| ()))
}

/// Scores every frame that was found. What cannot be scored is in the failures of its comparison.
///
/// # Errors
/// When the plan itself cannot be ([`check`]), or what is finished cannot be taken down.
pub fn run(
    plan: &Plan,
    found: &Found,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<RunResults, EngineError> {
    check(plan)?;
    let steps = |view: &FoundView| view.frames.iter().map(|f| f.tests.len()).sum::<usize>();
    let total = found.views.iter().map(steps).sum();
    let mut progress = Progress::new(events, total);
    let mut warnings = Warnings::new(events);
    let mut reports: BTreeMap<Place, ScoreReport> = BTreeMap::new();
    for problem in &found.problems {
        let failure = whole(problem.error.to_string(), problem.error.help());
        for place in places(plan, problem) {
            reports.entry(place).or_default().failures.push(failure.clone());
        }
    }
    let mut inputs = Inputs::default();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let bands = scene_bands(scene, found, view.scene);
        let scoring = Scoring { plan, scene, view, bands: bands.as_ref() };
        let mut taken_down = TakenDown {
            reports: &mut reports,
            inputs: &mut inputs,
            warnings: &mut warnings,
            progress: &mut progress,
            record,
        };
        scoring.run(&mut taken_down)?;
    }
    Ok(RunResults { comparisons: in_order(plan, events, reports), inputs: inputs.all() })
}

/// Indices of a scene, a method and an eye's view.
pub(crate) type Place = (usize, usize, usize);

/// The comparisons a problem is of.
fn places(plan: &Plan, problem: &Problem) -> Vec<Place> {
    let tests = &plan.scenes[problem.scene].eyes[problem.eye].tests;
    let methods = tests.iter().map(|(method, _)| *method);
    methods
        .filter(|method| problem.method.is_none_or(|only| only == *method))
        .map(|method| (problem.scene, method, problem.eye))
        .collect()
}

pub(crate) fn whole(message: String, help: String) -> Failure {
    Failure { frame: None, reference: String::new(), test: String::new(), message, help }
}

/// Comparisons in the order of scenes, methods and eyes, with both eyes behind the two.
fn in_order(
    plan: &Plan,
    events: &dyn Events,
    mut reports: BTreeMap<Place, ScoreReport>,
) -> Vec<Comparison> {
    let mut comparisons = Vec::new();
    for (scene_index, scene) in plan.scenes.iter().enumerate() {
        for (method_index, method) in plan.methods.iter().enumerate() {
            let mut push = |eye, report| {
                let (scene, method) = (scene.name.clone(), method.clone());
                comparisons.push(Comparison { scene, method, eye, report });
            };
            let mut eyes = Vec::new();
            for (index, view) in scene.eyes.iter().enumerate() {
                if let Some(report) = reports.remove(&(scene_index, method_index, index)) {
                    eyes.push((view.eye.map_or("", Eye::name), report));
                }
            }
            let both = match eyes.as_slice() {
                [(_, left), (_, right)] => {
                    let both = both_eyes(left, right);
                    let alone = left.frames.len() + right.frames.len() - 2 * both.frames.len();
                    if alone > 0 {
                        let (scene, frames) =
                            (&scene.name, if alone == 1 { "frame" } else { "frames" });
                        events.warn(&format!(
                            "{scene}, {method}: {alone} {frames} of one eye have no partner of the other, and are not in the results of both"
                        ));
                    }
                    Some(both)
                }
                _ => None,
            };
            for (eye, report) in eyes {
                push(eye, report);
            }
            if let Some(both) = both {
                push("both", both);
            }
        }
    }
    comparisons
}
