//! Writes the table for the page of a run.

use std::fmt::Write;

use super::group::Group;
use super::{Cell, ComparisonTable};
use crate::page::escaped;

/// Maximum number of methods that can be read as columns.
const MOST_METHODS: usize = 20;
/// Maximum number of cells. A page with more cells opens too slowly.
const MOST_CELLS: usize = 200_000;

impl ComparisonTable {
    /// Whether the table has so many methods that the page shows it in another layout.
    pub(crate) fn is_long(&self) -> bool {
        self.methods.len() > MOST_METHODS
    }

    /// HTML of a table with very many methods, with one row per method. `None` if it is too large
    /// for a page, or is a table of ratios.
    pub(crate) fn long_html(&self) -> Option<String> {
        let rows = self.rows.len();
        if !self.is_of_scenes() || self.methods.len() * self.groups.len() * rows > MOST_CELLS {
            return None;
        }
        let mut text = String::from("<table>\n<thead>\n<tr><th rowspan=\"2\">method</th>");
        for group in &self.groups {
            let _ = write!(text, "<th colspan=\"{rows}\">{}</th>", group.heading());
        }
        text.push_str("</tr>\n<tr>");
        for _ in &self.groups {
            for row in &self.rows {
                let _ = write!(text, "<th>{}</th>", escaped(&row.label));
            }
        }
        text.push_str("</tr>\n</thead>\n<tbody>\n");
        for (index, method) in self.methods.iter().enumerate() {
            let _ = write!(text, "<tr><th>{}</th>", escaped(method));
            for (column, group) in self.groups.iter().enumerate() {
                let cells = self.rows.iter().map(|row| &row.cells[column][index]);
                html_cells(&mut text, group, cells);
            }
            text.push_str("</tr>\n");
        }
        text.push_str("</tbody>\n</table>\n");
        Some(text)
    }

    /// HTML with the same layout as the table.
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
                html_cells(&mut text, group, cells.iter());
            }
            text.push_str("</tr>\n");
        }
        text.push_str("</tbody>\n</table>\n");
        text
    }
}

/// Writes the cells of a group of columns.
fn html_cells<'a>(text: &mut String, group: &Group, cells: impl Iterator<Item = &'a Cell>) {
    for (index, cell) in cells.enumerate() {
        let first = if index == 0 { " class=\"first\"" } else { "" };
        let number = group.shown(cell.value);
        let number = if cell.best { format!("<b>{number}</b>") } else { number };
        let _ = write!(text, "<td{first}>{number}</td>");
    }
}
