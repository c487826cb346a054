//! Tables of a page, with captions and remarks.

use askama::Template;

use crate::html_table::HtmlTable;
use crate::plain_table::PlainTable;
use crate::run_table::RunTable;

/// A table with its caption, its remarks, and links to its files.
#[derive(Debug, Clone, PartialEq, Template)]
#[template(path = "captioned_table.html")]
pub(crate) struct PageTable {
    /// The name of its files without ending, which is also its place on the page.
    pub(crate) name: String,
    pub(crate) caption: String,
    /// The level of its heading: 2, or 3 below a heading of its own.
    level: u8,
    /// `None` if it is too large for a page.
    table: Option<HtmlTable>,
    notes: String,
}

impl PageTable {
    /// A table of a run.
    pub(crate) fn of_run(name: &str, table: &RunTable) -> Self {
        let legend = Some(table.html_legend()).filter(|legend| !legend.is_empty());
        let notes: Vec<String> = legend.into_iter().chain(table.notes()).collect();
        Self {
            name: name.to_owned(),
            caption: table.caption().to_owned(),
            level: 2,
            table: table.html(),
            notes: notes.join(" "),
        }
    }

    /// A plain table.
    pub(crate) fn plain(name: &str, table: &PlainTable) -> Self {
        Self {
            name: name.to_owned(),
            caption: table.caption.clone(),
            level: 2,
            table: table.html(),
            notes: table.notes.join(" "),
        }
    }

    /// A plain table in a section that has a heading.
    pub(crate) fn in_section(name: &str, table: &PlainTable) -> Self {
        // Notes are parts of sentences.
        let notes = table.notes.join("; ");
        Self { level: 3, notes, ..Self::plain(name, table) }
    }
}
