//! Scores single frames again, for their pictures and maps.

use std::collections::BTreeSet;
use std::ops::Range;

use fovqa_engine::{EngineError, Entry, Events, Findings, FoundInputs, FoundView, Named, Unit};
use fovqa_metrics::Metric;
use fovqa_plan::{FrameChoice, MetricChoice, Plan, WantedPictures};

/// Pairs of a run that are scored again.
pub(crate) struct Again<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) found: &'a FoundInputs,
    /// The metrics whose maps are made.
    pub(crate) mapped: &'a [Metric],
    /// Whether the inputs are hashed again.
    pub(crate) hash_inputs: bool,
}

impl Again<'_> {
    /// Scores the pairs for which `is_wanted` holds, and hands each over with its pictures and maps.
    /// Pairs before them are scored as well where something is filtered over time.
    pub(crate) fn score(
        &self,
        is_wanted: &dyn Fn(Named<'_>, i64) -> bool,
        write: &mut dyn FnMut(Entry<'_>) -> Result<(), EngineError>,
    ) -> Result<(), EngineError> {
        let (units, frames) = self.wanted(is_wanted);
        if units.is_empty() {
            return Ok(());
        }
        let plan = self.plan_of(frames);
        let none = Findings::default();
        fovqa_engine::score(&plan, self.found, &units, none, &Silent, write).map(|_| ())
    }

    /// The wanted pairs as units of work, and their frames.
    fn wanted(&self, is_wanted: &dyn Fn(Named<'_>, i64) -> bool) -> (Vec<Unit>, BTreeSet<i64>) {
        let (mut units, mut frames) = (Vec::new(), BTreeSet::new());
        for view in &self.found.views {
            let scene = &self.plan.scenes[view.scene];
            let eye = scene.eyes[view.eye].eye;
            let ranges = ranges(view, |frame, method| {
                let method = self.plan.methods[method].as_str();
                let is_wanted = is_wanted(Named { scene: &scene.name, method, eye }, frame);
                if is_wanted {
                    frames.insert(frame);
                }
                is_wanted
            });
            let unit = |pairs| Unit { scene: view.scene, eye: view.eye, pairs };
            units.extend(ranges.into_iter().map(unit));
        }
        (units, frames)
    }

    fn plan_of(&self, frames: BTreeSet<i64>) -> Plan {
        let metrics = if self.mapped.is_empty() {
            // Something has to be scored; without maps, it is the cheapest.
            vec![Metric::Mse]
        } else {
            self.mapped.to_vec()
        };
        Plan {
            metrics: MetricChoice::Named(metrics),
            maps: false,
            hash_inputs: self.hash_inputs,
            crops: Vec::new(),
            pictures: WantedPictures {
                frames: frames.into_iter().map(FrameChoice::Number).collect(),
                methods: (0..self.plan.methods.len()).collect(),
            },
            ..self.plan.clone()
        }
    }
}

/// The ranges of the pairs of a view for which `is_wanted` holds. A range does not go beyond a frame.
fn ranges(view: &FoundView, mut is_wanted: impl FnMut(i64, usize) -> bool) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    let mut pair = 0;
    for frame in &view.frames {
        let first = pair;
        for (method, _) in &frame.tests {
            if is_wanted(frame.number, *method) {
                match ranges.last_mut() {
                    Some(range) if range.end == pair && range.start >= first => range.end += 1,
                    _ => ranges.push(pair..pair + 1),
                }
            }
            pair += 1;
        }
    }
    ranges
}

/// Reports nothing: everything was reported while the frames were scored.
struct Silent;

impl Events for Silent {
    fn warn(&self, _message: &str) {}

    fn progress(&self, _done: usize, _total: usize) {}
}
