//! A plan's frames to results: one pass over the files of each view, all methods and all metrics.

use std::collections::BTreeMap;

use fovqa_config::{Eye, EyeView, Gaze, Plan, Scene};
use fovqa_io::{FileId, frame_size, read_mask};
use fovqa_results::{Comparison, Failure, FrameResult, Input, RunResults, ScoreReport, both_eyes};
use fovqa_vision::BandEdges;

use crate::error::EngineError;
use crate::events::{Events, Warnings};
use crate::find::{Found, FoundView, Problem};
use crate::load::{Loaded, Loader, Step};
use crate::read_ahead::read_ahead;
use crate::setup::farthest_deg;
use crate::view::ViewRun;

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
    let mut progress = Progress { events, done: 0, total };
    events.progress(0, total);
    let mut warnings = Warnings::new(events);
    let mut reports: BTreeMap<Place, ScoreReport> = BTreeMap::new();
    for problem in &found.problems {
        let failure = whole(problem.error.to_string(), problem.error.help());
        for place in places(plan, problem) {
            reports.entry(place).or_default().failures.push(failure.clone());
        }
    }
    let mut inputs = BTreeMap::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let mut scoring = Scoring {
            plan,
            scene,
            view,
            eye: &scene.eyes[view.eye],
            bands: scene_bands(scene, found, view.scene),
            inputs: &mut inputs,
            warnings: &mut warnings,
        };
        scoring.run(&mut reports, &mut progress, record)?;
    }
    let inputs = inputs.into_iter().map(|(path, id)| input(path, id)).collect();
    Ok(RunResults { comparisons: in_order(plan, events, reports), inputs })
}

fn input(path: String, FileId { bytes, sha256 }: FileId) -> Input {
    Input { path, bytes, sha256 }
}

/// Indices of a scene, a method and an eye's view.
type Place = (usize, usize, usize);

/// The comparisons a problem is of.
fn places(plan: &Plan, problem: &Problem) -> Vec<Place> {
    let tests = &plan.scenes[problem.scene].eyes[problem.eye].tests;
    let methods = tests.iter().map(|(method, _)| *method);
    methods
        .filter(|method| problem.method.is_none_or(|only| only == *method))
        .map(|method| (problem.scene, method, problem.eye))
        .collect()
}

fn whole(message: String, help: String) -> Failure {
    Failure { frame: None, reference: String::new(), test: String::new(), message, help }
}

struct Progress<'a> {
    events: &'a dyn Events,
    done: usize,
    total: usize,
}

impl Progress<'_> {
    fn step(&mut self) {
        self.done += 1;
        self.events.progress(self.done, self.total);
    }
}

/// One view's share of a run.
struct Scoring<'a, 'w, 'e> {
    plan: &'a Plan,
    scene: &'a Scene,
    view: &'a FoundView,
    eye: &'a EyeView,
    bands: Option<BandEdges>,
    inputs: &'w mut BTreeMap<String, FileId>,
    warnings: &'w mut Warnings<'e>,
}

