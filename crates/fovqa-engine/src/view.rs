//! One eye's view of a scene, frame by frame: each reference is kept for all tests of its frame.

mod warm_up;

use fovqa_config::{EyeView, Plan};
use fovqa_frame::{Mask, PairSignal, SignalTables};
use fovqa_metrics::temporal::KeptPlane;
use fovqa_metrics::{
    BlockRegions, Image, Key, Metric, MetricKind, Profiler, Regions, Rows, ScoreError,
};
use fovqa_results::{AtdGuides, Failure, FrameResult, FvvdpSight, GuideSource, ViewResult};
use fovqa_vision::BandEdges;

use crate::events::Warnings;
use crate::find::FoundView;
use crate::load::{Fault, Loaded, Loader, Side, Step, comparable};
use crate::meters::light::{FvvdpMaps, Light, Lit};
use crate::meters::temporal::{Counted, Present, Temporal};
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
    /// The reference of the present frame, and its profile, where that is the same for all tests.
    reference: Option<Result<Side, Fault>>,
    profile: Option<Rows>,
    temporal: Option<Temporal>,
    light: Option<Light>,
    loader: &'a Loader<'a>,
    /// Position of the reference's frame.
    position: usize,
}

impl<'a> ViewRun<'a> {
    pub(crate) fn new(
        plan: &'a Plan,
        eye: &'a EyeView,
        view: &'a FoundView,
        mask: Option<Mask>,
        metrics: Vec<Metric>,
        (bands, fps): (Option<&'a BandEdges>, Option<f64>),
        loader: &'a Loader<'a>,
    ) -> Self {
        let tables = SignalTables::new(eye.settings.signal);
        let temporal = metrics.contains(&Metric::Atd).then(|| Temporal::new(plan.params.atd));
        Self {
            plan,
            eye,
            view,
            mask,
            bands,
            tables,
            setup: None,
            reference: None,
            profile: None,
            temporal,
            light: Light::new(plan, &eye.settings, &metrics, view, fps),
            metrics,
            loader,
            position: 0,
        }
    }

    /// What the differences over time of a method were taken along.
    pub(crate) fn atd_guides(&self, method: usize) -> AtdGuides {
        self.temporal.as_ref().map(|temporal| temporal.guides(method)).unwrap_or_default()
    }

    /// How FovVideoVDP sees the sequence of a method, where it is asked for and a pair could be compared.
    pub(crate) fn fvvdp(&self, method: usize) -> Option<FvvdpSight> {
        self.light.as_ref()?.sight(method, self.setup.as_ref()?.fvvdp()?)
    }

    /// Why FovVideoVDP has no value for the sequence of a method, as far as it goes here.
    pub(crate) fn missing(&self, method: usize) -> Option<String> {
        let number = |index: usize| self.view.frames[index].number.to_string();
        self.light.as_ref()?.missing(method, number)
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
    ) -> Result<(FrameResult, Option<FvvdpMaps>), Failure> {
        self.take(step, loaded, |run, reference, test| {
            let finite = run.enter(step, reference, test, warnings)?;
            run.score(step, reference, test, finite, warnings)
        })
    }

    /// Takes over the reference that comes with a step, and does something with the pair.
    fn take<T>(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        with: impl FnOnce(&mut Self, &Side, &Side) -> Result<T, Fault>,
    ) -> Result<T, Failure> {
        if let Some(reference) = loaded.reference {
            if let (Some(Ok(old)), Some(temporal)) = (&self.reference, &mut self.temporal) {
                temporal.leave(old, self.position);
            }
            self.position = self.view.frames[step.frame].position;
            self.profile = None;
            self.reference = Some(reference.map_err(Fault::from));
        }
        let reference = self.reference.take();
        let result = match &reference {
            Some(Err(fault)) => Err(fault.clone()),
            Some(Ok(reference)) => {
                loaded.test.map_err(Fault::from).and_then(|test| with(self, reference, &test))
            }
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

    /// Settles what the first frame decides, and holds the others against it.
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
                none.insert(Setup::new(&inputs, size, reference.file.clone(), warnings)?)
            }
        };
        if size == setup.size {
            return Ok(());
        }
        Err(Fault {
            message: format!(
                "{} has {}x{} pixels and {}, the first of the sequence, has {}x{}",
                reference.file, size.0, size.1, setup.first_file, setup.size.0, setup.size.1
            ),
            help: "a sequence has one size".to_owned(),
        })
    }

