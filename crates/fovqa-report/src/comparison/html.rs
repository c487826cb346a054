//! Writes the table for the page of a run.

use std::fmt::Write;

use super::grid::{Grid, Label};
use super::marks::Mark;
use super::values::Cell;
use super::{ComparisonTable, legend};
use crate::escaped::escaped;

/// Maximum number of rows and columns of a table that the page shows in full. A longer one scrolls.
const MOST_LINES: usize = 40;
/// Maximum number of cells. A page with more cells opens too slowly.
const MOST_CELLS: usize = 200_000;

impl ComparisonTable {
    /// Whether the table has so many rows or columns that it scrolls in a box of its own.
    pub(crate) fn is_long(&self) -> bool {
        let grid = self.grid();
        grid.rows().count() > MOST_LINES || grid.columns() > MOST_LINES
    }

    /// HTML with the layout of the table; `None` if it is too large for a page.
    pub(crate) fn html(&self) -> Option<String> {
        let grid = self.grid();
        if grid.cells().count() > MOST_CELLS {
            return None;
        }
        let mut text = String::from("<table>\n<thead>\n");
        head(&grid, &mut text);
        text.push_str("</thead>\n<tbody>\n");
        for section in &grid.sections {
            if !section.title.is_empty() {
                let span = grid.columns() + 1;
                let title = escaped(&section.title);
                let _ = writeln!(
                    text,
                    "<tr class=\"section\"><th colspan=\"{span}\">{title}</th></tr>"
                );
            }
            for row in &section.rows {
                let class = if row.is_average { " class=\"average\"" } else { "" };
                let label = escaped(&row.label.heading());
                let _ = write!(text, "<tr{class}><th>{label}</th>");
                let mut cells = row.cells.iter();
                for group in &grid.groups {
                    for index in 0..group.columns.len() {
                        let is_first = index == 0 && grid.has_group_heads();
                        cells.next().into_iter().for_each(|c| html_cell(&mut text, c, is_first));
                    }
                }
                text.push_str("</tr>\n");
            }
        }
        text.push_str("</tbody>\n</table>\n");
        Some(text)
    }

    /// What the marks on the page mean.
    pub(crate) fn html_legend(&self) -> String {
        legend(&self.grid(), "bold", "underlined")
    }
}

fn head(grid: &Grid, text: &mut String) {
    let first = escaped(grid.first_heading());
    let names = grid.groups.iter().flat_map(|group| &group.columns).map(Label::heading);
    if grid.has_group_heads() {
        let _ = write!(text, "<tr><th rowspan=\"2\">{first}</th>");
        for group in &grid.groups {
            let span = group.columns.len();
            let head = group.head.as_ref().map(Label::heading).unwrap_or_default();
            let _ = write!(text, "<th colspan=\"{span}\">{}</th>", escaped(&head));
        }
        text.push_str("</tr>\n<tr>");
    } else {
        let _ = write!(text, "<tr><th class=\"corner\">{first}</th>");
    }
    for name in names {
        let _ = write!(text, "<th>{}</th>", escaped(&name));
    }
    text.push_str("</tr>\n");
}

fn html_cell(text: &mut String, cell: &Cell, is_first: bool) {
    let first = if is_first { " class=\"first\"" } else { "" };
    let number = cell.shown();
    let number = match cell.mark {
        Mark::Best => format!("<b>{number}</b>"),
        Mark::Second => format!("<u>{number}</u>"),
        Mark::None => number,
    };
    let _ = write!(text, "<td{first}>{number}</td>");
}
