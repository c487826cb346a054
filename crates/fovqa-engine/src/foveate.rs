//! Emulates every frame of one eye's view without scoring it.

use std::ops::ControlFlow;

use fovqa_emulate::{Emulator, Picture, SceneLight};
use fovqa_frame::{Frame, SignalTables};
use fovqa_plan::{Plan, SourceSpec};
use fovqa_results::Failure;

use crate::error::EngineError;
use crate::events::{Events, Progress, Warnings};
use crate::found::FoundView;
use crate::foveator::Foveator;
use crate::load::{Fault, Loaded, Loader, Step};
use crate::read_ahead::read_ahead;
use crate::view_frame::{BuiltinLight, ViewFrame, fixed_gaze};

/// An emulated frame.
pub struct FoveatedFrame<'a> {
    /// Frame number.
    pub frame: i64,
    /// Name of the input, as results show it.
    pub input: &'a str,
    /// Index of the input in its source.
    pub index: usize,
    /// The gaze in pixels, as it was given.
    pub gaze_px: [f64; 2],
    /// The input.
    pub reference: &'a Frame,
    /// The input as a picture.
    pub before: &'a Picture,
    /// What the method would have shown.
    pub shown: &'a Picture,
    /// The scene that was sampled in place of the input, if it is built in.
    pub scene: Option<&'a dyn SceneLight>,
    /// The emulation of this gaze: sample counts, budget, and the buffers of the picture.
    pub emulator: &'a Emulator,
}

/// Receives emulated frames in order. An error ends the emulation.
pub type TakeFrame<'a> = dyn FnMut(FoveatedFrame<'_>) -> Result<(), EngineError> + 'a;

/// Emulates every frame of a view whose plan has one method, and that method is emulated. Returns
/// what could not be emulated.
///
/// # Errors
/// If the method is not possible, or `take` refuses a frame.
pub fn foveate(
    plan: &Plan,
    view: &FoundView,
    events: &dyn Events,
    take: &mut TakeFrame<'_>,
) -> Result<Vec<Failure>, EngineError> {
    crate::run::check(plan)?;
    let eye = &plan.scenes[view.scene].eyes[view.eye];
    let Some((method, SourceSpec::Emulated(emulation))) = eye.tests.first() else {
        return Ok(Vec::new());
    };
    let spec = &emulation.spec;
    let mut warnings = Warnings::new(events);
    warnings.enter(String::new(), view.frames.len());
    for remark in &view.remarks {
        warnings.of_view(remark);
    }
    let mut pass = Pass {
        view,
        fixed_gaze: fixed_gaze(eye),
        tables: SignalTables::new(eye.settings.signal),
        foveator: Foveator::new(spec.clone(), eye.settings.view.clone()),
        motion: None,
    };
    let settings = &eye.settings;
    let loader = Loader { settings, sources: &view.sources, guides: spec.is_temporal() };
    let step = |(frame, found)| Step { frame, found, reference: true, method: *method, test: 0 };
    let steps: Vec<Step<'_>> = view.frames.iter().enumerate().map(step).collect();
    let mut progress = Progress::new(events, steps.len());
    let (mut failures, mut taken) = (Vec::new(), Ok(()));
    read_ahead(
        steps.len(),
        loader.loaders(),
        |nth| match &view.sources.builtin {
            Some(builtin) => {
                let reference = Some(Ok(loader.unlit(builtin, steps[nth].found)));
                Loaded { reference, test: None, dominant: None }
            }
            None => loader.load(&steps[nth]),
        },
        Loaded::bytes,
        |nth, loaded| {
            match pass.frame(&steps[nth], loaded, &mut warnings, take) {
                Ok(of_taking) => taken = of_taking,
                Err(failure) => failures.push(failure),
            }
            progress.step(1);
            if taken.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        },
    );
    taken.map(|()| failures)
}

/// What lasts from frame to frame.
struct Pass<'a> {
    view: &'a FoundView,
    fixed_gaze: Option<[f64; 2]>,
    tables: SignalTables,
    foveator: Foveator,
    motion: Option<bool>,
}

impl Pass<'_> {
    /// Emulates a frame and passes it on. The outer error is that of the frame, the inner one that
    /// of `take`.
    fn frame(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        warnings: &mut Warnings<'_>,
        take: &mut TakeFrame<'_>,
    ) -> Result<Result<(), EngineError>, Failure> {
        let listing = self.view.sources.reference.listing();
        let input = listing.name(step.found.reference);
        let failed = |Fault { message, help }| Failure {
            frame: Some(step.found.number),
            reference: input.to_owned(),
            test: String::new(),
            message,
            help,
        };
        let reference = match loaded.reference {
            Some(reference) => reference.map_err(|error| failed(error.into()))?,
            None => unreachable!("every step brings its reference"),
        };
        for note in &reference.notes {
            warnings.once(note, &format!("{}: {note}", reference.file));
        }
        let at = ViewFrame { view: self.view, frame: step.frame, reference: &reference };
        let gaze_px = at.gaze_px(self.fixed_gaze);
        at.ready(&self.foveator, &mut self.motion, warnings).map_err(failed)?;
        let before = Picture::from_frame(&reference.frame, &self.tables);
        let scene = self.view.sources.builtin.as_ref().map(|of| of.frame(step.found.reference));
        let lit = scene.as_deref().map(BuiltinLight);
        let lit = lit.as_ref().map(|lit| lit as &dyn SceneLight);
        let shown = at.show(&mut self.foveator, Some(&before), &self.tables, gaze_px);
        let (shown, emulator) = shown.map_err(failed)?;
        Ok(take(FoveatedFrame {
            frame: step.found.number,
            input,
            index: step.found.reference,
            gaze_px: self.foveator.gaze([before.width(), before.height()], gaze_px),
            reference: &reference.frame,
            before: &before,
            shown: &shown,
            scene: lit,
            emulator: &emulator,
        }))
    }
}