impl Scoring<'_, '_, '_> {
    fn run(
        &mut self,
        reports: &mut BTreeMap<Place, ScoreReport>,
        progress: &mut Progress<'_>,
        record: &mut Record<'_>,
    ) -> Result<(), EngineError> {
        let (plan, eye) = (self.plan, self.eye);
        self.warnings.enter(self.place(), self.view.frames.len());
        let (metrics, left_out) = crate::settle::metrics(plan, &eye.settings)?;
        for metric in left_out {
            let label = metric.info().label;
            let message = format!("{label} is left out: it needs {{view}}");
            self.warnings.once_a_view(metric.key(), &message);
        }
        if self.view.passed_over > 0 {
            let alone = self.view.passed_over;
            let message = format!("{alone} frames without a partner are passed over");
            self.warnings.once_a_view("alone", &message);
        }
        let mask = match eye.settings.mask.as_deref() {
            None => None,
            Some(path) => match read_mask(path, &eye.settings.read) {
                Ok(mask) => Some(mask),
                Err(error) => {
                    let error =
                        EngineError::Mask(error).with_paths(&|path| plan.shown(path).into());
                    for &(method, _) in &eye.tests {
                        let report = reports.entry(self.comparison(method)).or_default();
                        report.failures.push(whole(error.to_string(), error.help()));
                    }
                    return Ok(());
                }
            },
        };
        for &(method, _) in &eye.tests {
            let report = reports.entry(self.comparison(method)).or_default();
            report.metrics.clone_from(&metrics);
            let held = |trace: &Vec<fovqa_vision::GazeAt>| trace.iter().filter(|g| g.held).count();
            report.gaze_held = self.view.trace.as_ref().map(held);
        }
        let bands = self.bands.take();
        let mut beside = self.inputs_beside();
        let mut run = ViewRun::new(plan, eye, self.view, mask, metrics, bands.as_ref());
        let steps: Vec<Step<'_>> = steps(self.view);
        let loader = Loader { plan, settings: &eye.settings };
        let mut stopped = Ok(());
        read_ahead(
            &steps,
            rayon::current_num_threads(),
            |step| loader.load(step),
            Loaded::bytes,
            |index, loaded| {
                if stopped.is_err() {
                    return;
                }
                let step = &steps[index];
                let mut inputs = std::mem::take(&mut beside);
                inputs.extend(self.new_inputs(&loaded));
                let result = run.step(step, loaded, self.warnings);
                let finished = Finished {
                    scene: &self.scene.name,
                    method: &plan.methods[step.method],
                    eye: eye.eye,
                    inputs,
                    result: result.as_ref(),
                };
                stopped = record(finished);
                let report = reports.entry(self.comparison(step.method)).or_default();
                match result {
                    Ok(frame) => report.frames.push(frame),
                    Err(failure) => report.failures.push(failure),
                }
                progress.step();
            },
        );
        stopped?;
        for &(method, _) in &eye.tests {
            let report = reports.entry(self.comparison(method)).or_default();
            if let Some((view, metrics)) = run.settled() {
                report.view = view;
                report.metrics = metrics;
            }
        }
        Ok(())
    }

    /// What is read once for all frames: mask and gaze trace.
    fn inputs_beside(&mut self) -> Vec<Input> {
        let settings = &self.eye.settings;
        let trace = match &settings.gaze {
            Gaze::Trace { path, .. } => Some(path),
            Gaze::Centre | Gaze::Point(_) => None,
        };
        let files = [settings.mask.as_ref(), trace].into_iter().flatten();
        let mut new = Vec::new();
        for path in files.filter(|_| self.plan.hash_inputs) {
            let shown = self.plan.shown(path);
            // It has been read: what has become of it since is said by what it says now.
            if let Ok(id) = FileId::of_file(path)
                && !self.inputs.contains_key(&shown)
            {
                self.inputs.insert(shown.clone(), id.clone());
                new.push(input(shown, id));
            }
        }
        new
    }

    /// The files of a step that have not been read before.
    fn new_inputs(&mut self, loaded: &Loaded) -> Vec<Input> {
        let mut new = Vec::new();
        for side in loaded.reference.iter().chain([&loaded.test]).flatten() {
            if let Some(id) = &side.id
                && !self.inputs.contains_key(&side.file)
            {
                self.inputs.insert(side.file.clone(), id.clone());
                new.push(input(side.file.clone(), id.clone()));
            }
        }
        new
    }

    fn comparison(&self, method: usize) -> Place {
        (self.view.scene, method, self.view.eye)
    }

    /// How warnings name the view.
    fn place(&self) -> String {
        match self.eye.eye {
            None => self.scene.name.clone(),
            Some(eye) => format!("{}, {} eye", self.scene.name, eye.name()),
        }
    }
}

fn steps(view: &FoundView) -> Vec<Step<'_>> {
    let frames = view.frames.iter().enumerate();
    let steps = frames.flat_map(|(index, frame)| {
        frame.tests.iter().enumerate().map(move |(nth, (method, test))| Step {
            frame: index,
            reference: (nth == 0).then_some(&*frame.reference),
            method: *method,
            test,
        })
    });
    steps.collect()
}

/// The bands of a scene with two eyes and none given: one list, as far as either eye sees.
fn scene_bands(scene: &Scene, found: &Found, index: usize) -> Option<BandEdges> {
    let default = |view: &EyeView| view.settings.view.is_some() && view.settings.bands.is_none();
    if scene.eyes.len() < 2 || !scene.eyes.iter().all(default) {
        return None;
    }
    let farthest = found.views.iter().filter(|view| view.scene == index).filter_map(|view| {
        let settings = &scene.eyes[view.eye].settings;
        let size = |frame: &crate::find::FoundFrame| frame_size(&frame.reference).ok();
        let (w, h) = match settings.crop {
            Some(crop) => (crop.width, crop.height),
            None => view.frames.iter().find_map(size)?,
        };
        let resolved = settings.view.as_ref()?.resolve(w, h).ok()?;
        Some(farthest_deg(settings, view.trace.as_deref(), &resolved.view))
    });
    farthest.reduce(f64::max).map(BandEdges::default_up_to)
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
