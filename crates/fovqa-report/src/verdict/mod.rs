//! Presents the verdict of a gate to people and CI systems: a table, Markdown, JUnit XML and
//! annotations.

mod annotations;
mod baseline;
mod junit;
mod markdown;
mod terminal;

pub use annotations::{github_annotations, gitlab_report, without_commands};
pub use baseline::{baseline_table, difference_table};
pub use junit::junit;
pub use markdown::markdown;
pub use terminal::verdict_table;

use std::fmt::Write as _;

use fovqa_results::{Check, Limit, State, Verdict};

/// A value in the short form that verdicts show. The margin shows on which side of a limit the
/// value is.
fn number(value: f64) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    let short = if value != 0.0 && value.abs() < 0.01 {
        format!("{value:.3e}")
    } else {
        format!("{value:.4}")
    };
    if short.parse::<f64>().is_ok_and(|back| back.to_bits() == value.to_bits()) {
        return value.to_string();
    }
    short
}

fn limit(limit: &Limit) -> String {
    format!("{} {}", if limit.at_least { "≥" } else { "≤" }, number(limit.value))
}

/// A margin with its sign. A margin that is too small for four digits is shown in full.
fn margin(limit: &Limit) -> String {
    let sign = if limit.margin >= 0.0 { "+" } else { "" };
    format!("{sign}{}", number(limit.margin))
}

/// Scene, method, eye and band of a check.
fn place(check: &Check) -> String {
    let (scene, method, eye) = &check.place;
    let parts = [scene, method, eye].into_iter().filter(|part| !part.is_empty());
    let band = check.band.map(|[from, to]| format!("{from}° to {to}°"));
    parts.cloned().chain(band).collect::<Vec<_>>().join(", ")
}

fn worst(check: &Check) -> String {
    check.worst.map(|(frame, value)| format!("{frame} ({})", number(value))).unwrap_or_default()
}

/// Describes a check in one sentence.
fn sentence(check: &Check) -> String {
    let mut text = place(check);
    if let Some(reason) = check.outcome.reason() {
        text.push_str(": ");
        text.push_str(reason);
    } else if let (Some(value), Some(bound)) = (check.value, &check.limit) {
        let (value, margin) = (number(value), margin(bound));
        let _ = write!(text, ": {value} {}, margin {margin}", limit(bound));
        if let Some(p) = check.p {
            let _ = write!(text, ", p = {}", number(p));
        }
    }
    if let Some((frame, value)) = check.worst {
        let _ = write!(text, "; worst frame {frame} with {}", number(value));
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
