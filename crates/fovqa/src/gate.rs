//! A gate checks the values of a run against the rules of an experiment.

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, Given};
use fovqa_plan::{Experiment, GateRule, Resolved};
use fovqa_results::{Baseline, Verdict};

use crate::error::Error;
use crate::finish::text_hash;
use crate::finished_run::FinishedRun;
use crate::repeats::Repeats;
use crate::run::{Run, RunOptions};

/// Scores an experiment and checks the values against its rules and, if one is given, against a
/// baseline. `repeats` are the folders of further runs of the same build, for rules that test the spread
/// of repeated runs.
///
/// # Errors
/// If there are no rules, a rule needs a baseline and none is given, the values of the baseline
/// were computed under other conditions, or the run is not possible. Frames that could not be
/// scored are reported and are part of the verdict.
pub fn gate(
    experiment: Experiment,
    options: RunOptions,
    baseline: Option<&Path>,
    repeats: &[PathBuf],
    given: &Given,
    events: &dyn Events,
) -> Result<Verdict, Error> {
    let file = experiment.path.clone();
    check(&experiment.gates, &file, baseline)?;
    let run = Run::new(experiment, options, given)?;
    // The baseline is checked before anything is scored.
    let resolved = run.experiment().resolved();
    let baseline = fitting(baseline, &resolved)?;
    let repeats = Repeats::read(&run.folder(), repeats, &resolved, &resolved.gates)?;
    let scored = run.start(events)?;
    events.note(&scored.in_words());
    if let Some(errors) = scored.errors_in_words() {
        events.failure(&errors, "");
    }
    let mut finished = FinishedRun::read(&scored.folder)?;
    repeats.add_to(&mut finished.values)?;
    Ok(judge(&finished, &file.display().to_string(), baseline.as_ref()))
}

/// Checks the values of a finished run against its rules.
///
/// # Errors
/// See [`gate`]. It is also an error if the folder contains no finished run.
pub fn gate_folder(
    folder: &Path,
    baseline: Option<&Path>,
    repeats: &[PathBuf],
) -> Result<Verdict, Error> {
    let mut finished = FinishedRun::read(folder)?;
    let resolved = &finished.record.resolved;
    let file = folder.join(&finished.record.experiment.file);
    check(&resolved.gates, &file, baseline)?;
    let baseline = fitting(baseline, resolved)?;
    let repeats = Repeats::read(folder, repeats, resolved, &resolved.gates)?;
    repeats.add_to(&mut finished.values)?;
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
