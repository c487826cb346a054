//! Scores one eye's view of a scene, frame by frame. Each reference is kept for all tests of its
//! frame, and the data for temporal metrics are kept for the frames after it.

use std::collections::BTreeSet;
use std::sync::Arc;

use fovqa_emulate::quads;
use fovqa_frame::{Frame, Mask, SignalTables};
use fovqa_metrics::{Image, Key, Layouts, Map, Metric, MetricKind, Needs, Rows, Subject};
use fovqa_params::ParamValue;
use fovqa_plan::{EyeView, Plan};
use fovqa_results::{Doubt, Failure, FrameResult, FvvdpViewing, GuideSources, ViewResult};
use fovqa_vision::{BandEdges, Seen};

use crate::crops::{CropPair, CropSource};
use crate::dominant_eye::DominantEye;
use crate::emulated_methods::EmulatedMethods;
use crate::events::Warnings;
use crate::found::FoundView;
use crate::load::{Fault, Loaded, Loader, Made, Side, Step, comparable};
use crate::meters::{Measured, Meters, Pair};
use crate::pictures::{PicturePair, picture_of};
use crate::plausibility::{Checks, Seen as SeenPair};
use crate::regions::is_foreseen;
use crate::setup::{Inputs, Setup};
use crate::work::Work;

/// A test that was scored.
pub(crate) struct Scored {
    pub(crate) result: FrameResult,
    pub(crate) maps: Vec<Map>,
    /// The emulated frame, if it is to be kept.
    pub(crate) kept: Option<Frame>,
    /// The regions that figures show.
    pub(crate) crops: Vec<CropPair>,
    /// The pictures that the report shows.
    pub(crate) pictures: Option<PicturePair>,
    /// How the eye sees the frame, if there is a view.
    pub(crate) seen: Option<Seen>,
}

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
    meters: Meters,
    emulated: EmulatedMethods<'a>,
    layouts: Layouts,
    checks: Checks<'a>,
    loader: &'a Loader<'a>,
    /// The picture of a reference, with the index of its frame.
    picture: Option<(usize, Arc<Frame>)>,
    /// Position of the reference's frame.
    position: usize,
}

