//! Writes the table for a terminal.

use super::grid::{Grid, Group, Label};
use super::marks::Mark;
use super::values::Cell;
use super::{ComparisonTable, legend};
use crate::text::Text;
use crate::text_table::{TextTable, printable};

impl ComparisonTable {
    /// Text for a terminal, with groups of columns below each other. `*` marks the best values, `+`
    /// the second best.
    pub fn terminal(&self) -> Text {
        let grid = self.grid();
        let mut text = if self.is_of_scenes() {
            Text::default()
        } else {
            Text::from(format!("{}\n\n", printable(self.caption())))
        };
        let mut from = 0;
        for group in &grid.groups {
            text.push_table(of_group(&grid, group, from));
            text.push_str(if grid.groups.len() > 1 { "\n" } else { "" });
            from += group.columns.len();
        }
        let legend = legend(&grid, "*", "+");
        if !legend.is_empty() {
            text.push_str(&legend);
            text.push_str("\n");
        }
        text
    }
}

/// The columns of a group, which begin at `from`. The titles of sections are lines between the
/// rows, so that a long title does not make the first column wide.
fn of_group(grid: &Grid, group: &Group, from: usize) -> TextTable {
    let first = match &group.head {
        Some(head) => head.heading(),
        None => grid.first_heading().to_owned(),
    };
    let headings = group.columns.iter().map(Label::heading);
    let header = [first].into_iter().chain(headings).map(|name| printable(&name));
    let mut table = TextTable::new(header);
    let range = from..from + group.columns.len();
    for section in &grid.sections {
        let indent = if section.title.is_empty() { "" } else { "  " };
        if !section.title.is_empty() {
            table.add_title(printable(&section.title));
        }
        for row in &section.rows {
            let label = format!("{indent}{}", printable(&row.label.heading()));
            table.add_row([label].into_iter().chain(row.cells[range.clone()].iter().map(starred)));
        }
    }
    table
}

fn starred(cell: &Cell) -> String {
    let mark = match cell.mark {
        Mark::Best => '*',
        Mark::Second => '+',
        Mark::None => ' ',
    };
    format!("{}{mark}", cell.shown())
}
