//! The table on the page of a run.

use std::fmt::Write;

use super::ComparisonTable;
use crate::page::escaped;

impl ComparisonTable {
    /// HTML of the same layout.
    pub(crate) fn html(&self) -> String {
        let corner = self.corner;
        let mut text = format!("<table>\n<thead>\n<tr><th rowspan=\"2\">{corner}</th>");
        for group in &self.groups {
            let span = self.methods.len();
            let _ = write!(text, "<th colspan=\"{span}\">{}</th>", group.heading());
        }
        text.push_str("</tr>\n<tr>");
        for _ in &self.groups {
            for method in &self.methods {
                let _ = write!(text, "<th>{}</th>", escaped(method));
            }
        }
        text.push_str("</tr>\n</thead>\n<tbody>\n");
        for row in &self.rows {
            let class = if row.average { " class=\"average\"" } else { "" };
            let _ = write!(text, "<tr{class}><th>{}</th>", escaped(&row.label));
            for (group, cells) in self.groups.iter().zip(&row.cells) {
                for (index, cell) in cells.iter().enumerate() {
                    let first = if index == 0 { " class=\"first\"" } else { "" };
                    let number = group.shown(cell.value);
                    let number = if cell.best { format!("<b>{number}</b>") } else { number };
                    let _ = write!(text, "<td{first}>{number}</td>");
                }
            }
            text.push_str("</tr>\n");
        }
        text.push_str("</tbody>\n</table>\n");
        text
    }
}