    /// Checks that a pair may be compared, and that it fits those before it; where both are finite.
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
        let position = self.view.frames[step.frame].position;
        if let Some(temporal) = &mut self.temporal {
            let present = Present { reference, test, method: step.method, position };
            temporal.check(&present, step.frame == 0)?;
        }
        Ok(finite)
    }

    fn score(
        &mut self,
        step: &Step<'_>,
        reference: &Side,
        test: &Side,
        finite: Option<Mask>,
        warnings: &mut Warnings<'_>,
    ) -> Result<(FrameResult, Option<FvvdpMaps>), Fault> {
        let (view, size) = (self.view, reference.size());
        let Some(setup) = &mut self.setup else { unreachable!("it has just been settled") };
        let gaze_px = view.trace.as_ref().map(|trace| trace[step.frame].px);
        if let Some(gaze_px) = gaze_px {
            setup.look_at(gaze_px);
        }
        if let Some(gaze) = gaze_px.or(setup.view.as_ref().map(|view| view.gaze_px)) {
            warn_of_gaze(gaze, size, warnings);
        }
        let position = view.frames[step.frame].position;
        let present = Present { reference, test, method: step.method, position };
        let retina = setup.retina();
        let (regions, blocks) = match &finite {
            None => retina.regions(),
            Some(finite) => {
                let mask = setup.within_mask(finite);
                retina.regions_within(&mask, setup.scorer.window_radius())
            }
        };
        let signal = PairSignal::new(&reference.frame, &test.frame, &self.tables);
        let scores = setup.scorer.score(&signal, &regions, retina.weight.as_ref());
        let mut rows = scores.map_err(|error| unscored(&test.file, &error))?;
        let lit = Lit {
            frame: step.frame,
            method: step.method,
            reference: &reference.frame,
            test: &test.frame,
            gaze_px: gaze_px.or(setup.view.as_ref().map(|v| v.gaze_px)).unwrap_or_default(),
            regions: &regions,
            fvvdp: setup.fvvdp().zip(retina.fvvdp.as_ref()),
            tests: view.frames[step.frame].tests.len(),
            bands: setup.bands(),
        };
        let of_light = self.light.as_mut().map(|light| {
            if light.is_dim(step.frame, &reference.frame) {
                warnings.once_a_view("candela", CANDELA);
            }
            light.measure(&lit, &|frame, method| self.loader.pair(&view.frames[frame], method))
        });
        let of_light = of_light.unwrap_or_default();
        rows.extend(&of_light.rows);
        let measured = Measuring {
            profiler: &setup.profiler,
            tables: &self.tables,
            regions: &regions,
            blocks: &blocks,
        };
        let known = self.profile.take().filter(|_| finite.is_none());
        let profiles = measured.both(&present, known, self.temporal.as_mut());
        if let Some([of_reference, of_test]) = &profiles {
            rows.extend(of_reference);
            rows.extend(of_test);
        }
        if finite.is_none() {
            self.profile = profiles.map(|[of_reference, _]| of_reference);
        }
        let counted = Counted { regions: &regions, finite, mask: setup.mask() };
        let atd = self.temporal.as_mut().and_then(|temporal| {
            let found = temporal.differences(&present, counted)?;
            if temporal.guides(step.method).motion == GuideSource::None {
                warnings.once_a_view("no motion", NO_MOTION);
            }
            Some(found)
        });
        if let Some([of_reference, of_test]) = atd {
            of_reference.rows(Image::Reference, &mut rows);
            of_test.rows(Image::Test, &mut rows);
        }
        rows.sort();
        let follows = step.frame > 0 && view.frames[step.frame - 1].position + 1 == position;
        let gaze_step_deg =
            view.trace.as_ref().filter(|_| follows).and_then(|trace| {
                setup.gaze_step_deg(trace[step.frame - 1].px, trace[step.frame].px)
            });
        let number = view.frames[step.frame].number;
        warn_of_left_out(setup.scorer.metrics(), &rows, number, warnings);
        let result = FrameResult {
            frame: number,
            reference: reference.file.clone(),
            test: test.file.clone(),
            gaze_px,
            gaze_step_deg,
            rows,
        };
        Ok((result, of_light.maps))
    }
}

