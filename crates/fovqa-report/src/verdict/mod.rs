//! Presents the verdict of a gate to people and CI systems: a table, Markdown, JUnit XML and
//! annotations.

mod annotations;
mod baseline;
mod digits;
mod junit;
mod losses;
mod markdown;
mod terminal;

pub use annotations::{github_annotations, gitlab_report, without_commands};
pub use baseline::{baseline_table, difference_table};
pub use junit::junit;
pub use markdown::markdown;
pub use terminal::verdict_table;

use std::fmt::Write as _;

use fovqa_results::{Check, CheckRecord, Limit, LossRecord, State, Verdict, statistic_name};

use digits::{beside, number};

pub(crate) use losses::place as place_in_words;

/// Frames with a loss that a text tells about.
const MOST_LOSSES: usize = 3;

/// The value and the limit of a check, as they are shown; empty where there are none.
fn value_and_limit(check: &Check) -> [String; 2] {
    match (check.value, &check.limit) {
        (Some(value), Some(limit)) => {
            let sign = if limit.at_least { "≥" } else { "≤" };
            let [value, limit] = beside(value, limit.value);
            [value, format!("{sign} {limit}")]
        }
        (Some(value), None) => [number(value), String::new()],
        (None, _) => ["–".to_owned(), String::new()],
    }
}

/// A value and a limit as they are shown, as [`value_and_limit`] does for records.
pub(crate) fn shown(value: Option<f64>, limit: Option<f64>) -> [String; 2] {
    match (value, limit) {
        (Some(value), Some(limit)) => beside(value, limit),
        (Some(value), None) => [number(value), String::new()],
        (None, _) => ["–".to_owned(), String::new()],
    }
}

/// A margin with its sign. A margin that is too small for four digits is shown in full.
fn margin(limit: &Limit) -> String {
    let sign = if limit.margin >= 0.0 { "+" } else { "" };
    format!("{sign}{}", number(limit.margin))
}

/// Where the losses of a check are: a line for each frame, after those that fail.
fn where_lines(check: &Check) -> Vec<String> {
    let record = CheckRecord::from(check);
    let mut lines: Vec<String> = losses::frames(&record).into_iter().collect();
    lines.extend(record.losses.iter().take(MOST_LOSSES).map(|loss| losses::place(&record, loss)));
    if record.losses.len() > MOST_LOSSES {
        lines.push(format!("{} more frames with a loss", record.losses.len() - MOST_LOSSES));
    }
    lines.extend(losses::late(&record).map(str::to_owned));
    lines
}

/// Scene, method, eye and band of a check.
fn place(check: &Check) -> String {
    let (scene, method, eye) = &check.place;
    let parts = [scene, method, eye].into_iter().filter(|part| !part.is_empty());
    let band = check.band.map(|[from, to]| format!("{from}° to {to}°"));
    parts.cloned().chain(band).collect::<Vec<_>>().join(", ")
}

/// The frame that a reader looks at first: the one with the largest loss, or else the worst one.
fn worst(check: &Check) -> String {
    let loss = check.losses.first().filter(|_| check.frames.is_empty());
    if let Some(loss) = loss.filter(|loss| check.worst.is_none_or(|worst| worst.0 != loss.frame)) {
        let name = statistic_name(&loss.metric, &loss.statistic);
        return format!("{} ({name} {})", loss.frame, number(loss.value));
    }
    check.worst.map(|(frame, value)| format!("{frame} ({})", number(value))).unwrap_or_default()
}

/// Describes a check in one sentence.
fn sentence(check: &Check) -> String {
    let mut text = place(check);
    if let Some(reason) = check.outcome.reason() {
        text.push_str(": ");
        text.push_str(reason);
    } else if let (Some(_), Some(bound)) = (check.value, &check.limit) {
        let ([value, limit], margin) = (value_and_limit(check), margin(bound));
        let _ = write!(text, ": {value} {limit}, margin {margin}");
        if let Some(p) = check.p {
            let _ = write!(text, ", p = {}", number(p));
        }
    }
    match check.losses.first() {
        Some(loss) => {
            let record = CheckRecord::from(check);
            let _ = write!(text, "; {}", losses::place(&record, &LossRecord::from(loss)));
        }
        None => {
            if let Some((frame, value)) = check.worst {
                let _ = write!(text, "; worst frame {frame} with {}", number(value));
            }
        }
    }
    text
}

/// Describes the whole outcome in one sentence.
fn outcome(verdict: &Verdict) -> String {
    let rules = verdict.rules.len();
    let broken = verdict.rules.iter().filter(|rule| rule.state() == State::Failed).count();
    let of = |count: usize| if count == 1 { "1 rule".to_owned() } else { format!("{count} rules") };
    match verdict.state() {
        State::Passed => format!("{}: the gate holds ({})", verdict.experiment, of(rules)),
        State::Failed => {
            format!("{}: the gate fails: {} of {}", verdict.experiment, broken.max(1), of(rules))
        }
        State::NotScored => {
            format!("{}: no verdict: not everything could be scored", verdict.experiment)
        }
        State::Wrong => format!("{}: no verdict: a rule is wrong", verdict.experiment),
    }
}
