//! The verdict as JSON, schema `fovqa.gate/1`. New keys may be added, but keys are never renamed.

use std::io::{self, Write};

use serde::Serialize;

use super::verdict::{Check, RuleVerdict, Verdict};
use crate::json::Number;

/// Name and version of the format.
pub const GATE_SCHEMA: &str = "fovqa.gate/1";

#[derive(Serialize)]
struct Document<'a> {
    schema: &'a str,
    version: &'a str,
    experiment: &'a str,
    state: &'a str,
    rules: Vec<Rule<'a>>,
    errors: &'a [String],
    notes: &'a [String],
}

#[derive(Serialize)]
struct Rule<'a> {
    title: String,
    line: usize,
    quantity: String,
    limits: String,
    state: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    checks: Vec<CheckRecord<'a>>,
}

#[derive(Serialize)]
struct CheckRecord<'a> {
    scene: &'a str,
    method: &'a str,
    eye: &'a str,
    state: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    value: Option<Number>,
    baseline: Option<Number>,
    limit: Option<Number>,
    margin: Option<Number>,
    worst_frame: Option<i64>,
    worst_value: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    band_deg: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    p: Option<f64>,
}

impl<'a> CheckRecord<'a> {
    fn of(check: &'a Check) -> Self {
        Self {
            scene: &check.place.0,
            method: &check.place.1,
            eye: &check.place.2,
            state: check.outcome.state().name(),
            reason: check.outcome.reason(),
            value: check.value.map(Number),
            baseline: check.baseline.map(Number),
            limit: check.limit.map(|limit| Number(limit.value)),
            margin: check.limit.map(|limit| Number(limit.margin)),
            worst_frame: check.worst.map(|worst| worst.0),
            worst_value: check.worst.map(|worst| Number(worst.1)),
            band_deg: check.band,
            p: check.p,
        }
    }
}

/// Writes a verdict as indented JSON with a newline at its end.
///
/// # Errors
/// If the writer refuses.
pub fn write_verdict_json(verdict: &Verdict, mut out: impl Write) -> io::Result<()> {
    let rule = |rule: &'_ RuleVerdict| -> (String, String, String) {
        (rule.title(), rule.rule.quantity.to_string(), rule.rule.limits())
    };
    let rules = verdict.rules.iter().map(|verdict| {
        let (title, quantity, limits) = rule(verdict);
        Rule {
            title,
            line: verdict.rule.line,
            quantity,
            limits,
            state: verdict.state().name(),
            reason: verdict.failure.as_deref(),
            checks: verdict.checks.iter().map(CheckRecord::of).collect(),
        }
    });
    let document = Document {
        schema: GATE_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        experiment: &verdict.experiment,
        state: verdict.state().name(),
        rules: rules.collect(),
        errors: &verdict.errors,
        notes: &verdict.notes,
    };
    serde_json::to_writer_pretty(&mut out, &document)?;
    writeln!(out)
}
