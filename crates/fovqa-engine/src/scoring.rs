//! One view's share of a run: its files in order, every test against its reference.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use fovqa_config::{EyeView, Gaze, MetricChoice, Plan, Scene};
use fovqa_frame::Mask;
use fovqa_io::{FileId, frame_size, read_mask};
use fovqa_metrics::{Metric, MetricKind};
use fovqa_results::{Input, ScoreReport};
use fovqa_vision::{BandEdges, GazeAt};

use crate::error::EngineError;
use crate::events::{Progress, Warnings};
use crate::find::{Found, FoundFrame, FoundView};
use crate::inputs::Inputs;
use crate::load::{Loaded, Loader, Step};
use crate::read_ahead::read_ahead;
use crate::run::{Finished, Place, Record, whole};
use crate::setup::farthest_deg;
use crate::view::ViewRun;

/// What is to be scored.
pub(crate) struct Scoring<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) scene: &'a Scene,
    pub(crate) view: &'a FoundView,
    /// Bands of the whole scene, where both eyes' views decide them.
    pub(crate) bands: Option<&'a BandEdges>,
}

/// Where it goes.
pub(crate) struct TakenDown<'a, 'e, 'r> {
    pub(crate) reports: &'a mut BTreeMap<Place, ScoreReport>,
    pub(crate) inputs: &'a mut Inputs,
    pub(crate) warnings: &'a mut Warnings<'e>,
    pub(crate) progress: &'a mut Progress<'e>,
    pub(crate) record: &'a mut Record<'r>,
}

