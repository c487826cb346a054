//! A gate checks the values of a run against the rules of an experiment.

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, Given};
use fovqa_plan::{Experiment, GateRule, Resolved};
use fovqa_results::{Baseline, Calibration, Lacking, Verdict, calibrate as proposals};

use crate::error::Error;
use crate::finish::text_hash;
use crate::finished_run::FinishedRun;
use crate::run::{Run, RunOptions};

/// Scores an experiment and checks the values against its rules and, if one is given, against a
/// baseline. `file` is the name of the experiment file in the verdict.
///
/// # Errors
/// If there are no rules, a rule needs a baseline and none is given, the values of the baseline
/// were computed under other conditions, or the run is not possible. Frames that could not be
/// scored are reported and are part of the verdict.
pub fn gate(
    experiment: Experiment,
    options: RunOptions,
    baseline: Option<&Path>,
    given: &Given,
    events: &dyn Events,
) -> Result<Verdict, Error> {
    let file = experiment.path.clone();
    check(&experiment.gates, &file, baseline)?;
    let run = Run::new(experiment, options, given)?;
    // The baseline is checked before anything is scored.
    let baseline = fitting(baseline, &run.experiment().resolved())?;
    let scored = run.start(events)?;
    events.note(&scored.in_words());
    if let Some(errors) = scored.errors_in_words() {
        events.failure(&errors, "");
    }
    let finished = FinishedRun::read(&scored.folder)?;
    Ok(judge(&finished, &file.display().to_string(), baseline.as_ref()))
}

/// Checks the values of a finished run against its rules.
///
/// # Errors
/// See [`gate`]. It is also an error if the folder contains no finished run.
pub fn gate_folder(folder: &Path, baseline: Option<&Path>) -> Result<Verdict, Error> {
    let finished = FinishedRun::read(folder)?;
    let resolved = &finished.record.resolved;
    let file = folder.join(&finished.record.experiment.file);
    check(&resolved.gates, &file, baseline)?;
    let baseline = fitting(baseline, resolved)?;
    Ok(judge(&finished, &finished.record.experiment.file, baseline.as_ref()))
}

fn judge(finished: &FinishedRun, file: &str, baseline: Option<&Baseline>) -> Verdict {
    let resolved = &finished.record.resolved;
    let names = (resolved.name.as_str(), file);
    let mut verdict = Verdict::of(names, &resolved.gates, &finished.values, baseline);
    verdict.notes.extend(finished.warning.clone());
    if let Some(baseline) = baseline {
        let other = baseline.other_inputs(&finished.record, &text_hash).into_iter();
        verdict.notes.extend(other.map(|folder| {
            let folder = if folder.is_empty() { ".".to_owned() } else { folder };
            format!("the inputs in {folder} differ from those of the baseline")
        }));
    }
    verdict
}

/// Checks that there are rules, and that a baseline is given if they need one.
fn check(rules: &[GateRule], file: &Path, baseline: Option<&Path>) -> Result<(), Error> {
    let file = file.display();
    if rules.is_empty() {
        let message =
            format!("{file}: it has no [[gate]] rule, and a gate without rules cannot pass");
        let help = "write a rule, such as metric = \"psnr\" with at_least = 30";
        return Err(Error::usage(message, help));
    }
    if let Some(rule) = rules.iter().find(|rule| rule.needs_baseline())
        && baseline.is_none()
    {
        let message =
            format!("{file}:{}: the rule for {} needs a baseline", rule.line, rule.quantity);
        let help = "give one with {baseline}; `fovqa baseline save` makes one";
        return Err(Error::usage(message, help));
    }
    Ok(())
}

/// Reads the baseline, if one is given, and checks that it fits the run.
fn fitting(path: Option<&Path>, run: &Resolved) -> Result<Option<Baseline>, Error> {
    let Some(path) = path else { return Ok(None) };
    let baseline = Baseline::read(path).map_err(|error| {
        Error::input(error.to_string(), "`fovqa baseline save` makes a baseline from a run")
    })?;
    let Some(why) = baseline.refuses(run) else { return Ok(Some(baseline)) };
    let file = path.display();
    let message = format!("{file}: the baseline's values were measured differently: {why}");
    let help = "run the experiment, look at the results, and update the baseline with `fovqa baseline accept`";
    Err(Error::input(message, help))
}

/// Proposes limits for the rules of an experiment, from the variation between repeated runs of one
/// build.
///
/// # Errors
/// If there are fewer than two runs, or they belong to another experiment, or contain no values
/// that the rules apply to.
pub fn calibrate(experiment: &Experiment, folders: &[PathBuf]) -> Result<Calibration, Error> {
    if experiment.gates.is_empty() {
        let message = format!("{}: it has no [[gate]] rule", experiment.path.display());
        let help = "add a [[gate]] rule with a metric and any limit";
        return Err(Error::usage(message, help));
    }
    if folders.len() < 2 {
        let message = "a single run does not show how values vary";
        return Err(Error::usage(message, "give the folders of several runs of one build"));
    }
    let resolved = experiment.resolved();
    let mut runs = Vec::new();
    for folder in folders {
        let run = FinishedRun::read(folder)?;
        let other = run.record.resolved.differs(&resolved);
        if let Some(why) = other.or_else(|| run.values.errors.first().cloned()) {
            let message = format!("{}: this run gives no limits: {why}", folder.display());
            return Err(Error::input(message, "run the experiment again"));
        }
        runs.push((folder.display().to_string(), run.values));
    }
    let calibration = proposals(&experiment.gates, &runs).map_err(|lacking| {
        let (message, help) =
            (lacking.to_string(), "correct the rule, or run the experiment again");
        if matches!(lacking, Lacking::Band(_)) {
            Error::usage(message, help)
        } else {
            Error::input(message, help)
        }
    })?;
    if calibration.proposals.is_empty() {
        return Err(Error::input("the rules apply to nothing in these runs", "check the rules"));
    }
    Ok(calibration)
}
