//! The verdict as text for a terminal.

use std::fmt::Write as _;

use fovqa_results::Verdict;

use super::{margin, outcome, place, value_and_limit, where_lines, worst};
use crate::text::Text;
use crate::text_table::{TextTable, printable};

/// One row per rule and comparison, followed by the outcome.
pub fn verdict_table(verdict: &Verdict) -> Text {
    let mut table =
        TextTable::new(["rule", "of", "value", "limit", "margin", "worst frame", "verdict"]);
    for rule in &verdict.rules {
        let title = printable(&rule.title());
        for check in &rule.checks {
            let [value, limit] = value_and_limit(check);
            table.add_row([
                title.clone(),
                printable(&place(check)),
                value,
                limit,
                check.limit.as_ref().map(margin).unwrap_or_default(),
                worst(check),
                check.outcome.state().name().to_owned(),
            ]);
        }
        if let Some(why) = &rule.failure {
            let dash = || "–".to_owned();
            let state = rule.state().name().to_owned();
            table.add_row([title, printable(why), dash(), dash(), dash(), dash(), state]);
        }
    }
    let mut text = Text::default();
    text.push_table(table);
    text.push_str("\n");
    for rule in &verdict.rules {
        for check in rule.checks.iter().filter(|check| check.outcome.reason().is_some()) {
            let why = check.outcome.reason().unwrap_or_default();
            let _ = writeln!(text, "{}: {}", printable(&place(check)), printable(why));
            for line in where_lines(check) {
                let _ = writeln!(text, "  {}", printable(&line));
            }
        }
    }
    if let Some(folder) = &verdict.shown_in {
        let _ = writeln!(text, "pictures: {}/gate", printable(folder));
    }
    if let Some(baseline) = &verdict.baseline {
        let _ = writeln!(text, "compared with {}, the best match", printable(baseline));
    }
    for error in &verdict.errors {
        let _ = writeln!(text, "not scored: {}", printable(error));
    }
    for note in &verdict.notes {
        let _ = writeln!(text, "note: {}", printable(note));
    }
    let _ = writeln!(text, "{}", printable(&outcome(verdict)));
    text
}
