//! Scores the pairs of one view: its files in order, and every test against its reference.

use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use fovqa_frame::Mask;
use fovqa_frame::source::{InputId, Source};
use fovqa_io::{id_of_file, read_mask};
use fovqa_metrics::{Metric, Needs};
use fovqa_plan::{Emulation, EyeView, Gaze, Plan, Scene};
use fovqa_results::{Failure, Input, Inputs};
use fovqa_vision::{BandEdges, GazeAt};

use crate::assemble::whole;
use crate::dominant_eye::DominantEye;
use crate::error::EngineError;
use crate::events::{Progress, Warnings};
use crate::findings::{Entry, Finished, Named, Outcome, Record, Settled, ViewFindings};
use crate::found::{FoundInputs, FoundView};
use crate::found_frame::FoundFrame;
use crate::inputs::identity;
use crate::load::{Loaded, Loader, Step};
use crate::memory;
use crate::open_ended::{Ended, OpenEnded};
use crate::read_ahead::read_ahead;
use crate::setup::farthest_deg;
use crate::view::ViewRun;
use crate::work::Work;

/// What to score in a view.
pub(crate) struct Scoring<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) scene: &'a Scene,
    pub(crate) view: &'a FoundView,
    /// Bands of the whole scene, if they depend on the views of both eyes.
    pub(crate) bands: Option<&'a BandEdges>,
    /// The dominant eye of the scene, if methods take from its frames.
    pub(crate) dominant: Option<DominantEye<'a>>,
    /// Range of the view's pairs to score. It is not empty.
    pub(crate) range: Range<usize>,
}

/// Receives the findings, warnings and progress.
pub(crate) struct Recorder<'a, 'e, 'r> {
    pub(crate) inputs: &'a mut Inputs,
    pub(crate) warnings: &'a mut Warnings<'e>,
    pub(crate) progress: &'a mut Progress<'e>,
    pub(crate) record: &'a mut Record<'r>,
}

impl Recorder<'_, '_, '_> {
    fn input(&mut self, path: &Arc<str>, id: &InputId) -> Result<(), EngineError> {
        if !self.inputs.add(Arc::clone(path), identity(id)) {
            return Ok(());
        }
        let (path, InputId { bytes, sha256 }) = (path.to_string(), id.clone());
        (self.record)(Entry::Input(&Input { path, bytes, sha256 }))
    }

    /// Records the files that were read for a step.
    fn inputs_of(&mut self, loaded: &Loaded) -> Result<(), EngineError> {
        let sides = loaded.reference.iter().chain(&loaded.test).chain(&loaded.dominant).flatten();
        let mut ids = sides.flat_map(|side| side.ids.iter().map(move |id| (&side.file, id)));
        ids.try_for_each(|(frame, (file, id))| {
            // Usually, the frame has the name of its file, and both share it.
            let name = if **frame == **file { Arc::clone(frame) } else { file.as_str().into() };
            self.input(&name, id)
        })
    }
}

