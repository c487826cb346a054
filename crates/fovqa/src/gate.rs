//! A gate checks the values of a run against the rules of an experiment, and shows where it got worse.

mod baselines;
pub(crate) mod clear;
mod locate;
mod places;
mod sheets;

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, FoundInputs, Given, Locking, ResultsFolder};
use fovqa_plan::{Experiment, GateRule, Plan};
use fovqa_results::{CheckRecord, GATE, Verdict, VerdictRecord, keep_verdict, kept_verdict};

use crate::error::Error;
use crate::finish::{in_folder, text_hash};
use crate::finished_run::FinishedRun;
use crate::reopened::{ExperimentFile, KnownInputs, reopen};
use crate::repeats::Repeats;
use crate::run::{Run, RunOptions};
use baselines::{Baselines, Named};
use locate::{Site, locate};

use clear::clear_gate;

/// What a gate compares a run with.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Against {
    /// The baselines, of which the best match counts; if there are none, those that the experiment names.
    pub baselines: Vec<PathBuf>,
    /// The folders of further runs of the same build, for rules that test the spread of repeated runs.
    pub repeats: Vec<PathBuf>,
}

/// Scores an experiment and checks the values against its rules and, if there are any, against baselines.
/// The verdict is kept in the results folder, with pictures of the frames that failed rules point at, and
/// is the first part of the page. The name of the experiment file in the verdict is that of the experiment.
///
/// # Errors
/// If there are no rules, a rule needs a baseline and none is given, the values of no baseline were
/// computed under the same conditions, or the run is not possible. Frames that could not be scored are
/// reported and are part of the verdict.
pub fn gate(
    experiment: Experiment,
    options: RunOptions,
    against: &Against,
    given: &Given,
    events: &dyn Events,
) -> Result<Verdict, Error> {
    let file = experiment.path.clone();
    let baselines = match against.baselines.as_slice() {
        [] => experiment.baselines.clone(),
        given => given.to_vec(),
    };
    check(&experiment.gates, &file, &baselines)?;
    let run = Run::new(experiment, options, given)?;
    // The baselines are checked before anything is scored.
    let resolved = run.experiment().resolved();
    let baselines = Baselines::read(&baselines, &resolved)?;
    let repeats = Repeats::read(&run.folder(), &against.repeats, &resolved, &resolved.gates)?;
    let mut repeats = Some(repeats);
    let plan = run.experiment().plan.clone();
    let mut verdict = None;
    let scored = run.start_judged(events, &mut |folder| {
        let mut finished = FinishedRun::read(folder.path())?;
        if let Some(repeats) = repeats.take() {
            repeats.add_to(&mut finished.values)?;
        }
        let (judged, named) = judge(&finished, &file.display().to_string(), &baselines);
        let found = || Ok((plan.clone(), fovqa_engine::find(&plan, given), None));
        verdict = Some(show(judged, named, folder, found, events));
        Ok(())
    })?;
    events.note(&scored.in_words());
    if let Some(errors) = scored.errors_in_words() {
        events.failure(&errors, "");
    }
    verdict.ok_or_else(|| Error::input("the run has no results", "run the experiment again"))
}

/// Checks the values of a finished run against its rules, and adds the verdict to its folder as [`gate`]
/// does. If the folder cannot be written to, the verdict is only returned, and a warning says so. The baselines
/// that the experiment names are only known if its file is found as it was.
///
/// # Errors
/// See [`gate`]. It is also an error if the folder contains no finished run.
pub fn gate_folder(
    folder: &Path,
    against: &Against,
    locking: Locking,
    events: &dyn Events,
) -> Result<Verdict, Error> {
    let mut finished = FinishedRun::read(folder)?;
    let resolved = &finished.record.resolved;
    let file = folder.join(&finished.record.experiment.file);
    let again = |beside| reopen(folder, &finished.record, ExperimentFile::Beside(beside));
    let named = || again(&[]).ok().map(|run| run.experiment.baselines);
    let baselines = match against.baselines.as_slice() {
        [] => named().unwrap_or_default(),
        given => given.to_vec(),
    };
    check(&resolved.gates, &file, &baselines)?;
    let baselines = Baselines::read(&baselines, resolved)?;
    let repeats = Repeats::read(folder, &against.repeats, resolved, &resolved.gates)?;
    repeats.add_to(&mut finished.values)?;
    let (verdict, named) = judge(&finished, &finished.record.experiment.file, &baselines);
    let opened = match ResultsFolder::open(folder, locking) {
        Ok(opened) => opened,
        Err(error) => {
            let error = in_folder(&error);
            events.warn(&format!("the verdict is not added to the page: {error}"));
            return Ok(verdict);
        }
    };
    let found = || {
        let run = again(&against.baselines)?;
        Ok((run.experiment.plan, run.found, Some(KnownInputs::of(&finished.record))))
    };
    let verdict = show(verdict, named, &opened, found, events);
    match fovqa_report::draw(folder, &|what, items| events.step(what, items)) {
        Ok(drawn) => drawn.warnings.iter().for_each(|warning| events.warn(warning)),
        Err(error) => events.warn(&format!("the verdict is not added to the page: {error}")),
    }
    Ok(verdict)
}

