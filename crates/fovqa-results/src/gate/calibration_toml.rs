//! Proposed limits as tables of an experiment file.

use std::fmt::Write as _;

use super::calibrate::{Calibration, Proposal, ProposedLimit, named};

/// Width of the comment at the beginning, in characters.
const WIDTH: usize = 100;

impl Calibration {
    /// The limits as tables of an experiment file, each with a comment that states its source.
    pub fn toml(&self) -> String {
        let mut text = wrapped(&format!("Limits from {}.", self.in_words()));
        for proposal in &self.proposals {
            let Proposal { place, quantity, min, max, mean, deviation, .. } = proposal;
            let (place, runs) = (comment(&named(place)), self.runs);
            let _ = write!(text, "\n# {place}: {quantity} {min} to {max} in {runs} runs");
            if proposal.limits.is_empty() {
                text.push_str(": an infinite value gives no limit\n");
                continue;
            }
            let _ = writeln!(text, " (mean {mean}, standard deviation {deviation:.2e})");
            table(&mut text, proposal);
        }
        text
    }
}

/// Adds the table of a rule.
fn table(text: &mut String, Proposal { place, quantity, limits, .. }: &Proposal) {
    let (scene, method, eye) = place;
    let _ = writeln!(text, "[[gate]]\nmetric = {}", quoted(&quantity.metric));
    let mut key = |key: &str, value: &str| {
        let _ = writeln!(text, "{key} = {value}");
    };
    key("scene", &quoted(scene));
    key("method", &quoted(method));
    if !eye.is_empty() {
        key("eye", &quoted(eye));
    }
    if !quantity.statistic.is_empty() {
        key("statistic", &quoted(&quantity.statistic));
    }
    if quantity.image != "pair" {
        key("image", &quoted(&quantity.image));
    }
    if let Some(level) = quantity.level {
        key("level", &level.to_string());
    }
    if let Some([from, to]) = quantity.band_deg {
        key("band_deg", &format!("[{from}, {to}]"));
    }
    if let Some(aggregate) = quantity.aggregate {
        key("aggregate", &quoted(&aggregate.to_string()));
    }
    if quantity.per_frame {
        key("per_frame", "true");
    }
    for limit in limits {
        let (name, value) = match limit {
            ProposedLimit::AtLeast(value) => ("at_least", value),
            ProposedLimit::AtMost(value) => ("at_most", value),
            ProposedLimit::MaxDrop(value) => ("max_drop", value),
            ProposedLimit::MaxRise(value) => ("max_rise", value),
        };
        key(name, &format!("{value:?}"));
    }
}

/// A text as comment lines.
fn wrapped(text: &str) -> String {
    let mut lines = String::new();
    let mut line = "#".to_owned();
    for word in text.split(' ') {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(lines, "{line}");
            "#".clone_into(&mut line);
        }
        let _ = write!(line, " {word}");
    }
    format!("{lines}{line}\n")
}

/// A text in TOML quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A name for use in a comment: it must not contain a line break.
fn comment(text: &str) -> String {
    text.replace(char::is_control, " ")
}
