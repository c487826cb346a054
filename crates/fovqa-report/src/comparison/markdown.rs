//! Writes the table as GitHub Markdown.

use std::fmt::Write;

use super::ComparisonTable;
use crate::text_table::printable;

impl ComparisonTable {
    /// GitHub Markdown. The best value of each row is bold.
    pub fn markdown(&self) -> String {
        let mut text = format!("| {} |", self.corner);
        for group in &self.groups {
            let blanks = " |".repeat(self.methods.len() - 1);
            let _ = write!(text, " {} |{blanks}", group.heading());
        }
        text.push_str("\n| :-- |");
        text.push_str(&" --: |".repeat(self.groups.len() * self.methods.len()));
        text.push_str("\n| |");
        for _ in &self.groups {
            for method in &self.methods {
                let _ = write!(text, " *{}* |", escaped_markdown(method));
            }
        }
        text.push('\n');
        for row in &self.rows {
            let _ = write!(text, "| {} |", escaped_markdown(&row.label));
            for (group, cells) in self.groups.iter().zip(&row.cells) {
                for cell in cells {
                    let number = group.shown(cell.value);
                    let bold = if cell.best { "**" } else { "" };
                    let _ = write!(text, " {bold}{number}{bold} |");
                }
            }
            text.push('\n');
        }
        for note in self.notes() {
            let _ = writeln!(text, "\n{}", escaped_markdown(note));
        }
        text
    }
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
