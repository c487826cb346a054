//! Plain tables for papers.

use super::{Cell, Column, PlainTable};
use crate::latex::{self, Group, Head, Number, Section, Sheet};

impl PlainTable {
    /// A complete `table` float with caption and label. It needs `\usepackage{booktabs}`.
    pub(crate) fn latex(&self, label: &str) -> String {
        // Columns that every part repeats come first.
        let (first, others): (Vec<usize>, Vec<usize>) =
            (0..self.columns.len()).partition(|index| self.columns[*index].is_repeated);
        let order = [first, others].concat();
        let mut groups: Vec<Group> = Vec::new();
        for (at, index) in order.iter().enumerate() {
            let Some(name) = &self.columns[*index].group else { continue };
            match groups.last_mut() {
                Some(group) if group.head.name == *name && group.last + 1 == at => group.last = at,
                _ => groups.push(Group { head: Head::named(name), first: at, last: at }),
            }
        }
        let row = |row: &Vec<Cell>| order.iter().map(|index| cell(&row[*index])).collect();
        Sheet {
            comments: self.notes.clone(),
            caption: format!("{}.", self.caption),
            label: label.to_owned(),
            columns: order.iter().map(|index| self.column(*index)).collect(),
            groups,
            sections: vec![Section {
                title: String::new(),
                rows: self.rows.iter().map(row).collect(),
            }],
        }
        .text()
    }

    fn column(&self, index: usize) -> latex::Column {
        let Column { head, in_paper, is_repeated, .. } = &self.columns[index];
        let head = in_paper.as_ref().unwrap_or(head);
        let is_text = !self.rows.iter().any(|row| row[index].is_number);
        // Only numbers have a line for units.
        let unit = head.strip_suffix(')').and_then(|head| head.split_once(" ("));
        let (name, unit) = unit.filter(|_| !is_text).unwrap_or((head, ""));
        let cells = || self.rows.iter().map(|row| &row[index]).filter(|cell| cell.is_number);
        let is_percent = cells().count() > 0 && cells().all(|cell| cell.shown.ends_with(PERCENT));
        latex::Column {
            head: Head {
                name: name.to_owned(),
                unit: if is_percent { "%".to_owned() } else { unit.to_owned() },
                ..Head::default()
            },
            is_text,
            is_repeated: *is_repeated,
        }
    }
}

const PERCENT: &str = " %";

fn cell(cell: &Cell) -> latex::Cell {
    if !cell.is_number {
        return latex::Cell::Text(cell.shown.clone());
    }
    // The unit is in the heading.
    let value = cell.shown.trim_end_matches(PERCENT).to_owned();
    latex::Cell::Number(Number { value, ..Number::default() })
}
