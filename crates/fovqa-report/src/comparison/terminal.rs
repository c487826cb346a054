//! The table on a terminal.

use fovqa_metrics::Metric;

use super::{Cell, ComparisonTable, Row, heading, shown};
use crate::text_table::{aligned, plain_table, printable};

impl ComparisonTable {
    /// For a terminal: metric by metric below each other, or, where there is but one scene, method
    /// by method; `*` behind the best of each scene.
    pub fn terminal(&self) -> String {
        if let [row] = self.rows.as_slice() {
            return self.one_scene(row);
        }
        let mut text = String::new();
        for (index, metric) in self.metrics.iter().enumerate() {
            let heading = heading(*metric);
            let methods = self.methods.iter().map(String::as_str);
            let header: Vec<&str> = [heading.as_str()].into_iter().chain(methods).collect();
            let mut table = plain_table(&header);
            for row in &self.rows {
                let cells = row.cells[index].iter().map(|cell| starred(*metric, cell));
                table.add_row([printable(&row.label)].into_iter().chain(cells));
            }
            text.push_str(&aligned(table));
            text.push_str("\n\n");
        }
        text
    }

    fn one_scene(&self, row: &Row) -> String {
        let headings: Vec<String> = self.metrics.iter().map(|metric| heading(*metric)).collect();
        let label = printable(&row.label);
        let headings = headings.iter().map(String::as_str);
        let header: Vec<&str> = [label.as_str()].into_iter().chain(headings).collect();
        let mut table = plain_table(&header);
        for (index, method) in self.methods.iter().enumerate() {
            let metrics = self.metrics.iter().zip(&row.cells);
            let cells = metrics.map(|(metric, cells)| starred(*metric, &cells[index]));
            table.add_row([printable(method)].into_iter().chain(cells));
        }
        aligned(table) + "\n"
    }
}

fn starred(metric: Metric, cell: &Cell) -> String {
    format!("{}{}", shown(metric, cell.value), if cell.best { "*" } else { " " })
}
