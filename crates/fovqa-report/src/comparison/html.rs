//! The table on the page of a run.

use std::fmt::Write;

use super::{ComparisonTable, heading, shown};
use crate::page::escaped;

impl ComparisonTable {
    /// HTML of the same layout.
    pub(crate) fn html(&self) -> String {
        let mut text = String::from("<table>\n<thead>\n<tr><th rowspan=\"2\">scene</th>");
        for metric in &self.metrics {
            let span = self.methods.len();
            let _ = write!(text, "<th colspan=\"{span}\">{}</th>", heading(*metric));
        }
        text.push_str("</tr>\n<tr>");
        for _ in &self.metrics {
            for method in &self.methods {
                let _ = write!(text, "<th>{}</th>", escaped(method));
            }
        }
        text.push_str("</tr>\n</thead>\n<tbody>\n");
        for row in &self.rows {
            let class = if row.average { " class=\"average\"" } else { "" };
            let _ = write!(text, "<tr{class}><th>{}</th>", escaped(&row.label));
            for (metric, cells) in self.metrics.iter().zip(&row.cells) {
                for (index, cell) in cells.iter().enumerate() {
                    let first = if index == 0 { " class=\"first\"" } else { "" };
                    let number = shown(*metric, cell.value);
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
