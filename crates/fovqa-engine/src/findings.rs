//! What a run has found so far, pair by pair. Its journal stores the findings, and its results are
//! made from them.

use std::collections::BTreeMap;

use fovqa_frame::Frame;
use fovqa_metrics::{Map, Metric};
use fovqa_plan::{Eye, Plan};
use fovqa_results::{Failure, FrameResult, FvvdpViewing, GuideSources, Input, Inputs, ViewResult};
use fovqa_vision::Seen;

use crate::crops::CropPair;
use crate::error::EngineError;
use crate::pictures::PicturePair;
use crate::unit::Unit;

/// The findings of a whole run, of one of its shards, or of a run that was interrupted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    /// Findings for each view, by the indices of scene and eye.
    pub(crate) views: BTreeMap<ViewIndex, ViewFindings>,
    /// Errors that prevented whole comparisons from being scored before any file was read.
    pub(crate) problems: Vec<(ComparisonIndex, Failure)>,
    pub(crate) inputs: Inputs,
}

/// Indices of a scene and an eye's view in it.
pub(crate) type ViewIndex = (usize, usize);

/// Indices of a scene, a method and an eye's view.
pub(crate) type ComparisonIndex = (usize, usize, usize);

/// The findings about a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ViewFindings {
    /// Outcomes of the pairs, by their index among all pairs of the view. They are boxed, because a
    /// map leaves room for as many values again as it has.
    pub(crate) pairs: BTreeMap<usize, Box<Outcome>>,
    /// What holds for all pairs, once all of them are finished.
    pub(crate) settled: Option<Settled>,
    /// Why no pair of the view could be scored.
    pub(crate) failed: Option<Failure>,
    /// Pairs before those to be scored that could not be compared, with their methods. Once they
    /// can be compared, the results of later pairs change.
    pub(crate) before: Vec<(usize, Failure)>,
}

/// The outcome of one pair.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    /// Index of the method.
    pub(crate) method: usize,
    pub(crate) result: Result<FrameResult, Failure>,
    /// Which motion and depth the temporal differences used, if there are any differences.
    pub(crate) guides: GuideSources,
}

/// What holds for all pairs of a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settled {
    pub(crate) view: Option<ViewResult>,
    pub(crate) metrics: Vec<Metric>,
    pub(crate) gaze_held: Option<usize>,
    /// The viewing conditions of FovVideoVDP for the sequence of each method, by the index of the
    /// method.
    pub(crate) fvvdp: BTreeMap<usize, FvvdpViewing>,
    /// Why FovVideoVDP has no value for the sequence of a method, as far as the sequence was read
    /// here.
    pub(crate) missing: BTreeMap<usize, String>,
    /// Number of pairs without an outcome, because a source ended before them.
    pub(crate) passed_over: usize,
}

/// The names that identify what a line of the journal is about.
#[derive(Debug, Clone, Copy)]
pub struct Named<'a> {
    /// The scene.
    pub scene: &'a str,
    /// The method.
    pub method: &'a str,
    /// The eye, if the scene has two.
    pub eye: Option<Eye>,
}

impl<'a> Named<'a> {
    pub(crate) fn of(plan: &'a Plan, (scene, method, eye): ComparisonIndex) -> Self {
        let (scene, method) = (&plan.scenes[scene], &plan.methods[method]);
        Self { scene: &scene.name, method, eye: scene.eyes[eye].eye }
    }
}

/// A pair, scored or not, as soon as it is finished.
#[derive(Debug, Clone, Copy)]
pub struct Finished<'a> {
    /// The names that identify the pair.
    pub named: Named<'a>,
    /// Its index among the pairs of its view.
    pub step: usize,
    /// Its result.
    pub result: Result<&'a FrameResult, &'a Failure>,
    /// Which motion and depth the temporal differences used, if there are any differences.
    pub guides: GuideSources,
    /// Its maps, if they are requested.
    pub maps: &'a [Map],
    /// The test, if it was emulated and is to be kept.
    pub kept: Option<&'a Frame>,
    /// The regions that figures show.
    pub crops: &'a [CropPair],
    /// Its pictures, if the report shows them.
    pub pictures: Option<&'a PicturePair>,
    /// How the eye sees the frame, if there is a view.
    pub seen: Option<&'a Seen>,
}

