//! The results of a user study as text.

use std::fmt::Write as _;

use fovqa_study::Analysis;
use fovqa_study::json::Document;

use super::parts::{Part, Parts, in_words};
use super::{anova, metrics, pairs, plan, psychometric, ranks, ratings, staircase};
use crate::plain_table::PlainTable;
use crate::text::Text;
use crate::text_table::printable;

/// Rows beyond these are only counted.
const MOST_ROWS: usize = 200;

/// The tables of a study, one part per group.
pub fn study_text(analysis: &Analysis) -> Text {
    match analysis {
        Analysis::Pairs(document) => of_groups(document, pairs::parts),
        Analysis::Ranks(document) => of_groups(document, ranks::parts),
        Analysis::Anova(document) => of_groups(document, anova::parts),
        Analysis::Psychometric(document) => of_groups(document, psychometric::parts),
        Analysis::Staircase(document) => of_groups(document, staircase::parts),
        Analysis::Ratings(document) => of_groups(document, ratings::parts),
        Analysis::Metrics(document) => of_groups(document, metrics::parts),
        Analysis::PlanPairs(plan) => of_one(&plan.result, plan::pairs),
        Analysis::PlanPredicted(plan) => of_one(&plan.result, plan::predicted),
        Analysis::PlanStaircase(plan) => of_one(&plan.result, plan::staircase),
    }
}

fn of_one<T>(result: &T, parts: impl Fn(&T, &mut Parts)) -> Text {
    let mut own = Parts::default();
    parts(result, &mut own);
    let mut text = Paragraphs::default();
    text.parts(&own.0);
    text.0
}

/// The text of each group, below what its rows have in common.
fn of_groups<T>(document: &Document<T>, parts: impl Fn(&T, &mut Parts)) -> Text {
    let mut text = Paragraphs::default();
    if !document.excluded.is_empty() {
        text.line(&format!("excluded participants: {}", document.excluded.join(", ")));
    }
    for group in &document.groups {
        let by = in_words(&group.by);
        if !by.is_empty() {
            text.line(&format!("# {by}"));
        }
        let mut own = Parts::default();
        parts(&group.result, &mut own);
        text.parts(&own.0);
    }
    text.0
}

/// Text with tables and remarks, and empty lines between them.
#[derive(Default)]
struct Paragraphs(Text);

impl Paragraphs {
    fn parts(&mut self, parts: &[Part]) {
        for part in parts {
            match part {
                Part::Remark(text) => self.line(text),
                Part::Table { detail, table, .. } => self.table(detail, table),
            }
        }
    }

    /// Adds a paragraph of one line.
    fn line(&mut self, text: &str) {
        if !self.0.is_empty() {
            self.0.push_str("\n");
        }
        let _ = writeln!(self.0, "{}", printable(text));
    }

    fn table(&mut self, detail: &str, table: &PlainTable) {
        let joint = if detail.is_empty() { "" } else { "; " };
        self.line(&format!("{}{joint}{detail}", table.caption));
        let more = table.rows.len().saturating_sub(MOST_ROWS);
        if more > 0 {
            let rows = table.rows[..MOST_ROWS].to_vec();
            let shown = PlainTable { rows, ..table.clone() };
            self.0.push_table(shown.terminal());
            let _ = writeln!(self.0, "… and {more} more rows; --format json has all of them");
        } else {
            self.0.push_table(table.terminal());
        }
        for note in &table.notes {
            let _ = writeln!(self.0, "– {}", printable(note));
        }
    }
}