fn judge<'a>(
    finished: &FinishedRun,
    file: &str,
    baselines: &'a Baselines,
) -> (Verdict, Option<&'a Named>) {
    let resolved = &finished.record.resolved;
    let (mut verdict, named) = baselines.judge(resolved, file, &finished.values);
    verdict.notes.extend(finished.warning.clone());
    if let Some(named) = named {
        let other = named.baseline.other_inputs(&finished.record, &text_hash).into_iter();
        verdict.notes.extend(other.map(|folder| {
            let folder = if folder.is_empty() { ".".to_owned() } else { folder };
            format!("the inputs in {folder} differ from those of the baseline")
        }));
    }
    (verdict, named)
}

/// The plan of a run, its frames and, if it was scored before, its inputs as they were.
type Inputs = (Plan, FoundInputs, Option<KnownInputs>);

/// Looks at the frames that a verdict names, and keeps it with its pictures in the results folder. What
/// cannot be looked at or written is reported: the verdict does not depend on it. Pictures of an earlier
/// verdict that names the same frames stay if the frames cannot be read again.
fn show(
    mut verdict: Verdict,
    named: Option<&Named>,
    folder: &ResultsFolder,
    found: impl FnOnce() -> Result<Inputs, Error>,
    events: &dyn Events,
) -> Verdict {
    let results = folder.path();
    if results.join(GATE).is_symlink() {
        let message = "it is a link, and nothing is written through it";
        events.warn(&format!("{}: {message}", results.join(GATE).display()));
        return verdict;
    }
    let earlier = kept_verdict(results).ok().flatten();
    let checks = verdict.rules.iter().flat_map(|rule| &rule.checks);
    if checks.flat_map(|check| &check.losses).next().is_none() {
        clear_gate(results);
    } else {
        let good = named.map_or(Ok(None), Named::frames).unwrap_or_else(|why| {
            events.warn(&why);
            None
        });
        match found() {
            Ok((plan, found, known)) => {
                clear_gate(results);
                let (plan, found, known) = (&plan, &found, known.as_ref());
                let site = Site { plan, found, results, good: good.as_ref(), known };
                let located = locate(&mut verdict, &site);
                verdict.shown_in = Some(results.display().to_string());
                match located {
                    Ok(true) => {}
                    Ok(false) => events.note("only the first frames with a loss are looked at"),
                    Err(error) => {
                        events.warn(&format!("frames with a loss are not shown: {error}"));
                    }
                }
            }
            Err(error) => {
                events.warn(&format!("frames with a loss are not looked at again: {error}"));
                let restored = earlier.is_some_and(|earlier| restore(&mut verdict, &earlier));
                if restored {
                    verdict.shown_in = Some(results.display().to_string());
                } else {
                    clear_gate(results);
                }
            }
        }
    }
    if let Err(error) = keep_verdict(results, &verdict) {
        events.warn(&format!("the verdict is not added to the page: {error}"));
    }
    verdict
}

/// Takes places and pictures from an earlier verdict of the same values. Whether there were any.
fn restore(verdict: &mut Verdict, earlier: &VerdictRecord) -> bool {
    let mut restored = false;
    for rule in &mut verdict.rules {
        let title = rule.title();
        for check in &mut rule.checks {
            let now = CheckRecord::from(&*check);
            let of_rule = earlier.rules.iter().filter(|rule| rule.title == title);
            let same = of_rule.flat_map(|rule| &rule.checks).find(|was| {
                (&was.scene, &was.method, &was.eye) == (&now.scene, &now.method, &now.eye)
                    && (was.value, was.limit, was.band_deg.map(|band| band.map(f64::to_bits)))
                        == (now.value, now.limit, now.band_deg.map(|band| band.map(f64::to_bits)))
            });
            for loss in &mut check.losses {
                let was = same.and_then(|was| {
                    was.losses.iter().find(|was| was.frame == loss.frame && was.eye == loss.eye)
                });
                if let Some(was) = was {
                    restored |= loss.restore(was);
                }
            }
        }
    }
    restored
}

/// Checks that there are rules, and that a baseline is given if they need one.
fn check(rules: &[GateRule], file: &Path, baselines: &[PathBuf]) -> Result<(), Error> {
    let file = file.display();
    if rules.is_empty() {
        let message =
            format!("{file}: it has no [[gate]] rule, and a gate without rules cannot pass");
        let help = "write a rule, such as metric = \"psnr\" with at_least = 30";
        return Err(Error::usage(message, help));
    }
    if let Some(rule) = rules.iter().find(|rule| rule.needs_baseline())
        && baselines.is_empty()
    {
        let message =
            format!("{file}:{}: the rule for {} needs a baseline", rule.line, rule.quantity);
        let help = "give one with {baseline}, or name it in the experiment: baseline = \"nightly.baseline.json\"; `fovqa baseline save` makes one";
        return Err(Error::usage(message, help));
    }
    Ok(())
}
