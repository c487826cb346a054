//! One eye's view of a scene, frame by frame: each reference is kept for all tests of its frame.

use fovqa_config::{EyeView, Plan};
use fovqa_frame::{Mask, PairSignal, SignalTables};
use fovqa_metrics::{Metric, ScoreError};
use fovqa_results::{Failure, FrameResult, ViewResult};
use fovqa_vision::BandEdges;

use crate::events::Warnings;
use crate::find::FoundView;
use crate::load::{Fault, Loaded, Side, Step, comparable};
use crate::setup::{Inputs, Setup};

/// The state of a view while its frames are scored.
pub(crate) struct ViewRun<'a> {
    plan: &'a Plan,
    eye: &'a EyeView,
    view: &'a FoundView,
    mask: Option<Mask>,
    metrics: Vec<Metric>,
    bands: Option<&'a BandEdges>,
    tables: SignalTables,
    setup: Option<Setup<'a>>,
    /// The reference of the present frame.
    reference: Option<Result<Side, Fault>>,
}

impl<'a> ViewRun<'a> {
    pub(crate) fn new(
        plan: &'a Plan,
        eye: &'a EyeView,
        view: &'a FoundView,
        mask: Option<Mask>,
        metrics: Vec<Metric>,
        bands: Option<&'a BandEdges>,
    ) -> Self {
        let tables = SignalTables::new(eye.settings.signal);
        Self { plan, eye, view, mask, metrics, bands, tables, setup: None, reference: None }
    }

    /// The view and the metrics that fit it, once a pair could be compared.
    pub(crate) fn settled(&self) -> Option<(Option<ViewResult>, Vec<Metric>)> {
        let setup = self.setup.as_ref()?;
        Some((setup.view.clone(), setup.scorer.metrics().to_vec()))
    }

    /// Scores one test, and takes over the reference that comes with it.
    pub(crate) fn step(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        warnings: &mut Warnings<'_>,
    ) -> Result<FrameResult, Failure> {
        if let Some(reference) = loaded.reference {
            self.reference = Some(reference.map_err(Fault::from));
        }
        let reference = self.reference.take();
        let result = match &reference {
            Some(Err(fault)) => Err(fault.clone()),
            Some(Ok(reference)) => loaded
                .test
                .map_err(Fault::from)
                .and_then(|test| self.score(step, reference, &test, warnings)),
            None => unreachable!("the first test of a frame brings its reference"),
        };
        self.reference = reference;
        result.map_err(|Fault { message, help }| {
            let frame = &self.view.frames[step.frame];
            Failure {
                frame: Some(frame.number),
                reference: self.plan.shown(&frame.reference),
                test: self.plan.shown(step.test),
                message,
                help,
            }
        })
    }

    fn score(
        &mut self,
        step: &Step<'_>,
        reference: &Side,
        test: &Side,
        warnings: &mut Warnings<'_>,
    ) -> Result<FrameResult, Fault> {
        let finite = comparable(reference, test, self.eye.settings.nonfinite)?;
        for side in [reference, test] {
            for note in &side.notes {
                warnings.once(note, &format!("{}: {note}", side.file));
            }
        }
        let size = reference.size();
        let (plan, view) = (self.plan, self.view);
        let setup = match &mut self.setup {
            Some(setup) => setup,
            none => {
                let inputs = Inputs {
                    plan,
                    settings: &self.eye.settings,
                    scene_bands: self.bands,
                    metrics: &self.metrics,
                    mask: self.mask.as_ref(),
                    trace: view.trace.as_deref(),
                    frames: view.frames.len(),
                    file_size: reference.frame.file_size(),
                };
                none.insert(Setup::new(&inputs, size, reference.file.clone(), warnings)?)
            }
        };
        if size != setup.size {
            return Err(Fault {
                message: format!(
                    "{} has {}x{} pixels and {}, the first of the sequence, has {}x{}",
                    reference.file, size.0, size.1, setup.first_file, setup.size.0, setup.size.1
                ),
                help: "a sequence has one size".to_owned(),
            });
        }
        let gaze_px = view.trace.as_ref().map(|trace| trace[step.frame].px);
        if let Some(gaze_px) = gaze_px {
            setup.look_at(gaze_px);
        }
        if let Some(gaze) = gaze_px.or(setup.view.as_ref().map(|view| view.gaze_px)) {
            warn_of_gaze(gaze, size, warnings);
        }
        setup.apply_mask();
        let regions = setup.regions(finite.as_ref());
        let signal = PairSignal::new(&reference.frame, &test.frame, &self.tables);
        let scores =
            setup.scorer.score(&signal, &regions, setup.weight()).map_err(|error| Fault {
                message: format!("{}: {error}", test.file),
                help: format!("leave it out of {{metrics}}, or {}", score_help(&error)),
            })?;
        let number = view.frames[step.frame].number;
        for metric in setup.scorer.metrics().iter().filter(|m| !scores.scores.contains_key(m)) {
            let label = metric.info().label;
            let message = format!(
                "{label} is left out of frame {number}: the mask leaves no whole window for it"
            );
            warnings.once_a_view(&format!("{label} without windows"), &message);
        }
        Ok(FrameResult {
            frame: number,
            reference: reference.file.clone(),
            test: test.file.clone(),
            gaze_px,
            scores,
        })
    }
}

fn warn_of_gaze(gaze: [f64; 2], size: (usize, usize), warnings: &mut Warnings<'_>) {
    let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
    if !(inside(gaze[0], size.0) && inside(gaze[1], size.1)) {
        let message = format!(
            "the gaze ({}, {}) lies outside the frame of {}x{}; eccentricities are measured from it all the same",
            gaze[0], gaze[1], size.0, size.1
        );
        warnings.once_a_view("gaze outside", &message);
    }
}

fn score_help(error: &ScoreError) -> &'static str {
    match error {
        ScoreError::TooSmall { .. } => "render larger frames",
        ScoreError::Masked { .. } => "score without a mask",
        ScoreError::NothingLeft | ScoreError::NoWindow { .. } => "check the mask: white is visible",
        ScoreError::NoView { .. } => "give a view",
    }
}
