//! What is scored during a search: emulated methods with other values of the key that is varied.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

use fovqa_emulate::{Budget, EmulateError, EmulationSpec};
use fovqa_engine::{Events, FoundInputs, FoundView, Given, find};
use fovqa_metrics::Metric;
use fovqa_params::{ParamValue, Words};
use fovqa_plan::{Emulation, Experiment, EyeView, MetricChoice, Plan, SourceSpec};
use fovqa_results::RunValues;

use super::kept_source::{KeptFrames, KeptSource};
use super::options::LimitOptions;
use crate::error::Error;
use crate::run::problems;

/// A method in a scene whose limits are searched.
#[derive(Debug, Clone)]
pub(super) struct Target {
    /// Index of the scene.
    pub(super) scene: usize,
    /// Index of the method.
    pub(super) method: usize,
    /// The range of the search.
    pub(super) range: [f64; 2],
    /// The parameter that a budget solves.
    pub(super) parameter: Option<String>,
    /// Which samples a budget counts.
    pub(super) budget_of: Option<String>,
}

/// A target with a value of the key that is varied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Candidate {
    /// Index of the target.
    pub(super) target: usize,
    /// The value.
    pub(super) at: f64,
}

/// The values of a candidate.
pub(super) struct Scored {
    pub(super) scene: String,
    /// Its method in the plan that was scored.
    pub(super) label: String,
    pub(super) values: Arc<RunValues>,
    /// Why a frame could not be scored.
    pub(super) failure: Option<String>,
}

/// What is varied.
#[derive(Debug)]
pub(super) struct Varied {
    pub(super) targets: Vec<Target>,
}

impl Varied {
    /// Finds the methods that have what is varied.
    pub(super) fn new(experiment: &Experiment, options: &LimitOptions) -> Result<Self, Error> {
        let plan = &experiment.plan;
        for name in &options.methods {
            if !plan.methods.contains(name) {
                let message = format!("there is no method \"{name}\"");
                let help = format!("the methods are {}", plan.methods.join(", "));
                return Err(Error::usage(message, help));
            }
        }
        let mut targets = Vec::new();
        for (scene_index, scene) in plan.scenes.iter().enumerate() {
            for (method, name) in plan.methods.iter().enumerate() {
                if !options.methods.is_empty() && !options.methods.contains(name) {
                    continue;
                }
                let specs = scene.eyes.iter().filter_map(|eye| emulation(eye, method));
                let specs: Vec<&EmulationSpec> = specs.map(|of| &of.spec).collect();
                let Some(first) = specs.first() else { continue };
                if !specs.iter().all(|spec| has(spec, &options.vary)) {
                    continue;
                }
                let parameter = first.free_parameter().map(str::to_owned);
                let of = first.budget().map(|budget| budget.of).unwrap_or_default();
                let budget_of = Some(of.word().to_owned());
                let range = [0.0, 1.0];
                targets.push(Target { scene: scene_index, method, range, parameter, budget_of });
            }
        }
        if targets.is_empty() {
            let file = experiment.path.display();
            let message =
                format!("{file}: no method that is emulated has {} to vary", options.vary);
            let help = if options.vary == LimitOptions::BUDGET {
                "emulate a method such as rmfr: { model = \"rmfr\" }"
            } else {
                "--vary takes budget, or a number among the parameters of a method"
            };
            return Err(Error::usage(message, help));
        }
        Ok(Self { targets })
    }
}

/// Whether a method has something to vary.
fn has(spec: &EmulationSpec, vary: &str) -> bool {
    if vary == LimitOptions::BUDGET {
        return spec.free_parameter().is_some();
    }
    spec.parameters().iter().any(|(name, value)| name == vary && value.number().is_some())
}

fn emulation(eye: &EyeView, method: usize) -> Option<&Emulation> {
    match eye.tests.iter().find(|(index, _)| *index == method)? {
        (_, SourceSpec::Emulated(emulation)) => Some(emulation),
        _ => None,
    }
}

/// Sets what is varied.
fn set(spec: &mut EmulationSpec, vary: &str, at: f64) -> Result<(), EmulateError> {
    if vary == LimitOptions::BUDGET {
        let of = spec.budget().map(|budget| budget.of).unwrap_or_default();
        spec.free_budget(Budget { share: at, of })
    } else {
        spec.set(vary, &ParamValue::Number(at))
    }
}

/// Scores candidates. References are read once and kept.
pub(super) struct Scorer {
    /// What was found for the whole experiment.
    found: FoundInputs,
    kept: Arc<KeptFrames>,
    plan: Plan,
    vary: String,
    /// The warnings that were shown already.
    warned: RefCell<BTreeSet<String>>,
}

