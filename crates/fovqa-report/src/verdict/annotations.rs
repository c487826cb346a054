//! The verdict where CI systems show it: beside the line of the rule in the experiment file.

use std::fmt::Write as _;

use fovqa_results::{Check, RuleVerdict, State, Verdict};
use serde_json::json;

use super::sentence;

/// Workflow commands of GitHub, a line a check that does not hold.
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
    for (rule, message) in messages(verdict) {
        let title = format!("fovqa gate: {}", rule.title());
        say(Some(rule.rule.line), &title, &message);
    }
    for error in &verdict.errors {
        say(None, "fovqa gate: not scored", error);
    }
    text
}

/// A Code Quality report of GitLab.
pub fn gitlab_report(verdict: &Verdict, fingerprint: impl Fn(&str) -> String) -> String {
    let issue = |name: &str, line: usize, message: &str, severity: &str| {
        json!({
            "description": message,
            "check_name": name,
            "fingerprint": fingerprint(&format!("{name}\n{line}\n{message}")),
            "severity": severity,
            "location": { "path": verdict.file, "lines": { "begin": line } },
        })
    };
    let rules = messages(verdict).into_iter().map(|(rule, message)| {
        let severity = if rule.state() == State::Failed { "major" } else { "critical" };
        issue(&format!("fovqa gate: {}", rule.title()), rule.rule.line, &message, severity)
    });
    let errors = verdict.errors.iter();
    let errors = errors.map(|error| issue("fovqa gate: not scored", 1, error, "critical"));
    let issues: serde_json::Value = rules.chain(errors).collect();
    format!("{issues:#}\n")
}

/// What there is to say of each rule that does not hold.
fn messages(verdict: &Verdict) -> Vec<(&RuleVerdict, String)> {
    let broken = |check: &&Check| check.outcome.reason().is_some();
    let of = |rule: &'_ RuleVerdict| -> Vec<String> {
        let checks = rule.checks.iter().filter(broken).map(sentence);
        checks.chain(rule.failure.clone()).collect()
    };
    let rules = verdict.rules.iter();
    rules.flat_map(|rule| of(rule).into_iter().map(move |message| (rule, message))).collect()
}

/// Escaped as GitHub reads messages.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escaped as GitHub reads properties.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