impl<'a> ViewRun<'a> {
    pub(crate) fn new(
        (plan, eye, view): (&'a Plan, &'a EyeView, &'a FoundView),
        mask: Option<Mask>,
        metrics: Vec<Metric>,
        (bands, fps): (Option<&'a BandEdges>, Option<f64>),
        loader: &'a Loader<'a>,
        dominant: Option<DominantEye<'a>>,
    ) -> Self {
        let needs_light = Needs::of(&metrics).luminance;
        Self {
            plan,
            eye,
            view,
            mask,
            bands,
            tables: SignalTables::new(eye.settings.signal),
            setup: None,
            reference: None,
            meters: Meters::new(plan, &eye.settings, &metrics, view, fps),
            emulated: EmulatedMethods::new(view, eye, dominant, needs_light),
            layouts: Layouts::default(),
            checks: Checks::new(plan, view),
            metrics,
            loader,
            picture: None,
            position: 0,
        }
    }

    /// Prepares to continue before the first pair to be scored. Returns the earlier pairs that the
    /// temporal metrics must read again.
    pub(crate) fn go_on(&mut self, work: &Work<'_>) -> BTreeSet<usize> {
        self.meters.lead_in(work)
    }

    /// Whether a pair decides something for the pairs to be scored that is not decided yet.
    pub(crate) fn wants(&self, step: &Step<'_>, work: &Work<'_>) -> bool {
        let [reference, test] = self.meters.lacks(step.method, step.frame == 0);
        let is_lacking = reference || (test && work.is_of(step.method));
        self.setup.is_none() || (is_lacking && !work.todo.is_empty())
    }

    /// Whether the temporal filter of an emulated method, of which pairs are to be scored, needs a
    /// pair before them.
    pub(crate) fn leads(&self, step: &Step<'_>, work: &Work<'_>) -> bool {
        self.view.sources.is_temporal(step.method) && work.is_of(step.method)
    }

    /// Processes a pair without scoring it. If `kept` is true, the data that later pairs need are
    /// kept.
    pub(crate) fn take_in(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        kept: bool,
        warnings: &mut Warnings<'_>,
    ) -> Result<(), Failure> {
        self.take(step, loaded, warnings, |run, reference, test, warnings| {
            let finite = run.enter(step, reference, test, warnings)?;
            // Pairs that are scored elsewhere are suspected there.
            if run.checks.refuses() {
                run.doubts(step, (reference, test), finite.as_ref(), warnings)?;
            }
            if !kept {
                return Ok(());
            }
            // The gaze affects only one decision here: which pixels the mask leaves.
            let gaze_px = run.view.trace.as_ref().map(|trace| trace[step.frame].px);
            let gaze_px = gaze_px.filter(|_| finite.is_some());
            run.with_pair(step, (reference, test), gaze_px, finite.as_ref(), |meters, pair| {
                meters.take_in(pair)
            })
        })
    }

    /// Which motion and depth the temporal differences of a method used.
    pub(crate) fn guide_sources(&self, method: usize) -> GuideSources {
        self.meters.guide_sources(method)
    }

    /// The viewing conditions of FovVideoVDP for the sequence of a method, if the metric is
    /// requested and a pair could be compared.
    pub(crate) fn fvvdp(&self, method: usize) -> Option<FvvdpViewing> {
        self.meters.fvvdp(method, self.setup.as_ref()?)
    }

    /// Why FovVideoVDP has no value for the sequence of a method, as far as the sequence was read
    /// here.
    pub(crate) fn missing(&self, method: usize) -> Option<String> {
        self.meters.missing(method, |index| self.view.frames[index].number.to_string())
    }

    /// The view and the metrics that fit it, as soon as a pair could be compared.
    pub(crate) fn settled(&self) -> Option<(Option<ViewResult>, Vec<Metric>)> {
        let setup = self.setup.as_ref()?;
        Some((setup.view.clone(), setup.metrics.clone()))
    }

    /// Scores one test. Keeps the reference if it comes with this step.
    pub(crate) fn step(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        warnings: &mut Warnings<'_>,
    ) -> Result<Scored, Failure> {
        self.take(step, loaded, warnings, |run, reference, test, warnings| {
            let finite = run.enter(step, reference, test, warnings)?;
            let doubts = run.doubts(step, (reference, test), finite.as_ref(), warnings)?;
            run.score(step, (reference, test), finite.as_ref(), doubts, warnings)
        })
    }

    /// Prepares for previews: what is known of whole methods has been reported already.
    pub(crate) fn for_previews(&mut self) {
        self.checks.forget_methods();
    }

    /// Looks at a pair without scoring it, and reports the warnings that it would bring.
    pub(crate) fn preview(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        warnings: &mut Warnings<'_>,
    ) -> Result<(), Failure> {
        self.take(step, loaded, warnings, |run, reference, test, warnings| {
            let finite = run.enter(step, reference, test, warnings)?;
            run.meters.foresee(&reference.frame, warnings);
            run.doubts(step, (reference, test), finite.as_ref(), warnings).map(|_| ())
        })
    }

    /// Looks for mistakes in a pair.
    fn doubts(
        &self,
        step: &Step<'_>,
        (reference, test): (&Side, &Side),
        finite: Option<&Mask>,
        warnings: &mut Warnings<'_>,
    ) -> Result<Vec<Doubt>, Fault> {
        let Some(setup) = &self.setup else { return Ok(Vec::new()) };
        let within = finite.map(|finite| setup.within_mask(finite));
        let traced = self.view.trace.as_ref().map(|trace| trace[step.frame].px);
        let seen = SeenPair {
            reference,
            test,
            tables: &self.tables,
            counts: within.as_ref().or(setup.mask()),
            gaze_px: setup.view.as_ref().map(|view| traced.unwrap_or(view.gaze_px)),
        };
        self.checks.look(step, &seen, warnings)
    }

    /// Keeps the reference if it comes with the step, and processes the pair.
    fn take<T>(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        warnings: &mut Warnings<'_>,
        with: impl FnOnce(&mut Self, &Side, &Side, &mut Warnings<'_>) -> Result<T, Fault>,
    ) -> Result<T, Failure> {
        if let Some(reference) = loaded.reference {
            if let Some(Ok(old)) = &self.reference {
                self.meters.leave(old, self.position);
            }
            self.emulated.enter(loaded.dominant);
            self.position = self.view.frames[step.frame].position;
            self.reference = Some(reference.map_err(Fault::from));
        }
        let reference = self.reference.take();
        let result = match &reference {
            Some(Err(fault)) => Err(fault.clone()),
            Some(Ok(reference)) => {
                let test = match loaded.test {
                    Some(test) => test.map_err(Fault::from),
                    None => self.emulated.next(step, reference, self.view, &self.tables, warnings),
                };
                test.and_then(|test| with(self, reference, &test, warnings))
            }
            None => unreachable!("the first test of a frame brings its reference"),
        };
        self.reference = reference;
        result.map_err(|Fault { message, help }| {
            let frame = &self.view.frames[step.frame];
            Failure {
                frame: Some(frame.number),
                reference: self.view.sources.reference.listing().name(frame.reference).to_owned(),
                test: self.view.sources.test_name(step.method, step.test),
                message,
                help,
            }
        })
    }

    /// Decides what depends on the first frame, and checks later frames against it.
    fn settle(&mut self, reference: &Side, warnings: &mut Warnings<'_>) -> Result<(), Fault> {
        let (size, view) = (reference.size(), self.view);
        let setup = match &mut self.setup {
            Some(setup) => setup,
            none => {
                let inputs = Inputs {
                    plan: self.plan,
                    settings: &self.eye.settings,
                    scene_bands: self.bands,
                    metrics: &self.metrics,
                    mask: self.mask.as_ref(),
                    trace: view.trace.as_deref(),
                    pairs: &view.frames.iter().map(|f| f.tests.len()).collect::<Vec<_>>(),
                    file_size: reference.frame.file_size(),
                };
                let setup = Setup::new(&inputs, size, reference.file.to_string(), warnings)?;
                self.meters.settle(self.plan, &setup.metrics);
                none.insert(setup)
            }
        };
        if size == setup.size {
            return Ok(());
        }
        Err(Fault {
            message: format!(
                "{} has {}x{} pixels, but {}, the first of the sequence, has {}x{}",
                reference.file, size.0, size.1, setup.first_file, setup.size.0, setup.size.1
            ),
            help: "all frames of a sequence must have the same size".to_owned(),
        })
    }

    /// Checks that a pair may be compared and that it fits the pairs before it. Returns where both
    /// images are finite.
    fn enter(
        &mut self,
        step: &Step<'_>,
        reference: &Side,
        test: &Side,
        warnings: &mut Warnings<'_>,
    ) -> Result<Option<Mask>, Fault> {
        let finite = comparable(reference, test, self.eye.settings.nonfinite)?;
        for side in [reference, test] {
            for note in &side.notes {
                warnings.once(note, &format!("{}: {note}", side.file));
            }
        }
        self.settle(reference, warnings)?;
        if let Some(setup) = &self.setup {
            for side in [reference, test] {
                setup.check_pixels(&side.file, side.pixel_aspect)?;
            }
        }
        self.meters.check(step.method, [reference, test], step.frame == 0)?;
        Ok(finite)
    }

    fn score(
        &mut self,
        step: &Step<'_>,
        (reference, test): (&Side, &Side),
        finite: Option<&Mask>,
        doubts: Vec<Doubt>,
        warnings: &mut Warnings<'_>,
    ) -> Result<Scored, Fault> {
        let (view, frame) = (self.view, &self.view.frames[step.frame]);
        let gaze_px = view.trace.as_ref().map(|trace| trace[step.frame].px);
        let setup = self.setup.as_ref();
        let fixed = setup.and_then(|setup| setup.view.as_ref()).map(|view| view.gaze_px);
        if let Some(gaze) = gaze_px.or(fixed) {
            warn_of_gaze(gaze, reference.size(), warnings);
        }
        let Measured { rows, maps } =
            self.with_pair(step, (reference, test), gaze_px, finite, |meters, pair| {
                let mut measured = meters.measure(pair, warnings)?;
                if let Some(made) = &test.made {
                    add_samples(made, pair.setup.size, &mut measured.rows);
                }
                warn_of_left_out(&pair.setup.metrics, &measured.rows, frame.number, warnings);
                Ok(measured)
            })?;
        let follows = step.frame > 0 && view.frames[step.frame - 1].position + 1 == frame.position;
        let trace = view.trace.as_ref().filter(|_| follows);
        let gaze_step_deg = trace.zip(self.setup.as_ref()).and_then(|(trace, setup)| {
            setup.gaze_step_deg(trace[step.frame - 1].px, trace[step.frame].px)
        });
        let result = FrameResult {
            frame: frame.number,
            reference: Arc::clone(&reference.file),
            test: Arc::clone(&test.file),
            gaze_px,
            gaze_step_deg,
            doubts,
            rows: self.layouts.pack(&rows),
        };
        let kept = test.made.as_ref().and_then(|made| made.kept.clone());
        let crops = self.crops(step, (reference, test), gaze_px.or(fixed), warnings);
        let pictures = self.pictures(step, (reference, test));
        let seen = self.setup.as_ref().zip(gaze_px.or(fixed));
        let seen = seen.and_then(|(setup, gaze_px)| setup.seen(gaze_px));
        Ok(Scored { result, maps, kept, crops, pictures, seen })
    }

    /// Whether the report shows the pair of a step.
    fn is_shown(&self, step: &Step<'_>) -> bool {
        let frames = &self.view.frames;
        let (place, number) = ((step.frame, frames.len()), frames[step.frame].number);
        self.plan.pictures.is_of(step.method, place, number)
    }

    /// The pictures of a pair, if the report shows it.
    fn pictures(
        &mut self,
        step: &Step<'_>,
        (reference, test): (&Side, &Side),
    ) -> Option<PicturePair> {
        if !self.is_shown(step) {
            return None;
        }
        let known = self.picture.take().filter(|(frame, _)| *frame == step.frame);
        let reference = known.map_or_else(
            || Arc::new(picture_of(&reference.frame, &self.tables)),
            |(_, picture)| picture,
        );
        self.picture = Some((step.frame, Arc::clone(&reference)));
        let test_picture = picture_of(&test.frame, &self.tables);
        let borders = test.made.as_ref().map(|made| made.borders.clone()).unwrap_or_default();
        Some(PicturePair { reference, test: test_picture, borders })
    }

    /// The regions of a pair that figures show.
    fn crops(
        &self,
        step: &Step<'_>,
        (reference, test): (&Side, &Side),
        gaze_px: Option<[f64; 2]>,
        warnings: &mut Warnings<'_>,
    ) -> Vec<CropPair> {
        if self.plan.crops.is_empty() {
            return Vec::new();
        }
        let frame = &self.view.frames[step.frame];
        let source = CropSource {
            scene: &self.plan.scenes[self.view.scene].name,
            eye: self.eye,
            frame: (frame.number, step.frame == 0),
            reference: &reference.frame,
            test: &test.frame,
            gaze_px,
            tables: &self.tables,
            is_foreseen: &|| is_foreseen(self.view, frame),
        };
        source.cut(&self.plan.crops, warnings)
    }

    /// Passes a pair with its gaze to the meters.
    fn with_pair<T>(
        &mut self,
        step: &Step<'_>,
        (reference, test): (&Side, &Side),
        gaze_px: Option<[f64; 2]>,
        finite: Option<&Mask>,
        show: impl FnOnce(&mut Meters, &Pair<'_>) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let (view, loader, is_shown) = (self.view, self.loader, self.is_shown(step));
        let (emulated, tables) = (&self.emulated, &self.tables);
        let Some(setup) = &mut self.setup else { unreachable!("it has just been settled") };
        if let Some(gaze_px) = gaze_px {
            setup.look_at(gaze_px);
        }
        let (setup, retina) = (&*setup, setup.retina());
        let (regions, blocks) = match finite {
            None => retina.regions(),
            Some(finite) => {
                retina.regions_within(&setup.within_mask(finite), setup.window_radius())
            }
        };
        let frame = &view.frames[step.frame];
        let pair = Pair {
            frame: step.frame,
            position: frame.position,
            method: step.method,
            tests: frame.tests.len(),
            reference,
            test,
            gaze_px: gaze_px.or(setup.view.as_ref().map(|v| v.gaze_px)).unwrap_or_default(),
            tables,
            setup,
            retina: &retina,
            regions: &regions,
            blocks: &blocks,
            finite,
            maps: self.plan.maps || is_shown,
            load: &|frame, method| {
                let alone =
                    |reference: &Frame| emulated.alone(method, frame, reference, view, tables);
                loader.pair(&view.frames[frame], method, alone)
            },
        };
        show(&mut self.meters, &pair)
    }
}

/// Adds the samples that an emulated test stands for.
fn add_samples(made: &Made, (width, height): (usize, usize), rows: &mut Rows) {
    let counts = &made.counts;
    let values = [
        (Subject::Samples, counts.samples),
        (Subject::SamplesOnScreen, counts.samples_on_screen),
        (Subject::SamplesBeyond, counts.samples_beyond),
        (Subject::SamplesShare, counts.share((width * height) as f64)),
    ];
    let reshaded = made.reshaded_share.map(|share| (Subject::ReshadedShare, share));
    let quads = counts.shaded_quads().map(|shaded| {
        let share = shaded as f64 / quads([width, height]) as f64;
        [(Subject::Quads, shaded as f64), (Subject::QuadsShare, share)]
    });
    let budget = made.budget.as_ref();
    let asked = budget.map(|budget| (Subject::BudgetShare, budget.budget.share));
    let ideal = budget.map(|budget| (Subject::BudgetIdealShare, budget.ideal_share));
    let key = |subject| Key::pixels(subject).of_image(Image::Test);
    for (subject, value) in values
        .into_iter()
        .chain(reshaded)
        .chain(quads.into_iter().flatten())
        .chain(asked)
        .chain(ideal)
    {
        rows.score(key(subject), value);
    }
    match budget.map(|budget| &budget.value) {
        Some(ParamValue::Number(value)) => rows.score(key(Subject::BudgetValue), *value),
        Some(ParamValue::List(values)) => {
            for (index, value) in values.iter().enumerate() {
                rows.score(key(Subject::BudgetValue).on_level(index + 1), *value);
            }
        }
        _ => {}
    }
}

/// Warns of metrics for which the mask leaves no window.
fn warn_of_left_out(metrics: &[Metric], rows: &Rows, frame: i64, warnings: &mut Warnings<'_>) {
    let left_out = |metric: &&Metric| {
        metric.is(MetricKind::Fidelity)
            && Key::of(**metric).is_score()
            && rows.get(Key::of(**metric)).is_none()
    };
    for metric in metrics.iter().filter(left_out) {
        let label = metric.info().label;
        let message = format!(
            "{label} is left out of frame {frame}: the mask leaves no complete window for it"
        );
        warnings.once_a_view(&format!("{label} without windows"), &message);
    }
}

pub(crate) fn warn_of_gaze(gaze: [f64; 2], size: (usize, usize), warnings: &mut Warnings<'_>) {
    let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
    if !(inside(gaze[0], size.0) && inside(gaze[1], size.1)) {
        let message = format!(
            "the gaze ({}, {}) is outside the frame of {}x{}; eccentricities are still measured from it",
            gaze[0], gaze[1], size.0, size.1
        );
        warnings.once_a_view("gaze outside", &message);
    }
}
