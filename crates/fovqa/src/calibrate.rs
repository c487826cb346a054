//! Proposes limits for the rules of an experiment from repeated runs of one build.

use std::path::PathBuf;

use fovqa_plan::{Experiment, GateRule};
use fovqa_results::{Calibration, Lacking, calibrate as proposals};

use crate::calibrated_rules::marked_rules;
use crate::error::Error;
use crate::finished_run::FinishedRun;

/// Proposes limits for the rules of an experiment, from the variation between repeated runs of one
/// build. `false_alarms` is the probability that a new run of this build fails any of the limits, above
/// 0 and at most 0.5.
///
/// Rules that [`write_limits`](crate::write_limits) has written get no new limits, unless there are no
/// others.
///
/// # Errors
/// If there are fewer than two runs, or they belong to another experiment, or contain no values
/// that the rules apply to, or `false_alarms` is outside of its range.
pub fn calibrate(
    experiment: &Experiment,
    folders: &[PathBuf],
    false_alarms: f64,
) -> Result<Calibration, Error> {
    if experiment.gates.is_empty() {
        let message = format!("{}: it has no [[gate]] rule", experiment.path.display());
        let help = "add a [[gate]] rule with a metric and any limit";
        return Err(Error::usage(message, help));
    }
    if folders.len() < 2 {
        let message = "a single run does not show how values vary";
        return Err(Error::usage(message, "give the folders of several runs of one build"));
    }
    if !(false_alarms > 0.0 && false_alarms <= 0.5) {
        let message = format!("the rate of false alarms cannot be {false_alarms}");
        return Err(Error::usage(message, "give a number above 0 and at most 0.5"));
    }
    let rules: Vec<GateRule> =
        templates(experiment)?.into_iter().filter(|rule| rule.spread.is_none()).collect();
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
    let calibration = proposals(&rules, &runs, false_alarms).map_err(|lacking| {
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

/// The rules that get limits: those that no calibration has written, or all if there are no others.
fn templates(experiment: &Experiment) -> Result<Vec<GateRule>, Error> {
    let marked = marked_rules(experiment)?;
    let written =
        |rule: &&GateRule| marked.as_ref().is_some_and(|lines| lines.contains(&rule.line));
    let own = experiment.gates.iter().filter(|rule| !written(rule));
    let own: Vec<GateRule> = own.cloned().collect();
    Ok(if own.is_empty() { experiment.gates.clone() } else { own })
}