impl Scoring<'_> {
    fn eye(&self) -> &EyeView {
        &self.scene.eyes[self.view.eye]
    }

    pub(crate) fn run(&self, down: &mut TakenDown<'_, '_, '_>) -> Result<(), EngineError> {
        let (plan, eye) = (self.plan, self.eye());
        let steps = steps(self.view);
        let metrics = self.begin(down)?;
        let mask = match self.mask() {
            Ok(mask) => mask,
            Err(error) => {
                for &(method, _) in &eye.tests {
                    let failure = whole(error.to_string(), error.help());
                    self.report(method, down).failures.push(failure);
                }
                down.progress.step(steps.len());
                return Ok(());
            }
        };
        for &(method, _) in &eye.tests {
            let report = self.report(method, down);
            report.metrics.clone_from(&metrics);
            let held = |trace: &Vec<GazeAt>| trace.iter().filter(|gaze| gaze.held).count();
            report.gaze_held = self.view.trace.as_ref().map(held);
        }
        let mut beside = self.inputs_beside(down.inputs);
        let guides = metrics.contains(&Metric::Atd);
        let loader = Loader { plan, settings: &eye.settings, guides };
        let sequence = (self.bands, self.scene.fps);
        let mut run = ViewRun::new(plan, eye, self.view, mask, metrics, sequence, &loader);
        let mut written = Ok(());
        read_ahead(
            &steps,
            rayon::current_num_threads(),
            |step| loader.load(step),
            Loaded::bytes,
            |index, loaded| {
                let step = &steps[index];
                let mut inputs = std::mem::take(&mut beside);
                for side in loaded.reference.iter().chain([&loaded.test]).flatten() {
                    for (file, id) in &side.ids {
                        inputs.extend(down.inputs.add(file, id));
                    }
                }
                let result = run.step(step, loaded, down.warnings);
                written = (down.record)(Finished {
                    scene: &self.scene.name,
                    method: &plan.methods[step.method],
                    eye: eye.eye,
                    inputs,
                    result: result.as_ref().map(|(frame, _)| frame),
                    maps: result.as_ref().ok().and_then(|(_, maps)| maps.as_ref()),
                });
                let report = self.report(step.method, down);
                match result {
                    Ok((frame, _)) => report.frames.push(frame),
                    Err(failure) => report.failures.push(failure),
                }
                down.progress.step(1);
                // What cannot be taken down any more is not worth scoring.
                if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        );
        written?;
        for &(method, _) in &eye.tests {
            if let Some((view, metrics)) = run.settled() {
                let report = self.report(method, down);
                report.view = view;
                report.metrics = metrics;
                report.atd_guides = run.atd_guides(method);
                report.fvvdp = run.fvvdp(method);
                // A frame that could not be scored has said so; one that was never there has not.
                let missing = report.fvvdp.as_ref().and_then(|fvvdp| fvvdp.missing.clone());
                if let Some(why) = missing.filter(|_| report.failures.is_empty()) {
                    let message = format!("FovVideoVDP has no value for the sequence: {why}");
                    let help =
                        "render the frames that are missing, or leave fvvdp out of {metrics}";
                    report.failures.push(whole(message, help.to_owned()));
                }
            }
        }
        Ok(())
    }

    /// Settles the metrics, and says what has to be said before the first frame.
    fn begin(&self, down: &mut TakenDown<'_, '_, '_>) -> Result<Vec<Metric>, EngineError> {
        let place = match self.eye().eye {
            None => self.scene.name.clone(),
            Some(eye) => format!("{}, {} eye", self.scene.name, eye.name()),
        };
        down.warnings.enter(place, self.view.frames.len());
        let (mut metrics, left_out) = crate::settle::metrics(self.plan, &self.eye().settings)?;
        if self.plan.metrics == MetricChoice::Default && self.view.frames.len() < 2 {
            metrics.retain(|metric| !metric.is(MetricKind::Temporal));
        }
        for metric in left_out {
            let label = metric.info().label;
            let message = format!("{label} is left out: it needs {{view}}");
            down.warnings.once_a_view(metric.key(), &message);
        }
        let alone = self.view.passed_over;
        if alone > 0 {
            let message = format!("{alone} frames without a partner are passed over");
            down.warnings.once_a_view("alone", &message);
        }
        Ok(metrics)
    }

    fn mask(&self) -> Result<Option<Mask>, EngineError> {
        let settings = &self.eye().settings;
        let mask = settings.mask.as_deref().map(|path| read_mask(path, &settings.read));
        let shown = |error: EngineError| error.with_paths(&|path| self.plan.shown(path).into());
        mask.transpose().map_err(|error| shown(EngineError::Mask(error)))
    }

    fn report<'a>(
        &self,
        method: usize,
        down: &'a mut TakenDown<'_, '_, '_>,
    ) -> &'a mut ScoreReport {
        down.reports.entry((self.view.scene, method, self.view.eye)).or_default()
    }

    /// What is read once for all frames: mask and gaze trace.
    fn inputs_beside(&self, inputs: &mut Inputs) -> Vec<Input> {
        let settings = &self.eye().settings;
        let trace = match &settings.gaze {
            Gaze::Trace { path, .. } => Some(path),
            Gaze::Centre | Gaze::Point(_) => None,
        };
        let files = [settings.mask.as_ref(), trace].into_iter().flatten();
        files
            .filter(|_| self.plan.hash_inputs)
            // They have been read; one that has gone since is no input of another run either.
            .filter_map(|path| inputs.add(&self.plan.shown(path), &FileId::of_file(path).ok()?))
            .collect()
    }
}

fn steps(view: &FoundView) -> Vec<Step<'_>> {
    let frames = view.frames.iter().enumerate();
    let steps = frames.flat_map(|(index, frame)| {
        frame.tests.iter().enumerate().map(move |(nth, (method, test))| Step {
            frame: index,
            reference: (nth == 0).then_some((&*frame.reference, &frame.guides)),
            method: *method,
            test,
        })
    });
    steps.collect()
}

/// The bands of a scene with two eyes and none given: one list, as far as either eye sees.
pub(crate) fn scene_bands(scene: &Scene, found: &Found, index: usize) -> Option<BandEdges> {
    let default = |view: &EyeView| view.settings.view.is_some() && view.settings.bands.is_none();
    if scene.eyes.len() < 2 || !scene.eyes.iter().all(default) {
        return None;
    }
    let farthest = found.views.iter().filter(|view| view.scene == index).filter_map(|view| {
        let settings = &scene.eyes[view.eye].settings;
        let size = |frame: &FoundFrame| frame_size(&frame.reference).ok();
        let (w, h) = match settings.crop {
            Some(crop) => (crop.width, crop.height),
            None => view.frames.iter().find_map(size)?,
        };
        let resolved = settings.view.as_ref()?.resolve(w, h).ok()?;
        Some(farthest_deg(settings, view.trace.as_deref(), &resolved.view))
    });
    farthest.reduce(f64::max).map(BandEdges::default_up_to)
}
