//! The page of a curves file.

use std::fmt::Write;

use super::Source;
use super::tables::sentence;
use crate::escaped::escaped;
use crate::page::{PageFigure, begin, end, figures as figures_html};
use crate::plain_table::PlainTable;

pub(super) fn page(
    source: &Source<'_>,
    tables: &[(String, PlainTable)],
    figures: &[PageFigure<'_>],
) -> String {
    let file = source.file;
    let mut text = begin(&file.name);
    if !file.about.is_empty() {
        let _ = writeln!(text, "<p>{}</p>", escaped(&file.about));
    }
    text.push_str(
        "<p class=\"note\">All values: <a href=\"curves.csv\">curves.csv</a>, \
         <a href=\"curves.json\">curves.json</a>.</p>\n",
    );
    figures_html(&mut text, figures);
    for (name, table) in tables {
        let _ = write!(
            text,
            "<h2>{}</h2>\n<div class=\"wide\">\n{}</div>\n<p class=\"note\">{} (<a href=\"{name}.md\">Markdown</a>, \
             <a href=\"{name}.tex\">LaTeX</a>, <a href=\"{name}.csv\">CSV</a>)</p>\n",
            escaped(&table.caption),
            table.html(),
            escaped(&table.notes.join(" ")),
            name = escaped(name),
        );
    }
    let mut notes: Vec<&String> = file.plan.left_out.iter().collect();
    if tables.is_empty() {
        for note in source.curves.iter().flat_map(|curve| &curve.notes) {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }
    for note in notes {
        let _ = writeln!(text, "<p class=\"note\">{}</p>", escaped(&sentence(note)));
    }
    end(&mut text, &format!("fovqa {}", env!("CARGO_PKG_VERSION")));
    text
}
