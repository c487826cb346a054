//! Thresholds of staircases as text.

use fovqa_study::staircase::{Staircase, Staircases};

use super::Report;
use super::numbers::{interval, number};
use crate::text_table::{plain_table, printable};

pub(super) fn text(staircases: &Staircases, report: &mut Report) {
    let mut methods =
        plain_table(&["method", "participants", "threshold", "standard error", "interval"]);
    for method in &staircases.methods {
        methods.add_row([
            printable(method.method.as_deref().unwrap_or("all")),
            method.participants.to_string(),
            number(method.threshold),
            number(method.se),
            interval(method.ci),
        ]);
    }
    report.table("Thresholds of the methods", methods);
    report.reasons(staircases.methods.iter().map(|method| {
        (method.method.clone().unwrap_or_else(|| "all".to_owned()), method.reason.clone())
    }));
    let mut table =
        plain_table(&["staircase", "trials", "correct", "reversals", "used", "threshold", "SD"]);
    for staircase in &staircases.staircases {
        table.add_row([
            printable(&name(staircase)),
            staircase.trials.to_string(),
            number(staircase.share_correct),
            staircase.reversals.to_string(),
            staircase.threshold.used.to_string(),
            number(staircase.threshold.threshold),
            number(staircase.threshold.sd),
        ]);
    }
    report.table("Staircases", table);
    report.reasons(
        staircases
            .staircases
            .iter()
            .map(|staircase| (name(staircase), staircase.threshold.reason.clone())),
    );
}

fn name(staircase: &Staircase) -> String {
    let mut parts = vec![staircase.participant.as_str()];
    for part in [&staircase.method, &staircase.scene, &staircase.staircase].into_iter().flatten() {
        // A staircase is often named after its method.
        if parts.last() != Some(&part.as_str()) {
            parts.push(part);
        }
    }
    parts.dedup();
    parts.join(", ")
}
