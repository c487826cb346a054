//! The verdict as Markdown, for a pull request.

use std::fmt::Write as _;

use fovqa_results::{Check, Loss, State, Verdict};

use super::{margin, outcome, place, value_and_limit, where_lines, worst};
use crate::comparison::escaped_markdown;
use crate::page::address;

/// A heading with the outcome, a table of all checks, and the reasons of those that did not pass.
pub fn markdown(verdict: &Verdict) -> String {
    let mark = |state: State| match state {
        State::Passed => "✅",
        State::Failed => "❌",
        State::NotScored | State::Wrong => "⚠️",
    };
    let state = verdict.state();
    let mut text = format!("### {} {}\n\n", mark(state), escaped_markdown(&outcome(verdict)));
    text.push_str("| | rule | scene, method | value | limit | margin | worst frame |\n");
    text.push_str("| --- | --- | --- | ---: | ---: | ---: | ---: |\n");
    for rule in &verdict.rules {
        let title = escaped_markdown(&rule.title());
        for check in &rule.checks {
            let [value, limit] = value_and_limit(check);
            let _ = writeln!(
                text,
                "| {} | {title} | {} | {value} | {limit} | {} | {} |",
                mark(check.outcome.state()),
                escaped_markdown(&place(check)),
                check.limit.as_ref().map(margin).unwrap_or_default(),
                worst(check),
            );
        }
        if let Some(why) = &rule.failure {
            let why = escaped_markdown(why);
            let _ = writeln!(text, "| {} | {title} | {why} | – | – | – | – |", mark(rule.state()));
        }
    }
    let mut lines = Vec::new();
    for check in verdict.rules.iter().flat_map(|rule| &rule.checks) {
        if let Some(why) = check.outcome.reason() {
            lines.push(escaped_markdown(&format!("{}: {why}", place(check))));
            let below = where_lines(check).into_iter();
            lines.extend(below.map(|line| format!("  {}", escaped_markdown(&line))));
            lines.extend(pictures(verdict, check));
        }
    }
    if let Some(baseline) = &verdict.baseline {
        let baseline = escaped_markdown(baseline);
        lines.push(format!("compared with {baseline}, the best match"));
    }
    let more = verdict.errors.iter().map(|error| format!("not scored: {error}"));
    let more = more.chain(verdict.notes.iter().cloned());
    lines.extend(more.map(|line| escaped_markdown(&line)));
    if !lines.is_empty() {
        text.push('\n');
    }
    for line in lines {
        let indent = line.len() - line.trim_start().len();
        let _ = writeln!(text, "{}- {}", &line[..indent], line.trim_start());
    }
    text
}

/// Links to the pictures of the frames with a loss.
fn pictures(verdict: &Verdict, check: &Check) -> Vec<String> {
    let Some(folder) = &verdict.shown_in else { return Vec::new() };
    let losses = check.losses.iter().filter(|loss| !loss.pictures.is_empty());
    let line = |loss: &Loss| {
        let links = loss.pictures.iter().map(|picture| {
            let address = address(&format!("{folder}/{}", picture.path));
            format!("[{}]({address})", escaped_markdown(&picture.what))
        });
        format!("  frame {}: {}", loss.frame, links.collect::<Vec<_>>().join(", "))
    };
    losses.map(line).collect()
}
