//! Joins the findings of several units.

use std::sync::Arc;

use fovqa_metrics::{Layouts, Metric};

use crate::findings::{Findings, Outcome, Settled, ViewFindings, ViewIndex};
use crate::unit::Unit;

impl Findings {
    /// Removes from the findings of the next units what has no value because of these findings. Returns
    /// whether there was anything. `values` keeps the others.
    pub(crate) fn break_off(&self, next: &mut Findings, values: &mut Layouts) -> bool {
        let mut has_changed = false;
        for (place, next) in &mut next.views {
            if let Some(settled) = self.views.get(place).and_then(|view| view.settled.as_ref()) {
                has_changed |= break_off(settled, next, values);
            }
        }
        has_changed
    }

    /// Adds the findings of the next units.
    pub(crate) fn join(&mut self, next: Findings) {
        for (name, id) in next.inputs.iter() {
            self.inputs.add(Arc::clone(name), id.clone());
        }
        // Every unit finds the frames of the whole plan, so each has all of these problems.
        self.problems = next.problems;
        for (place, mut view) in next.views {
            // These pairs were scored, or have failed, in the unit that they belong to.
            view.before.clear();
            self.join_view(place, view);
        }
    }

    /// Adds the findings of the next unit of a view.
    pub(crate) fn join_view(&mut self, place: ViewIndex, next: ViewFindings) {
        join(self.views.entry(place).or_default(), next);
    }

    /// Whether every pair of a unit was scored, has failed, or was passed over because a source ended before it.
    pub(crate) fn has_all_of(&self, unit: &Unit) -> bool {
        self.views.get(&(unit.scene, unit.eye)).is_some_and(|view| {
            // A source that continues after its last pair has one outcome more than there are pairs.
            let pairs = view.pairs.range(unit.pairs.clone()).count();
            let through = view.settled.as_ref();
            let through = through.is_some_and(|s| pairs + s.passed_over == unit.pairs.len());
            view.failed.is_some() || through
        })
    }
}

/// Removes the values of FovVideoVDP of sequences that were interrupted before this unit: they have no
/// values from there on. Returns whether there were any.
fn break_off(before: &Settled, next: &mut ViewFindings, values: &mut Layouts) -> bool {
    let broken = |outcome: &&mut Box<Outcome>| before.missing.contains_key(&outcome.method);
    let mut has_changed = false;
    for outcome in next.pairs.values_mut().filter(broken) {
        let Ok(frame) = &mut outcome.result else { continue };
        if frame.rows.has(Metric::Fvvdp) {
            let of_others = frame.rows.iter().filter(|row| row.key.metric() != Some(Metric::Fvvdp));
            frame.rows = values.pack(&of_others.collect());
            has_changed = true;
        }
    }
    has_changed
}

/// Joins the findings of the next unit of a view to those of the units before it.
fn join(all: &mut ViewFindings, mut next: ViewFindings) {
    all.failed = all.failed.take().or(next.failed.take());
    let before = all.settled.take().unwrap_or_default();
    break_off(&before, &mut next, &mut Layouts::default());
    let Settled { fvvdp, missing, passed_over, .. } = before;
    all.pairs.append(&mut next.pairs);
    all.before.append(&mut next.before);
    // The later unit searched from the first pair for the pair that settles the view.
    all.settled = next.settled.map(|mut settled| {
        settled.fvvdp.extend(fvvdp);
        settled.missing.extend(missing);
        settled.passed_over += passed_over;
        settled
    });
}
