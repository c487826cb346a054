//! The verdict in formats that CI systems show beside the line of the rule in the experiment file.

use std::fmt::Write as _;

use fovqa_results::{RuleVerdict, State, Verdict};
use serde_json::json;

use super::{place, sentence};
use crate::text_table::printable;

/// Text that a GitHub job shows but does not execute. There, a line that begins with `::` or
/// contains `##[` is a command.
pub fn without_commands(text: &str) -> String {
    let lines = text.split_inclusive('\n').map(|line| {
        let behind = line.trim_start();
        let space = &line[..line.len() - behind.len()];
        let guard = if behind.starts_with("::") { "\\" } else { "" };
        format!("{space}{guard}{}", behind.replace("##[", "##\\["))
    });
    lines.collect()
}

/// Workflow commands of GitHub, with one line per check that did not pass.
pub fn github_annotations(verdict: &Verdict) -> String {
    let mut text = String::new();
    let mut say = |line: Option<usize>, title: &str, message: &str| {
        let line = line.map(|line| format!(",line={line}")).unwrap_or_default();
        let _ = writeln!(
            text,
            "::error file={}{line},title={}::{}",
            property(&verdict.file),
            property(title),
            data(message),
        );
    };
    for Message { rule, text: message, .. } in messages(verdict) {
        let title = format!("fovqa gate: {}", rule.title());
        say(Some(rule.rule.line), &title, &message);
    }
    for error in &verdict.errors {
        say(None, "fovqa gate: not scored", error);
    }
    text
}

/// A Code Quality report for GitLab.
pub fn gitlab_report(verdict: &Verdict, fingerprint: impl Fn(&str) -> String) -> String {
    // The fingerprint does not depend on the value, so that it stays the same from one build to the
    // next.
    let issue = |name: &str, line: usize, (of, message): (&str, &str), severity: &str| {
        json!({
            "description": message,
            "check_name": name,
            "fingerprint": fingerprint(&format!("{name}\n{line}\n{of}")),
            "severity": severity,
            "location": { "path": verdict.file, "lines": { "begin": line } },
        })
    };
    let rules = messages(verdict).into_iter().map(|Message { rule, of, text }| {
        let severity = if rule.state() == State::Failed { "major" } else { "critical" };
        let name = format!("fovqa gate: {}", rule.title());
        issue(&name, rule.rule.line, (&of, &text), severity)
    });
    let errors = verdict.errors.iter();
    let errors = errors.map(|error| issue("fovqa gate: not scored", 1, (error, error), "critical"));
    let issues: serde_json::Value = rules.chain(errors).collect();
    format!("{issues:#}\n")
}

/// The message for a rule that did not pass.
struct Message<'a> {
    rule: &'a RuleVerdict,
    /// The name of the comparison; empty if the message belongs to no comparison.
    of: String,
    text: String,
}

fn messages(verdict: &Verdict) -> Vec<Message<'_>> {
    let mut messages = Vec::new();
    for rule in &verdict.rules {
        let broken = rule.checks.iter().filter(|check| check.outcome.reason().is_some());
        messages.extend(broken.map(|check| Message {
            rule,
            of: place(check),
            text: sentence(check),
        }));
        let whole = rule.failure.iter();
        messages.extend(whole.map(|why| Message { rule, of: String::new(), text: why.clone() }));
    }
    messages
}

/// Escapes text for a GitHub message: one line, without characters that control a terminal.
fn data(text: &str) -> String {
    printable(text).replace('%', "%25")
}

/// Escapes text for a property in a GitHub command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_shown_and_not_obeyed() {
        let text = "of  value\n::error::x\n  ::stop-commands::t\na ::b c\n##[group]d\n";
        let shown = "of  value\n\\::error::x\n  \\::stop-commands::t\na ::b c\n##\\[group]d\n";
        assert_eq!(without_commands(text), shown);
    }
}
