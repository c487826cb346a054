//! Tables of plain text: names are aligned to the left, numbers to the right. On a terminal that is
//! too narrow for a table, its columns are shown in groups below each other, or its rows as lists.

use std::collections::BTreeSet;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use textwrap::core::display_width;

/// Blanks between two columns.
const GAP: usize = 2;

/// A table of plain text. The first cell of a row is its name.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TextTable {
    header: Vec<String>,
    lines: Vec<Line>,
    /// Columns that are aligned to the left, as the names are.
    of_text: Vec<usize>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Line {
    /// A title over the rows that follow.
    Title(String),
    Row(Vec<String>),
}

impl TextTable {
    /// An empty table with the headings of its columns.
    pub fn new<T: Into<String>>(header: impl IntoIterator<Item = T>) -> Self {
        Self { header: header.into_iter().map(Into::into).collect(), ..Self::default() }
    }

    /// The table with these columns aligned to the left, because they contain text.
    #[must_use]
    pub fn with_text_in(self, columns: &[usize]) -> Self {
        Self { of_text: columns.to_vec(), ..self }
    }

    /// Adds a title over the rows that follow.
    pub(crate) fn add_title(&mut self, title: String) {
        self.lines.push(Line::Title(title));
    }

    /// Adds a row, with one cell for each column.
    pub fn add_row<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.lines.push(Line::Row(cells.into_iter().map(Into::into).collect()));
    }

    /// The table in full.
    pub(crate) fn full(&self) -> String {
        self.of_columns(&(1..self.header.len()).collect::<Vec<_>>())
    }

    /// The table for a terminal of this many columns. A title, and a line of a list, can still be too
    /// long.
    pub(crate) fn within(&self, width: usize) -> String {
        let widths: Vec<usize> = (0..self.header.len()).map(|index| self.width(index)).collect();
        let Some((name, others)) = widths.split_first() else { return String::new() };
        let of = |columns: &[usize]| columns.iter().map(|width| GAP + width).sum::<usize>();
        if name + of(others) <= width {
            return self.full();
        }
        let widest = others.iter().max().copied().unwrap_or_default();
        if !self.has_unique_names() || name + GAP + widest > width {
            return self.as_lists();
        }
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut used = width;
        for (column, own) in (1..).zip(others) {
            if used + GAP + own > width {
                groups.push(Vec::new());
                used = *name;
            }
            used += GAP + own;
            groups.last_mut().into_iter().for_each(|group| group.push(column));
        }
        let groups = groups.iter().map(|group| self.of_columns(group));
        groups.collect::<Vec<_>>().join("\n\n")
    }

    fn rows(&self) -> impl Iterator<Item = &Vec<String>> {
        self.lines.iter().filter_map(|line| match line {
            Line::Row(cells) => Some(cells),
            Line::Title(_) => None,
        })
    }

    /// The width of a column in characters.
    fn width(&self, index: usize) -> usize {
        let cells = self.rows().filter_map(|cells| cells.get(index));
        // The marks of numbers may be blanks at the end.
        let widths = cells.chain(self.header.get(index)).map(|cell| display_width(cell));
        widths.max().unwrap_or_default()
    }

    /// Whether a name, below its title, tells a row from all others.
    fn has_unique_names(&self) -> bool {
        let mut known = BTreeSet::new();
        self.lines.iter().all(|line| match line {
            Line::Title(_) => {
                known.clear();
                true
            }
            Line::Row(cells) => known.insert(cells.first()),
        })
    }

    /// The names with these columns.
    fn of_columns(&self, columns: &[usize]) -> String {
        let chosen = |cells: &[String]| -> Vec<String> {
            let cell = |index: &usize| cells.get(*index).cloned().unwrap_or_default();
            [0].iter().chain(columns).map(cell).collect()
        };
        let mut table = Table::new();
        table.load_preset(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(chosen(&self.header));
        for cells in self.rows() {
            table.add_row(chosen(cells));
        }
        for (index, column) in table.column_iter_mut().enumerate() {
            let of = index.checked_sub(1).and_then(|index| columns.get(index));
            let is_text = of.is_none_or(|of| self.of_text.contains(of));
            let side = if is_text { CellAlignment::Left } else { CellAlignment::Right };
            column.set_cell_alignment(side);
            column.set_padding(if index == 0 { (0, 1) } else { (1, 1) });
        }
        let mut rows = table.lines().map(|line| line.trim_end().to_owned());
        let mut lines: Vec<String> = rows.by_ref().take(1).collect();
        for line in &self.lines {
            match line {
                Line::Title(title) => lines.push(title.clone()),
                Line::Row(_) => lines.extend(rows.next()),
            }
        }
        // A cell of several lines makes more of them than there are rows.
        lines.extend(rows);
        lines.join("\n")
    }

    /// Each row as its name, followed by a line for each of its cells.
    fn as_lists(&self) -> String {
        let mut lines = Vec::new();
        for line in &self.lines {
            let cells = match line {
                Line::Title(title) => {
                    lines.push(title.clone());
                    continue;
                }
                Line::Row(cells) => cells,
            };
            let name = cells.first().map_or("", String::as_str);
            let indent = name.len() - name.trim_start().len() + GAP;
            lines.push(name.to_owned());
            let values = cells.iter().zip(&self.header).skip(1);
            for (cell, heading) in values.filter(|(cell, _)| !cell.trim().is_empty()) {
                let cell = cell.trim();
                lines.push(match heading.as_str() {
                    "" => format!("{:indent$}{cell}", ""),
                    heading => format!("{:indent$}{heading}: {cell}", ""),
                });
            }
        }
        lines.join("\n")
    }
}