/// Said where differences over time are taken without motion vectors.
const NO_MOTION: &str =
    "ATD is taken without motion vectors: whatever moves counts as a difference";

/// Said where linear files are shown in cd/m² and none of their values is above 1.
const CANDELA: &str = "no pixel of the reference is brighter than 1 cd/m², as linear values are taken for cd/m² on this display: \
     where 1 stands for white or for another amount of light, say how much with fvvdp.cd_m2_per_unit";

/// How the pictures of a pair are measured one by one.
struct Measuring<'a> {
    profiler: &'a Profiler,
    tables: &'a SignalTables,
    regions: &'a Regions<'a>,
    blocks: &'a BlockRegions<'a>,
}

impl Measuring<'_> {
    /// The profiles of a pair, where any are asked for; what is `known` of its reference is not measured
    /// again. The luma of both is left where the next frame finds it.
    fn both(
        &self,
        present: &Present<'_>,
        known: Option<Rows>,
        mut temporal: Option<&mut Temporal>,
    ) -> Option<[Rows; 2]> {
        if self.profiler.is_idle() && temporal.is_none() {
            return None;
        }
        let plane = temporal.as_deref_mut().and_then(|t| t.reference_luma(present.position));
        let reference = match known {
            Some(known) => known,
            None => self.one(present.reference, Image::Reference, plane),
        };
        let test = self.one(present.test, Image::Test, temporal.map(Temporal::test_luma));
        (!self.profiler.is_idle()).then_some([reference, test])
    }

    fn one(&self, side: &Side, image: Image, plane: Option<&mut KeptPlane>) -> Rows {
        if self.profiler.is_idle() && plane.is_none() {
            return Rows::default();
        }
        self.profiler.measure(&side.frame, self.tables, self.regions, self.blocks, image, plane)
    }
}

/// Says which metrics a mask leaves no window for.
fn warn_of_left_out(metrics: &[Metric], rows: &Rows, frame: i64, warnings: &mut Warnings<'_>) {
    let left_out = |metric: &&Metric| {
        metric.is(MetricKind::Fidelity)
            && **metric != Metric::Fvvdp
            && rows.get(Key::of(**metric)).is_none()
    };
    for metric in metrics.iter().filter(left_out) {
        let label = metric.info().label;
        let message =
            format!("{label} is left out of frame {frame}: the mask leaves no whole window for it");
        warnings.once_a_view(&format!("{label} without windows"), &message);
    }
}

pub(crate) fn warn_of_gaze(gaze: [f64; 2], size: (usize, usize), warnings: &mut Warnings<'_>) {
    let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
    if !(inside(gaze[0], size.0) && inside(gaze[1], size.1)) {
        let message = format!(
            "the gaze ({}, {}) lies outside the frame of {}x{}; eccentricities are measured from it all the same",
            gaze[0], gaze[1], size.0, size.1
        );
        warnings.once_a_view("gaze outside", &message);
    }
}

fn unscored(file: &str, error: &ScoreError) -> Fault {
    Fault {
        message: format!("{file}: {error}"),
        help: format!("leave it out of {{metrics}}, or {}", score_help(error)),
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
