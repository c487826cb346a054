//! The findings of several units, put together.

use fovqa_metrics::{Layouts, Metric};

use crate::findings::{Findings, Outcome, Settled, ViewFindings, ViewIndex};
use crate::unit::Unit;

impl Findings {
    /// Takes in what the units behind these have found.
    pub(crate) fn join(&mut self, next: Findings) {
        for (name, id) in next.inputs.iter() {
            self.inputs.add(name, id);
        }
        // Whoever finds the frames of a plan has all of these.
        self.problems = next.problems;
        for (place, mut view) in next.views {
            // Where they belong they have been scored, or have failed.
            view.before.clear();
            self.join_view(place, view);
        }
    }

    /// Takes in what the next unit of a view has found.
    pub(crate) fn join_view(&mut self, place: ViewIndex, next: ViewFindings) {
        join(self.views.entry(place).or_default(), next);
    }

    /// Whether all of a unit was scored, or has failed.
    pub(crate) fn has_all_of(&self, unit: &Unit) -> bool {
        self.views.get(&(unit.scene, unit.eye)).is_some_and(|view| {
            let through = view.settled.is_some() && view.pairs.len() == unit.pairs.len();
            view.failed.is_some() || through
        })
    }
}

/// Joins what the next unit has of a view to what those before it have.
fn join(all: &mut ViewFindings, mut next: ViewFindings) {
    all.failed = all.failed.take().or(next.failed);
    let Settled { fvvdp, missing, .. } = all.settled.take().unwrap_or_default();
    // A sequence that has not come through up to here has no values from here on.
    let broken = |outcome: &&mut Outcome| missing.contains_key(&outcome.method);
    let mut layouts = Layouts::default();
    for outcome in next.pairs.values_mut().filter(broken) {
        if let Ok(frame) = &mut outcome.result {
            let of_others = frame.rows.iter().filter(|row| row.key.metric() != Some(Metric::Fvvdp));
            frame.rows = layouts.pack(&of_others.collect());
        }
    }
    all.pairs.append(&mut next.pairs);
    all.before.append(&mut next.before);
    // The later one has looked for a pair to settle it from the first one on.
    all.settled = next.settled.map(|mut settled| {
        settled.fvvdp.extend(fvvdp);
        settled.missing.extend(missing);
        settled
    });
}
