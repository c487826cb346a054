//! The page of a curves file.

use askama::Template;

use super::Source;
use crate::page::{PageFigure, PageTable, Shell};
use crate::plain_table::PlainTable;
use crate::sentence::sentence;

#[derive(Template)]
#[template(path = "curves.html")]
struct CurvesPage<'a> {
    shell: Shell,
    about: &'a str,
    figures: &'a [PageFigure<'a>],
    tables: Vec<PageTable>,
    notes: Vec<String>,
    version: &'static str,
}

pub(super) fn page(
    source: &Source<'_>,
    tables: &[(String, PlainTable)],
    figures: &[PageFigure<'_>],
) -> String {
    let file = source.file;
    let mut notes: Vec<&String> = file.plan.left_out.iter().collect();
    if tables.is_empty() {
        for note in source.curves.iter().flat_map(|curve| &curve.notes) {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }
    let page = CurvesPage {
        shell: Shell::new(&file.name),
        about: &file.about,
        figures,
        tables: tables.iter().map(|(name, table)| PageTable::plain(name, table)).collect(),
        notes: notes.into_iter().map(|note| sentence(note)).collect(),
        version: env!("CARGO_PKG_VERSION"),
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}