/// Text without characters that control a terminal or start a new line: invisible characters are
/// written as escapes.
pub(crate) fn printable(text: &str) -> String {
    let shown = |c: char| {
        if c.is_control() { c.escape_default().collect() } else { c.to_string() }
    };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(names: [&str; 2]) -> TextTable {
        let mut table = TextTable::new(["scene", "PSNR (dB) ↑", "SSIM ↑", "MSE ↓"]);
        table.add_row([names[0], "31.07*", "0.9412*", "7.81e-4*"]);
        table.add_title("Average".to_owned());
        table.add_row([names[1], "24.70 ", "0.8806 ", "3.39e-3 "]);
        table
    }

    #[test]
    fn a_table_that_fits_stays_whole() {
        let table = table(["bistro", "attic"]);
        let full = "scene   PSNR (dB) ↑   SSIM ↑     MSE ↓\n\
                    bistro       31.07*  0.9412*  7.81e-4*\n\
                    Average\n\
                    attic        24.70   0.8806   3.39e-3";
        assert_eq!(table.full(), full);
        assert_eq!(table.within(38), full);
        assert_ne!(table.within(37), full);
    }

    #[test]
    fn columns_are_shown_in_groups_with_the_names_of_the_rows() {
        let narrow = table(["bistro", "attic"]).within(30);
        assert_eq!(
            narrow,
            "scene   PSNR (dB) ↑   SSIM ↑\n\
             bistro       31.07*  0.9412*\n\
             Average\n\
             attic        24.70   0.8806\n\
             \n\
             scene      MSE ↓\n\
             bistro  7.81e-4*\n\
             Average\n\
             attic   3.39e-3"
        );
    }

    #[test]
    fn rows_are_lists_if_a_column_does_not_fit_or_names_are_alike() {
        let lists = "bistro\n  PSNR (dB) ↑: 31.07*\n  SSIM ↑: 0.9412*\n  MSE ↓: 7.81e-4*\n\
                     Average\n\
                     attic\n  PSNR (dB) ↑: 24.70\n  SSIM ↑: 0.8806\n  MSE ↓: 3.39e-3";
        assert_eq!(table(["bistro", "attic"]).within(18), lists);
        let mut alike = TextTable::new(["rule", "of", ""]);
        alike.add_row(["PSNR ≥ 30", "attic, RMFR", ""]);
        alike.add_row(["PSNR ≥ 30", "bistro, RMFR", "passed"]);
        let lists = "PSNR ≥ 30\n  of: attic, RMFR\nPSNR ≥ 30\n  of: bistro, RMFR\n  passed";
        assert_eq!(alike.within(25), lists);
    }
}
