//! A table of names and numbers, for Markdown, CSV, a page and a terminal.

mod html;
mod latex;

use std::fmt::Write;

use crate::comparison::escaped_markdown;
use crate::text_table::{TextTable, printable};

/// A table. The first cells of each row are names.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PlainTable {
    /// The caption.
    pub(crate) caption: String,
    /// Headings of the columns, each with its name in CSV.
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Vec<Cell>>,
    pub(crate) notes: Vec<String>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Column {
    pub(crate) head: String,
    pub(crate) key: String,
    /// The heading over this and neighbouring columns in LaTeX.
    pub(crate) group: Option<String>,
    /// The heading in LaTeX, if it is not `head`. A unit is in brackets at its end.
    pub(crate) in_paper: Option<String>,
    /// Whether every part of a table that is divided in LaTeX repeats the column.
    pub(crate) is_repeated: bool,
    /// What its values mean, in sentences; empty if that is plain.
    pub(crate) about: &'static str,
}

impl Column {
    pub(crate) fn new(head: impl Into<String>, key: impl Into<String>) -> Self {
        Self {
            head: head.into(),
            key: key.into(),
            group: None,
            in_paper: None,
            is_repeated: false,
            about: "",
        }
    }

    /// The column with its headings in LaTeX.
    pub(crate) fn in_paper(self, group: &str, head: &str) -> Self {
        Self { group: Some(group.to_owned()), in_paper: Some(head.to_owned()), ..self }
    }

    /// The column with what its values mean.
    pub(crate) fn about(self, about: &'static str) -> Self {
        Self { about, ..self }
    }

    /// The column as one that every part of a divided table repeats.
    pub(crate) fn repeated(self) -> Self {
        Self { is_repeated: true, ..self }
    }
}

/// The text of a cell, and the value that it shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Cell {
    pub(crate) shown: String,
    pub(crate) value: String,
    /// Whether it is a number. Numbers are aligned.
    pub(crate) is_number: bool,
}

impl Cell {
    pub(crate) fn text(text: impl Into<String>) -> Self {
        let text = text.into();
        Self { shown: text.clone(), value: text, is_number: false }
    }

    /// A text that CSV writes otherwise.
    pub(crate) fn named(shown: impl Into<String>, value: impl Into<String>) -> Self {
        Self { shown: shown.into(), value: value.into(), is_number: false }
    }

    pub(crate) fn number(shown: String, value: f64) -> Self {
        Self { shown, value: format!("{value:?}"), is_number: true }
    }

    /// A share, shown in percent.
    pub(crate) fn percent(share: f64) -> Self {
        Self::number(format!("{:.1} %", 100.0 * share), share)
    }

    /// A count, shown in thousands if it is large.
    pub(crate) fn count(count: f64) -> Self {
        Self::number(grouped(count), count)
    }
}

/// A rounded number with thin spaces as thousands separators.
pub(crate) fn grouped(count: f64) -> String {
    let digits = format!("{count:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

impl PlainTable {
    pub(crate) fn markdown(&self) -> String {
        let plain = |text: &str| escaped_markdown(text);
        let mut text = String::from("|");
        for column in &self.columns {
            let _ = write!(text, " {} |", plain(&column.head));
        }
        text.push_str("\n| :-- |");
        text.push_str(&" --: |".repeat(self.columns.len().saturating_sub(1)));
        for row in &self.rows {
            text.push_str("\n|");
            for cell in row {
                let _ = write!(text, " {} |", plain(&cell.shown));
            }
        }
        text.push('\n');
        for note in &self.notes {
            let _ = writeln!(text, "\n{note}");
        }
        text
    }

    /// CSV with full precision.
    pub(crate) fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        // Writing to memory does not fail, and all rows have the same length.
        let _ = writer.write_record(self.columns.iter().map(|column| &column.key));
        for row in &self.rows {
            let _ = writer.write_record(row.iter().map(|cell| &cell.value));
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }

    /// The table for a terminal, without its caption and notes.
    pub(crate) fn terminal(&self) -> TextTable {
        let heads = self.columns.iter().map(|column| printable(&column.head));
        let mut table = TextTable::new(heads);
        for row in &self.rows {
            table.add_row(row.iter().map(|cell| printable(&cell.shown)));
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_grouped() {
        let plain = |count| grouped(count).replace('\u{202f}', " ");
        assert_eq!(plain(12.4), "12");
        assert_eq!(plain(1_061_733.7), "1 061 734");
        assert_eq!(plain(123_456.0), "123 456");
    }
}
