//! A table of a run, of either form.

use crate::comparison::ComparisonTable;
use crate::html_table::HtmlTable;
use crate::plain_table::PlainTable;
use crate::text::Text;

/// A table of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum RunTable {
    /// Methods against metrics, or against eccentricity bands.
    Comparison(ComparisonTable),
    /// A list of names and numbers.
    Plain(Box<PlainRunTable>),
}

/// A plain table with its label in LaTeX.
#[derive(Debug, Clone, PartialEq)]
pub struct PlainRunTable {
    pub(crate) table: PlainTable,
    pub(crate) label: String,
}

impl RunTable {
    pub(crate) fn plain(table: PlainTable) -> Self {
        Self::Plain(Box::new(PlainRunTable { table, label: String::new() }))
    }

    /// The table with another label in LaTeX.
    pub(crate) fn labelled(self, label: String) -> Self {
        match self {
            Self::Comparison(table) => Self::Comparison(table.labelled(label)),
            Self::Plain(plain) => Self::Plain(Box::new(PlainRunTable { label, ..*plain })),
        }
    }

    /// The caption of the table.
    pub fn caption(&self) -> &str {
        match self {
            Self::Comparison(table) => table.caption(),
            Self::Plain(plain) => &plain.table.caption,
        }
    }

    /// Remarks that must be shown together with the numbers.
    pub(crate) fn notes(&self) -> Vec<String> {
        match self {
            Self::Comparison(table) => table.notes(),
            Self::Plain(plain) => plain.table.notes.clone(),
        }
    }

    /// Text for a terminal.
    pub fn terminal(&self) -> Text {
        match self {
            Self::Comparison(table) => table.terminal(),
            Self::Plain(plain) => {
                let mut text = Text::from(format!("{}\n\n", plain.table.caption));
                text.push_table(plain.table.terminal());
                text
            }
        }
    }

    pub(crate) fn markdown(&self) -> String {
        match self {
            Self::Comparison(table) => table.markdown(),
            Self::Plain(plain) => plain.table.markdown(),
        }
    }

    pub(crate) fn csv(&self) -> String {
        match self {
            Self::Comparison(table) => table.csv(),
            Self::Plain(plain) => plain.table.csv(),
        }
    }

    pub(crate) fn latex(&self) -> String {
        match self {
            Self::Comparison(table) => table.latex(),
            Self::Plain(plain) => plain.table.latex(&plain.label),
        }
    }

    /// Whether it scrolls in a box of its own.
    pub(crate) fn is_long(&self) -> bool {
        match self {
            Self::Comparison(table) => table.is_long(),
            Self::Plain(plain) => plain.table.is_long(),
        }
    }

    /// Its layout in HTML; `None` if it is too large for a page.
    pub(crate) fn html(&self) -> Option<HtmlTable> {
        match self {
            Self::Comparison(table) => table.html(),
            Self::Plain(plain) => plain.table.html(),
        }
    }

    /// Whether it compares methods by scenes, which is what readers look for first.
    pub(crate) fn is_of_scenes(&self) -> bool {
        match self {
            Self::Comparison(table) => table.is_of_scenes(),
            Self::Plain(_) => false,
        }
    }

    /// What the marks on the page mean.
    pub(crate) fn html_legend(&self) -> String {
        match self {
            Self::Comparison(table) => table.html_legend(),
            Self::Plain(_) => String::new(),
        }
    }
}
