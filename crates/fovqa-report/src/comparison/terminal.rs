//! Writes the table for a terminal.

use super::group::Group;
use super::{Cell, ComparedRow, ComparisonTable};
use crate::text_table::{aligned, plain_table, printable};

impl ComparisonTable {
    /// Text for a terminal: one metric below another or, if there is only one scene, one method
    /// below another. `*` marks the best value of each scene.
    pub fn terminal(&self) -> String {
        if let [row] = self.rows.as_slice() {
            return self.one_scene(row);
        }
        let mut text = if self.is_of_scenes() {
            String::new()
        } else {
            format!("{}\n\n", printable(&self.caption))
        };
        for (index, group) in self.groups.iter().enumerate() {
            let heading = group.heading();
            let methods = self.methods.iter().map(String::as_str);
            let header: Vec<&str> = [heading.as_str()].into_iter().chain(methods).collect();
            let mut table = plain_table(&header);
            for row in &self.rows {
                let cells = row.cells[index].iter().map(|cell| starred(group, cell));
                table.add_row([printable(&row.label)].into_iter().chain(cells));
            }
            text.push_str(&aligned(table));
            text.push_str("\n\n");
        }
        text
    }

    fn one_scene(&self, row: &ComparedRow) -> String {
        let headings: Vec<String> = self.groups.iter().map(Group::heading).collect();
        let label = printable(&row.label);
        let headings = headings.iter().map(String::as_str);
        let header: Vec<&str> = [label.as_str()].into_iter().chain(headings).collect();
        let mut table = plain_table(&header);
        for (index, method) in self.methods.iter().enumerate() {
            let groups = self.groups.iter().zip(&row.cells);
            let cells = groups.map(|(group, cells)| starred(group, &cells[index]));
            table.add_row([printable(method)].into_iter().chain(cells));
        }
        aligned(table) + "\n"
    }
}

fn starred(group: &Group, cell: &Cell) -> String {
    format!("{}{}", group.shown(cell.value), if cell.best { "*" } else { " " })
}
