//! The verdict as Markdown, for a pull request.

use std::fmt::Write as _;

use fovqa_results::{State, Verdict};

use super::{limit, margin, number, outcome, place, worst};
use crate::comparison::escaped_markdown;

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
            let bound = check.limit.as_ref();
            let _ = writeln!(
                text,
                "| {} | {title} | {} | {} | {} | {} | {} |",
                mark(check.outcome.state()),
                escaped_markdown(&place(check)),
                check.value.map_or_else(|| "–".to_owned(), number),
                bound.map(limit).unwrap_or_default(),
                bound.map(margin).unwrap_or_default(),
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
            lines.push(format!("{}: {why}", place(check)));
        }
    }
    lines.extend(verdict.errors.iter().map(|error| format!("not scored: {error}")));
    lines.extend(verdict.notes.iter().cloned());
    if !lines.is_empty() {
        text.push('\n');
    }
    for line in lines {
        let _ = writeln!(text, "- {}", escaped_markdown(&line));
    }
    text
}