impl Scorer {
    pub(super) fn new(
        experiment: &Experiment,
        options: &LimitOptions,
        varied: &Varied,
    ) -> Result<Self, Error> {
        let mut plan = experiment.plan.clone();
        plan.frames = options.frames;
        plan.hash_inputs = false;
        plan.crops = Vec::new();
        let mut metrics: Vec<Metric> = Vec::new();
        for rule in &experiment.gates {
            let metric = Metric::find(&rule.quantity.metric);
            metrics.extend(metric.filter(|metric| !metrics.contains(metric)));
        }
        metrics.sort_unstable();
        plan.metrics = MetricChoice::Named(metrics);
        // Methods that are not varied are not scored.
        for (index, scene) in plan.scenes.iter_mut().enumerate() {
            let is_target = |method: usize| {
                varied.targets.iter().any(|of| (of.scene, of.method) == (index, method))
            };
            for eye in &mut scene.eyes {
                eye.tests.retain(|(method, _)| is_target(*method));
                for (_, test) in &mut eye.tests {
                    // The value that the file gives is replaced, so that it need not be possible.
                    if let SourceSpec::Emulated(emulation) = test {
                        emulation.keep_frames = false;
                        emulation.spec.clear_budget();
                    }
                }
            }
        }
        let found = find(&plan, &Given::default());
        let complaints = problems(&Experiment { plan: plan.clone(), ..experiment.clone() }, &found);
        if !complaints.is_empty() {
            let is_usage = found.problems.iter().any(|problem| problem.error.is_usage());
            return Err(if is_usage { Error::Usage(complaints) } else { Error::Input(complaints) });
        }
        if found.views.iter().any(|view| view.sources.reference.is_read_once()) {
            let message = "a stream can be read only once, but a search reads frames repeatedly";
            return Err(Error::usage(message, "write it to a file first"));
        }
        let warned = RefCell::default();
        Ok(Self { found, kept: Arc::default(), plan, vary: options.vary.clone(), warned })
    }

    /// The views of a target with the method that each emulates.
    pub(super) fn views_of<'a>(
        &'a self,
        experiment: &'a Experiment,
        target: &'a Target,
    ) -> impl Iterator<Item = (&'a FoundView, &'a EyeView, &'a EmulationSpec)> {
        let views = self.found.views.iter().filter(|view| view.scene == target.scene);
        views.filter_map(|view| {
            let eye = &experiment.plan.scenes[view.scene].eyes[view.eye];
            Some((view, eye, &emulation(eye, target.method)?.spec))
        })
    }

    /// Scores candidates in one pass over the frames. Each scored candidate has the values of the pass.
    pub(super) fn score(
        &self,
        targets: &[Target],
        candidates: &[Candidate],
        events: &dyn Events,
    ) -> Result<Vec<(Candidate, Scored)>, Error> {
        let mut plan = self.plan.clone();
        let label = |candidate: &Candidate| {
            let method = &self.plan.methods[targets[candidate.target].method];
            format!("{method} ({}={})", self.vary, candidate.at)
        };
        plan.methods = candidates.iter().map(label).collect();
        for (scene_index, scene) in plan.scenes.iter_mut().enumerate() {
            for eye in &mut scene.eyes {
                let own = std::mem::take(&mut eye.tests);
                for (index, candidate) in candidates.iter().enumerate() {
                    let target = &targets[candidate.target];
                    if target.scene != scene_index {
                        continue;
                    }
                    let base = own.iter().find(|(method, _)| *method == target.method);
                    let Some((_, SourceSpec::Emulated(base))) = base else { continue };
                    let mut emulation = base.clone();
                    set(&mut emulation.spec, &self.vary, candidate.at).map_err(|error| {
                        let help = "change --from and --to, or leave the method out with --method";
                        Error::usage(error.to_string(), help)
                    })?;
                    if let fovqa_plan::Reprojection::Takes(reproject) = &mut emulation.reprojection
                    {
                        // The dominant eye has the same value.
                        let _ = set(&mut reproject.spec, &self.vary, candidate.at);
                    }
                    eye.tests.push((index, SourceSpec::Emulated(emulation)));
                }
            }
        }
        let mut found = find(&plan, &Given::default());
        if let Some(problem) = found.problems.first() {
            let complaint = (problem.error.to_string(), problem.error.help());
            return Err(Error::usage(complaint.0, complaint.1));
        }
        for view in &mut found.views {
            let Some(number) = number_of(&self.found, view) else { continue };
            view.sources.reference = Arc::new(KeptSource {
                source: Arc::clone(&self.found.views[number].sources.reference),
                number,
                kept: Arc::clone(&self.kept),
            });
        }
        let quiet = Once { events, warned: &self.warned };
        let results = fovqa_engine::run(&plan, &found, &quiet, &mut |_| Ok(()))?;
        let values = Arc::new(RunValues::of_results(&results));
        let scored = candidates.iter().map(|candidate| {
            let scene = plan.scenes[targets[candidate.target].scene].name.clone();
            let label = label(candidate);
            let of =
                results.comparisons.iter().filter(|of| of.scene == scene && of.method == label);
            let failure = of.flat_map(|of| &of.report.failures).next();
            let failure = failure.map(|failure| failure.message.clone());
            (*candidate, Scored { scene, label, values: Arc::clone(&values), failure })
        });
        Ok(scored.collect())
    }
}

/// The index of the same view in what was found first.
fn number_of(found: &FoundInputs, view: &FoundView) -> Option<usize> {
    found.views.iter().position(|of| (of.scene, of.eye) == (view.scene, view.eye))
}

/// Passes each warning on once, although many passes give it.
struct Once<'a> {
    events: &'a dyn Events,
    warned: &'a RefCell<BTreeSet<String>>,
}

impl Events for Once<'_> {
    fn warn(&self, message: &str) {
        if self.warned.borrow_mut().insert(message.to_owned()) {
            self.events.warn(message);
        }
    }

    fn progress(&self, done: usize, total: usize) {
        self.events.progress(done, total);
    }
}
