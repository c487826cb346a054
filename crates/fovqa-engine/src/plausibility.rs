//! Looks for mistakes in the pairs of a view, and in the kinds of its files.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_frame::{Mask, SignalTables};
use fovqa_params::Words;
use fovqa_plan::Plan;
use fovqa_plausibility::{Check, FileKind, Looked, Plausibility, Suspicion, glance, look};
use fovqa_results::Doubt;

use crate::events::Warnings;
use crate::found::FoundView;
use crate::load::{Fault, Side, Step};

/// Of the frames of a sequence, each of this many is looked at closely, from the first one on: a mistake is
/// seldom in one frame alone. If suspected pairs are not scored, all are looked at.
const EVERY: usize = 16;

/// What is known of a pair when it is looked at.
pub(crate) struct Seen<'a> {
    pub(crate) reference: &'a Side,
    pub(crate) test: &'a Side,
    pub(crate) tables: &'a SignalTables,
    /// The pixels that count; `None` means all.
    pub(crate) counts: Option<&'a Mask>,
    /// The gaze, if there is a view.
    pub(crate) gaze_px: Option<[f64; 2]>,
}

/// The checks of a view.
pub(crate) struct Checks<'a> {
    plan: &'a Plan,
    policy: Plausibility,
    /// Suspicions about the files of whole methods, by the index of the method.
    of_methods: BTreeMap<usize, Suspicion>,
}

impl<'a> Checks<'a> {
    pub(crate) fn new(plan: &'a Plan, view: &FoundView) -> Self {
        let settings = &plan.scenes[view.scene].eyes[view.eye].settings;
        Self { plan, policy: settings.plausibility, of_methods: of_kinds(plan, view) }
    }

    /// Leaves out what [`Checks::foresee`] reports.
    pub(crate) fn forget_methods(&mut self) {
        self.of_methods.clear();
    }

    /// Whether a pair that is suspected cannot be scored.
    pub(crate) fn refuses(&self) -> bool {
        self.policy == Plausibility::Error
    }

    /// Looks at a pair. Emulated tests are made from the reference, and need no look.
    ///
    /// # Errors
    /// If the pair is suspected, and is therefore not to be scored.
    pub(crate) fn look(
        &self,
        step: &Step<'_>,
        seen: &Seen<'_>,
        warnings: &mut Warnings<'_>,
    ) -> Result<Vec<Doubt>, Fault> {
        if self.policy == Plausibility::Off || seen.test.made.is_some() {
            return Ok(Vec::new());
        }
        let pair = Looked {
            reference: &seen.reference.frame,
            test: &seen.test.frame,
            tables: seen.tables,
            counts: seen.counts,
            gaze_px: seen.gaze_px,
        };
        let closely = self.refuses() || step.frame.is_multiple_of(EVERY);
        let mut suspicions = if closely { look(&pair) } else { glance(&pair) };
        suspicions.extend(self.of_methods.get(&step.method).cloned());
        let file = &seen.test.file;
        if self.refuses() {
            let Some(first) = suspicions.first() else { return Ok(Vec::new()) };
            let messages: Vec<&str> = suspicions.iter().map(|s| s.message.as_str()).collect();
            return Err(Fault {
                message: format!("{file}: {}", messages.join("; ")),
                help: format!("{}; {{plausibility=warn}} scores it nevertheless", first.help),
            });
        }
        for Suspicion { check, message, help } in &suspicions {
            let key = format!("{} {}", check.word(), self.plan.methods[step.method]);
            warnings.once_a_view(&key, &format!("{file}: {message}; {help}"));
        }
        let doubt = |Suspicion { check, message, .. }: Suspicion| Doubt {
            check: check.word().to_owned(),
            message,
        };
        Ok(suspicions.into_iter().map(doubt).collect())
    }

    /// Reports what the names of the files tell already.
    pub(crate) fn foresee(&self, warnings: &mut Warnings<'_>) {
        if self.policy == Plausibility::Off {
            return;
        }
        for (method, Suspicion { check, message, help }) in &self.of_methods {
            let method = &self.plan.methods[*method];
            let key = format!("{} {method}", check.word());
            warnings.once_a_view(&key, &format!("{method}: {message}; {help}"));
        }
    }
}

/// The methods whose files lose another amount of quality than those they are compared with.
fn of_kinds(plan: &Plan, view: &FoundView) -> BTreeMap<usize, Suspicion> {
    let first = |listing: &fovqa_frame::source::Listing| {
        FileKind::of(listing.entries().first().map_or(listing.argument.as_str(), |e| &e.name))
    };
    let reference = first(view.sources.reference.listing());
    let tests = view.sources.tests.iter();
    let kinds: BTreeMap<usize, FileKind> =
        tests.filter_map(|(method, test)| Some((*method, first(test.read()?.listing())))).collect();
    let present: BTreeSet<FileKind> = kinds.values().copied().collect();
    let mut suspicions = BTreeMap::new();
    for (method, kind) in &kinds {
        let others = |other: FileKind| {
            let names = kinds.iter().filter(|(_, kind)| **kind == other);
            let names: Vec<&str> =
                names.map(|(method, _)| plan.methods[*method].as_str()).collect();
            match names.as_slice() {
                [] => String::new(),
                [one] => format!(" of {one}"),
                [one, more @ ..] => format!(" of {one} and {} more", more.len()),
            }
        };
        let (message, help) = if *kind == FileKind::Jpeg && reference != FileKind::Jpeg {
            let message = format!(
                "the tests are {kind}, but the reference is {reference}: the loss of JPEG is measured too"
            );
            (message, "write the tests without loss, as PNG or OpenEXR")
        } else {
            // The kind of the reference, or else of the first method, is taken to be the right one.
            let right = if present.contains(&reference) {
                reference
            } else {
                kinds.values().next().copied().unwrap_or(reference)
            };
            if *kind == right {
                continue;
            }
            let message = format!(
                "the tests are {kind}, but those{} are {right}: their values are not comparable",
                others(right)
            );
            (message, "write the files of all methods in the same format, from the same values")
        };
        let suspicion = Suspicion { check: Check::Format, message, help: help.to_owned() };
        suspicions.insert(*method, suspicion);
    }
    suspicions
}
