//! A table as rows and columns, as all formats but CSV show it.

use super::measure::Measure;
use super::values::Cell;

/// Rows in sections, below columns in groups.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    /// The heading of the first column, which names the rows.
    pub(super) corner: String,
    /// What the only section shows, if it has no title.
    pub(super) subject: String,
    pub(super) groups: Vec<Group>,
    pub(super) sections: Vec<Section>,
}

/// Neighbouring columns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    /// The heading over all of them.
    pub(super) head: Option<Label>,
    pub(super) columns: Vec<Label>,
}

/// Rows that belong together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Section {
    /// The line above the rows; empty for none.
    pub(super) title: String,
    pub(super) rows: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) label: Label,
    /// Whether the row sums up those before or after it.
    pub(super) is_average: bool,
    /// One cell per column.
    pub(super) cells: Vec<Cell>,
}

/// The heading of a row or column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Label {
    Name(String),
    /// A measure, with its index.
    Measure(usize, Measure),
}

impl Label {
    /// The heading as text. A measure has its unit and an arrow.
    pub(super) fn heading(&self) -> String {
        match self {
            Self::Name(name) => name.clone(),
            Self::Measure(_, measure) => measure.heading(),
        }
    }
}

impl Grid {
    /// The number of columns besides the first.
    pub(super) fn columns(&self) -> usize {
        self.groups.iter().map(|group| group.columns.len()).sum()
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = &Row> {
        self.sections.iter().flat_map(|section| &section.rows)
    }

    /// All cells, row by row.
    pub(super) fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.rows().flat_map(|row| &row.cells)
    }

    /// The heading of the first column. A table of one scene has the scene's name there.
    pub(super) fn first_heading(&self) -> &str {
        if self.subject.is_empty() { &self.corner } else { &self.subject }
    }

    /// Whether columns have a heading over them.
    pub(super) fn has_group_heads(&self) -> bool {
        self.groups.iter().any(|group| group.head.is_some())
    }
}
