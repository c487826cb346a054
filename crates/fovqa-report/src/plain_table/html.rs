//! The table for a page.

use super::{Cell, PlainTable};
use crate::html_table::{Emphasis, Heading, HtmlCell, HtmlColumn, HtmlRow, HtmlSection, HtmlTable};

/// Maximum number of rows that a page shows in full. A longer table scrolls.
const MOST_ROWS: usize = 40;
/// Maximum number of rows on a page.
const MOST_ON_PAGE: usize = 20_000;

impl PlainTable {
    /// Whether it has so many rows that it scrolls in a box of its own.
    pub(crate) fn is_long(&self) -> bool {
        self.rows.len() > MOST_ROWS
    }

    /// The layout of the table in HTML; `None` if it is too large for a page.
    pub(crate) fn html(&self) -> Option<HtmlTable> {
        if self.rows.len() > MOST_ON_PAGE {
            return None;
        }
        // A column of names may have missing names, and a column of numbers words such as `never`.
        let is_text = |index: usize| {
            !self.rows.iter().any(|row| row.get(index).is_some_and(|cell| cell.is_number))
        };
        let mut headings = self
            .columns
            .iter()
            .map(|column| Heading { text: column.head.clone(), about: column.about.to_owned() });
        let corner = headings.next().unwrap_or_default();
        let explained = [&corner].into_iter().cloned().chain(headings.clone());
        let explained = explained.filter(|heading| !heading.about.is_empty()).collect();
        let columns = headings
            .enumerate()
            .map(|(index, heading)| HtmlColumn { heading, is_text: is_text(index + 1) })
            .collect::<Vec<_>>();
        let row = |row: &Vec<Cell>| HtmlRow {
            heading: Heading::plain(
                row.first().map(|cell| cell.shown.as_str()).unwrap_or_default(),
            ),
            is_average: false,
            cells: row
                .iter()
                .skip(1)
                .zip(&columns)
                .map(|(cell, column)| html_cell(cell, column.is_text))
                .collect(),
        };
        let rows = self.rows.iter().map(row).collect();
        Some(HtmlTable {
            caption: self.caption.clone(),
            is_long: self.is_long(),
            corner,
            groups: Vec::new(),
            columns,
            sections: vec![HtmlSection { title: None, rows }],
            explained,
        })
    }
}

fn html_cell(cell: &Cell, of_names: bool) -> HtmlCell {
    // Nothing, in a column of numbers, is a missing number.
    let is_value = cell.is_number || cell.shown.is_empty() && !of_names;
    HtmlCell {
        shown: cell.shown.clone(),
        value: is_value.then(|| cell.value.clone()),
        spread: String::new(),
        emphasis: Emphasis::None,
        begins_group: false,
    }
}
