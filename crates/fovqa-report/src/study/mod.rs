//! The results of a user study as text.

mod anova;
pub(crate) mod figures;
mod metrics;
mod numbers;
mod pairs;
mod plan;
mod psychometric;
mod ranks;
mod ratings;
mod staircase;

use std::fmt::Write as _;

use comfy_table::Table;
use fovqa_study::Analysis;
use fovqa_study::json::Document;

use crate::text_table::{aligned, printable};

/// The tables of a study, one part per group.
pub fn study_text(analysis: &Analysis) -> String {
    match analysis {
        Analysis::Pairs(document) => of_groups(document, pairs::text),
        Analysis::Ranks(document) => of_groups(document, ranks::text),
        Analysis::Anova(document) => of_groups(document, anova::text),
        Analysis::Psychometric(document) => of_groups(document, psychometric::text),
        Analysis::Staircase(document) => of_groups(document, staircase::text),
        Analysis::Ratings(document) => of_groups(document, ratings::text),
        Analysis::Metrics(document) => of_groups(document, metrics::text),
        Analysis::PlanPairs(plan) => of_plan(&plan.result, plan::pairs),
        Analysis::PlanStaircase(plan) => of_plan(&plan.result, plan::staircase),
    }
}

fn of_plan<T>(plan: &T, text: impl Fn(&T, &mut Report)) -> String {
    let mut report = Report::default();
    text(plan, &mut report);
    report.0
}

/// The text of each group, below what its rows have in common.
fn of_groups<T>(document: &Document<T>, text: impl Fn(&T, &mut Report)) -> String {
    let mut report = Report::default();
    if !document.excluded.is_empty() {
        report.line(&format!("excluded participants: {}", document.excluded.join(", ")));
    }
    for group in &document.groups {
        let by: Vec<String> =
            group.by.0.iter().map(|(column, value)| format!("{column} = {value}")).collect();
        if !by.is_empty() {
            report.line(&format!("# {}", by.join(", ")));
        }
        text(&group.result, &mut report);
    }
    report.0
}

/// Text with tables, notes, and empty lines between them.
#[derive(Default)]
struct Report(String);

impl Report {
    /// Adds a paragraph of one line.
    fn line(&mut self, text: &str) {
        self.separate();
        let _ = writeln!(self.0, "{}", printable(text));
    }

    /// Adds a table below its title. A table without rows is left out.
    fn table(&mut self, title: &str, table: Table) {
        if table.row_count() > 0 {
            self.line(title);
            let _ = writeln!(self.0, "{}", aligned(table));
        }
    }

    /// Adds why values are undefined: each reason once, with what it is about.
    fn reasons(&mut self, reasons: impl IntoIterator<Item = (String, Option<String>)>) {
        let mut by_reason: Vec<(String, Vec<String>)> = Vec::new();
        for (about, reason) in reasons {
            let Some(reason) = reason else { continue };
            match by_reason.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, names)) => names.push(about),
                None => by_reason.push((reason, vec![about])),
            }
        }
        for (reason, names) in by_reason {
            let shown = names.iter().take(3).cloned().collect::<Vec<_>>().join(", ");
            let more = match names.len() {
                0..=3 => String::new(),
                n => format!(" and {} more", n - 3),
            };
            let _ = writeln!(self.0, "– {}{more}: {}", printable(&shown), printable(&reason));
        }
    }

    fn separate(&mut self) {
        if !self.0.is_empty() {
            self.0.push('\n');
        }
    }
}