impl<'a> Scoring<'a> {
    fn eye(&self) -> &'a EyeView {
        &self.scene.eyes[self.view.eye]
    }

    /// Names of the scene and, if there are two, of the eye.
    fn place(&self) -> String {
        match self.eye().eye {
            None => self.scene.name.clone(),
            // The only scene of a command has no name.
            Some(eye) if self.scene.name.is_empty() => format!("{} eye", eye.name()),
            Some(eye) => format!("{}, {} eye", self.scene.name, eye.name()),
        }
    }

    fn named(&self, method: usize) -> Named<'a> {
        let (scene, method) = (&self.scene.name, &self.plan.methods[method]);
        Named { scene, method, eye: self.eye().eye }
    }

    /// Scores the pairs that are not known yet.
    pub(crate) fn run(
        &self,
        known: ViewFindings,
        recorder: &mut Recorder<'_, '_, '_>,
    ) -> Result<ViewFindings, EngineError> {
        let (plan, eye) = (self.plan, self.eye());
        let metrics = self.begin(recorder.warnings)?;
        let fits = self.fits(&metrics).map(|much| recorder.warnings.note_of_view(much.as_deref()));
        let mask = match fits.and_then(|()| self.mask()) {
            Ok(mask) => mask,
            Err(error) => {
                let failure = whole(error.to_string(), error.help());
                (recorder.record)(Entry::ViewFailed(&self.scene.name, eye.eye, &failure))?;
                recorder.progress.step(self.range.len());
                return Ok(ViewFindings { failed: Some(failure), ..ViewFindings::default() });
            }
        };
        self.inputs_beside(recorder)?;
        recorder.progress.step(known.pairs.len());
        let work = Work::new(self.view, self.range.clone(), &known.pairs);
        if work.todo.is_empty() && known.settled.is_some() {
            return Ok(known);
        }
        let uses_guides = |(_, emulation): (usize, &Emulation)| emulation.uses_guides();
        let guides = Needs::of(&metrics).guides || self.view.sources.emulations().any(uses_guides);
        let loader = Loader { settings: &eye.settings, sources: &self.view.sources, guides };
        let sequence = (self.bands, self.view.fps);
        let mut run = ViewRun::new(
            (plan, eye, self.view),
            mask,
            metrics.clone(),
            sequence,
            &loader,
            self.dominant,
        );
        let mut findings = known;
        let frame = self.take_up(&work, &mut run, &loader, &mut findings, recorder)?;
        let passed_over = self.score((&work, frame), &mut run, &loader, &mut findings, recorder)?;
        let settled = Settled { passed_over, ..self.settled(&run, metrics, &work) };
        let (scene, methods) = (&self.scene.name, &plan.methods);
        (recorder.record)(Entry::Settled(scene, eye.eye, &settled, methods))?;
        Ok(ViewFindings { settled: Some(settled), ..findings })
    }

    /// Looks at the first, the middle and the last frame, without scoring them. Returns the pairs that
    /// cannot be scored.
    pub(crate) fn preview(&self, warnings: &mut Warnings<'_>) -> Result<Vec<Failure>, EngineError> {
        let (plan, eye, view) = (self.plan, self.eye(), self.view);
        let place = self.place();
        warnings.enter(place, view.frames.len());
        let (metrics, _) = view.metrics(plan)?;
        // A mask that cannot be read is an error of its own.
        let Ok(mask) = self.mask() else { return Ok(Vec::new()) };
        let loader = Loader { settings: &eye.settings, sources: &view.sources, guides: false };
        if view.sources.all().any(Source::is_read_once) {
            warnings.of_view("a stream can only be read once, so its frames are not looked at");
            return Ok(Vec::new());
        }
        let sequence = (self.bands, view.fps);
        let mut run = ViewRun::new((plan, eye, view), mask, metrics, sequence, &loader, None);
        run.for_previews();
        let last = view.frames.len().saturating_sub(1);
        let frames = BTreeSet::from([0, last / 2, last]);
        let mut failures = Vec::new();
        for frame in frames {
            let Some(found) = view.frames.get(frame) else { continue };
            let mut reference = true;
            for &(method, test) in &found.tests {
                if view.sources.test(method).read().is_none() {
                    continue;
                }
                let step = Step { frame, found, reference, method, test };
                let loaded = loader.load(&step);
                failures.extend(run.preview(&step, loaded, warnings).err());
                reference = false;
            }
        }
        Ok(failures)
    }

    /// Reads the pairs that are needed before the first pair to be scored. Returns the present
    /// frame afterwards.
    fn take_up(
        &self,
        work: &Work<'_>,
        run: &mut ViewRun<'_>,
        loader: &Loader<'_>,
        findings: &mut ViewFindings,
        recorder: &mut Recorder<'_, '_, '_>,
    ) -> Result<Option<usize>, EngineError> {
        let kept = run.go_on(work);
        let mut frame = None;
        for index in 0..work.first() {
            let (kept, step) = (kept.contains(&index), work.step(index, frame));
            if !kept && !run.wants(&step, work) && !run.leads(&step, work) {
                continue;
            }
            frame = Some(step.frame);
            let loaded = self.load(loader, &step);
            recorder.inputs_of(&loaded)?;
            if let Err(failure) = run.take_in(&step, loaded, kept, recorder.warnings) {
                (recorder.record)(Entry::Before(self.named(step.method), &failure))?;
                findings.before.push((step.method, failure));
            }
        }
        Ok(frame)
    }

    /// Scores the pairs, and returns how many were passed over because a source ended before them.
    fn score(
        &self,
        (work, frame): (&Work<'_>, Option<usize>),
        run: &mut ViewRun<'_>,
        loader: &Loader<'_>,
        findings: &mut ViewFindings,
        recorder: &mut Recorder<'_, '_, '_>,
    ) -> Result<usize, EngineError> {
        let mut written = Ok(());
        let mut passed_over = 0;
        let mut ends = OpenEnded::new(self.plan, self.scene, self.view);
        read_ahead(
            work.todo.len(),
            loader.loaders(),
            |nth| self.load(loader, &work.nth_step(nth, frame)),
            Loaded::bytes,
            |nth, loaded| {
                let (index, step) = (&work.todo[nth], &work.nth_step(nth, frame));
                written = recorder.inputs_of(&loaded);
                // If results can no longer be recorded, further scoring is useless.
                if written.is_err() {
                    return ControlFlow::Break(());
                }
                let result = match ends.of_step(step, &loaded, recorder.warnings) {
                    None => run.step(step, loaded, recorder.warnings),
                    Some(Ended::Failed(failure)) => Err(failure),
                    Some(Ended::PassedOver) => {
                        passed_over += 1;
                        recorder.progress.step(1);
                        return ControlFlow::Continue(());
                    }
                };
                let guides = run.guide_sources(step.method);
                written = (recorder.record)(Entry::Pair(Finished {
                    named: self.named(step.method),
                    step: *index,
                    result: result.as_ref().map(|scored| &scored.result),
                    guides,
                    maps: result.as_ref().map_or(&[][..], |scored| scored.maps.as_slice()),
                    kept: result.as_ref().ok().and_then(|scored| scored.kept.as_ref()),
                    crops: result.as_ref().map_or(&[][..], |scored| scored.crops.as_slice()),
                    pictures: result.as_ref().ok().and_then(|scored| scored.pictures.as_ref()),
                    seen: result.as_ref().ok().and_then(|scored| scored.seen.as_ref()),
                }));
                let result = result.map(|scored| scored.result);
                let outcome = Outcome { method: step.method, result, guides };
                findings.pairs.insert(*index, Box::new(outcome));
                recorder.progress.step(1);
                if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        );
        written?;
        // Only the last pairs of a view are followed by the end of its sources.
        let pairs = self.view.pairs();
        if let Some(&last) = work.todo.last()
            && work.end() == pairs
            && let Some(left) = ends.left(recorder.warnings)
        {
            let (method, result) = (work.method(last), Err(left));
            let outcome = Outcome { method, result, guides: run.guide_sources(method) };
            (recorder.record)(Entry::Pair(Finished {
                named: self.named(method),
                step: pairs,
                result: outcome.result.as_ref(),
                guides: outcome.guides,
                maps: &[],
                kept: None,
                crops: &[],
                pictures: None,
                seen: None,
            }))?;
            findings.pairs.insert(pairs, Box::new(outcome));
        }
        Ok(passed_over)
    }

    /// Loads the frames of a step, and with its reference that of the dominant eye.
    fn load(&self, loader: &Loader<'_>, step: &Step<'_>) -> Loaded {
        let dominant = || Some(self.dominant.filter(|_| step.reference)?.load(step.found.number));
        let (loaded, dominant) = rayon::join(|| loader.load(step), dominant);
        Loaded { dominant, ..loaded }
    }

    fn settled(&self, run: &ViewRun<'_>, metrics: Vec<Metric>, work: &Work<'_>) -> Settled {
        let held = |trace: &Vec<GazeAt>| trace.iter().filter(|gaze| gaze.held).count();
        let gaze_held = self.view.trace.as_ref().map(held);
        let (view, metrics) = run.settled().unwrap_or((None, metrics));
        let methods = work.methods();
        let fvvdp = methods.iter().filter_map(|method| Some((*method, run.fvvdp(*method)?)));
        let missing = methods.iter().filter_map(|method| Some((*method, run.missing(*method)?)));
        Settled {
            view,
            metrics,
            gaze_held,
            fvvdp: fvvdp.collect(),
            missing: missing.collect(),
            passed_over: 0,
        }
    }

    /// Selects the metrics, and reports the warnings that belong before the first frame.
    pub(crate) fn begin(&self, warnings: &mut Warnings<'_>) -> Result<Vec<Metric>, EngineError> {
        warnings.enter(self.place(), self.view.frames.len());
        let (metrics, left_out) = self.view.metrics(self.plan)?;
        for metric in left_out {
            let label = metric.info().label;
            let message = format!("{label} is left out: it needs {{view}}");
            warnings.once_a_view(metric.key(), &message);
        }
        for remark in &self.view.remarks {
            warnings.of_view(remark);
        }
        let alone = self.view.passed_over;
        if alone > 0 {
            let message = format!("skipped frames without a partner: {alone}");
            warnings.once_a_view("alone", &message);
        }
        Ok(metrics)
    }

    /// Checks whether the frames fit into memory. Returns a message if they need much of it.
    pub(crate) fn fits(&self, metrics: &[Metric]) -> Result<Option<String>, EngineError> {
        memory::check(self.plan, self.view, metrics)
    }

    fn mask(&self) -> Result<Option<Mask>, EngineError> {
        let settings = &self.eye().settings;
        if let Some(given) = &self.view.sources.mask {
            return Ok(Some(Mask::of(&given.read(0, false)?.frame)));
        }
        let mask = settings.mask.as_deref().map(|path| read_mask(path, &settings.read));
        let shown = |error: EngineError| error.with_paths(&|path| self.plan.shown(path).into());
        mask.transpose().map_err(|error| shown(EngineError::Mask(error)))
    }

    /// Records the files that are read once for all frames: mask and gaze trace.
    fn inputs_beside(&self, recorder: &mut Recorder<'_, '_, '_>) -> Result<(), EngineError> {
        let settings = &self.eye().settings;
        let trace = match &settings.gaze {
            Gaze::Trace { path, .. } => Some(path),
            Gaze::Centre | Gaze::Point(_) | Gaze::Each(_) | Gaze::Builtin => None,
        };
        let files = [settings.mask.as_ref(), trace].into_iter().flatten();
        for path in files.filter(|_| self.plan.hash_inputs) {
            // These files have been read already. If one has disappeared since, another run cannot
            // use it either.
            if let Ok(id) = id_of_file(path) {
                recorder.input(&self.plan.shown(path).into(), &id)?;
            }
        }
        Ok(())
    }
}

/// The bands of a scene with two eyes and no given bands: one list, up to the largest eccentricity
/// that either eye sees.
pub(crate) fn scene_bands(scene: &Scene, found: &FoundInputs, index: usize) -> Option<BandEdges> {
    let default = |view: &EyeView| view.settings.view.is_some() && view.settings.bands.is_none();
    if scene.eyes.len() < 2 || !scene.eyes.iter().all(default) {
        return None;
    }
    let farthest = found.views.iter().filter(|view| view.scene == index).filter_map(|view| {
        let settings = &scene.eyes[view.eye].settings;
        let reference = &view.sources.reference;
        let size = |frame: &FoundFrame| reference.size(frame.reference).ok();
        let (w, h) = match settings.crop {
            Some(crop) => (crop.width, crop.height),
            None => view.frames.iter().find_map(size)?,
        };
        let resolved = settings.view.as_ref()?.resolve(w, h).ok()?;
        Some(farthest_deg(settings, view.trace.as_deref(), &resolved.view))
    });
    farthest.reduce(f64::max).map(BandEdges::default_up_to)
}