/// An entry to be recorded.
#[derive(Debug, Clone, Copy)]
pub enum Entry<'a> {
    /// An input, when it is first read.
    Input(&'a Input),
    /// A pair.
    Pair(Finished<'a>),
    /// A pair before those to be scored that could not be compared. Later pairs are scored without
    /// it.
    Before(Named<'a>, &'a Failure),
    /// A comparison that could not be scored.
    Problem(Named<'a>, &'a Failure),
    /// A view that could not be scored.
    ViewFailed(&'a str, Option<Eye>, &'a Failure),
    /// A view that is finished, with the names of all methods.
    Settled(&'a str, Option<Eye>, &'a Settled, &'a [String]),
}

/// Records findings. An error ends the run.
pub type Record<'a> = dyn FnMut(Entry<'_>) -> Result<(), EngineError> + 'a;

impl Findings {
    /// How many pairs are finished.
    pub fn pairs(&self) -> usize {
        self.views.values().map(|view| view.pairs.len()).sum()
    }

    /// The pairs that were scored.
    pub fn scored<'a>(
        &'a self,
        plan: &'a Plan,
    ) -> impl Iterator<Item = (Named<'a>, &'a FrameResult)> {
        self.outcomes(plan)
            .filter_map(|(named, outcome)| Some((named, outcome.result.as_ref().ok()?)))
    }

    /// The failures among the items that were to be scored.
    pub fn failures<'a>(&'a self, plan: &'a Plan) -> Vec<(Named<'a>, &'a Failure)> {
        let views = self.views.iter().filter_map(|(&(scene, eye), view)| {
            let tests = plan.scenes[scene].eyes[eye].tests.iter();
            let named = tests.map(move |(method, _)| Named::of(plan, (scene, *method, eye)));
            Some(named.zip(std::iter::repeat(view.failed.as_ref()?)))
        });
        let pairs = self.outcomes(plan);
        let pairs =
            pairs.filter_map(|(named, outcome)| Some((named, outcome.result.as_ref().err()?)));
        views.flatten().chain(pairs).collect()
    }

    fn outcomes<'a>(&'a self, plan: &'a Plan) -> impl Iterator<Item = (Named<'a>, &'a Outcome)> {
        self.views.iter().flat_map(move |(&(scene, eye), view)| {
            let named = move |outcome: &Outcome| Named::of(plan, (scene, outcome.method, eye));
            view.pairs.values().map(move |outcome| (named(outcome), &**outcome))
        })
    }

    /// The findings about some units.
    pub(crate) fn of_units(&self, units: &[Unit]) -> Self {
        let mut part = Self::default();
        for Unit { scene, eye, pairs } in units {
            let Some(view) = self.views.get(&(*scene, *eye)) else { continue };
            let pairs = view.pairs.range(pairs.clone());
            let of_view = ViewFindings {
                pairs: pairs.map(|(index, outcome)| (*index, outcome.clone())).collect(),
                settled: view.settled.clone(),
                failed: view.failed.clone(),
                before: Vec::new(),
            };
            part.views.insert((*scene, *eye), of_view);
        }
        part
    }

    /// Records all findings again, in the order of a run.
    pub(crate) fn record(&self, plan: &Plan, record: &mut Record<'_>) -> Result<(), EngineError> {
        self.record_inputs(plan, record)?;
        self.record_views(plan, record)
    }

    /// Takes down what belongs to no frame.
    pub(crate) fn record_inputs(
        &self,
        plan: &Plan,
        record: &mut Record<'_>,
    ) -> Result<(), EngineError> {
        for (place, failure) in &self.problems {
            record(Entry::Problem(Named::of(plan, *place), failure))?;
        }
        for input in self.inputs.all() {
            record(Entry::Input(&input))?;
        }
        Ok(())
    }

    fn record_views(&self, plan: &Plan, record: &mut Record<'_>) -> Result<(), EngineError> {
        for (&(scene, eye), view) in &self.views {
            for (method, failure) in &view.before {
                record(Entry::Before(Named::of(plan, (scene, *method, eye)), failure))?;
            }
            for (&step, outcome) in &view.pairs {
                record(Entry::Pair(Finished {
                    named: Named::of(plan, (scene, outcome.method, eye)),
                    step,
                    result: outcome.result.as_ref(),
                    guides: outcome.guides,
                    maps: &[],
                    kept: None,
                    crops: &[],
                    pictures: None,
                    seen: None,
                }))?;
            }
            let (scene, eye) = (&plan.scenes[scene].name, plan.scenes[scene].eyes[eye].eye);
            if let Some(failure) = &view.failed {
                record(Entry::ViewFailed(scene, eye, failure))?;
            }
            if let Some(settled) = &view.settled {
                record(Entry::Settled(scene, eye, settled, &plan.methods))?;
            }
        }
        Ok(())
    }
}
