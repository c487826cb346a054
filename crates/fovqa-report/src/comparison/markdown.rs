//! Writes the table as GitHub Markdown.

use std::fmt::Write;

use super::grid::Label;
use super::marks::Mark;
use super::values::Cell;
use super::{ComparisonTable, legend};
use crate::text_table::printable;

impl ComparisonTable {
    /// GitHub Markdown. The best values are bold, the second best ones italic.
    pub fn markdown(&self) -> String {
        let grid = self.grid();
        let columns = grid.columns();
        let names = grid.groups.iter().flat_map(|group| &group.columns);
        let first = escaped_markdown(grid.first_heading());
        let mut text = format!("| {first} |");
        let rule = format!("\n| :-- |{}", " --: |".repeat(columns));
        if grid.has_group_heads() {
            for group in &grid.groups {
                let head = group.head.as_ref().map(Label::heading).unwrap_or_default();
                let blanks = " |".repeat(group.columns.len().saturating_sub(1));
                let _ = write!(text, " {} |{blanks}", escaped_markdown(&head));
            }
            text.push_str(&rule);
            text.push_str("\n| |");
            for name in names {
                let _ = write!(text, " *{}* |", escaped_markdown(&name.heading()));
            }
        } else {
            for name in names {
                let _ = write!(text, " {} |", escaped_markdown(&name.heading()));
            }
            text.push_str(&rule);
        }
        text.push('\n');
        for section in &grid.sections {
            if !section.title.is_empty() {
                let title = escaped_markdown(&section.title);
                let _ = writeln!(text, "| **{title}** |{}", " |".repeat(columns));
            }
            for row in &section.rows {
                let _ = write!(text, "| {} |", escaped_markdown(&row.label.heading()));
                for cell in &row.cells {
                    let _ = write!(text, " {} |", marked(cell));
                }
                text.push('\n');
            }
        }
        let legend = Some(legend(&grid, "bold", "italic")).filter(|legend| !legend.is_empty());
        for note in legend.into_iter().chain(self.notes()) {
            let _ = writeln!(text, "\n{}", escaped_markdown(&note));
        }
        text
    }
}

fn marked(cell: &Cell) -> String {
    let mark = match cell.mark {
        Mark::Best => "**",
        Mark::Second => "*",
        Mark::None => "",
    };
    format!("{mark}{}{mark}", cell.shown())
}

/// Escapes text so that Markdown shows it unchanged.
pub(crate) fn escaped_markdown(text: &str) -> String {
    let mut plain = String::new();
    for c in printable(text).chars() {
        if matches!(c, '|' | '*' | '_' | '`' | '\\' | '<' | '>' | '[' | ']' | '#' | '&' | '~') {
            plain.push('\\');
        }
        plain.push(c);
    }
    plain
}
