//! The page of a run: a single HTML page with its tables and figures, which can be read without a
//! network.

use std::fmt::Write;

use fovqa_results::{RESULTS_CSV, RESULTS_PARQUET, RunRecord};

use crate::escaped::escaped;
use crate::overview::Overview;
use crate::run_table::RunTable;

/// Maximum number of errors that the page lists.
const MOST_ERRORS: usize = 100;

/// A figure on the page.
pub(crate) struct PageFigure<'a> {
    /// Its path relative to the page, without the file extension.
    pub(crate) path: String,
    pub(crate) caption: &'a str,
    /// The endings of its files; the first one is a picture.
    pub(crate) endings: Vec<&'static str>,
    /// Its width in pixels.
    pub(crate) width_px: f64,
}

const STYLE: &str = "\
body{font:16px/1.5 system-ui,sans-serif;color:#222;max-width:1280px;margin:2em auto;padding:0 1em}
h1{font-size:1.6em;margin-bottom:.2em}h2{font-size:1.2em;margin-top:2em}
p.note,figcaption,footer{color:#555;font-size:.9em}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9em}
th,td{padding:.25em .7em;text-align:right;white-space:nowrap}
thead th{text-align:center;font-weight:600}tbody th{text-align:left;font-weight:400}
thead tr:last-child th{font-weight:400;border-bottom:1px solid #888;text-align:right}
thead tr:first-child th:first-child{border-bottom:1px solid #888;text-align:left;vertical-align:bottom}
td.first{padding-left:1.8em}tr.average>*{border-top:1px solid #ccc}
thead th.corner{text-align:left!important}u{text-decoration-thickness:1px;text-underline-offset:.2em}
tr.section th{font-style:italic;padding-top:.6em}tr.section:not(:first-child) th{border-top:1px solid #ccc}
.figures{display:flex;flex-wrap:wrap;gap:1.5em}
img.small{max-width:380px;max-height:320px}figure{margin:0}figure img{max-width:100%}
.errors li{color:#a00}
code{background:#f3f3f3;padding:0 .2em}
";

/// Additional style for tables with very many rows or columns.
const LONG_STYLE: &str = "\
.long{overflow:auto;max-height:80vh}.long thead{position:sticky;top:0;z-index:1;background:#fff}
.long tbody th{position:sticky;left:0;background:#fff}
";

/// Makes the page of a run with this number of inputs.
pub(crate) fn page(
    (run, inputs): (&RunRecord, usize),
    overview: &Overview,
    tables: &[(String, RunTable)],
    figures: &[PageFigure<'_>],
) -> String {
    let is_long = tables.iter().any(|(_, table)| table.is_long());
    let mut text = begin_with(&run.resolved.name, if is_long { LONG_STYLE } else { "" });
    if let Some(about) = &run.resolved.about {
        let _ = writeln!(text, "<p>{}</p>", escaped(about));
    }
    let own = overview.all().iter().filter(|measured| !measured.is_of_both_eyes);
    let scored: usize = own.map(|measured| measured.frames).sum();
    let _ = writeln!(
        text,
        "<p class=\"note\">{}, {}, {} scored. All values: {}, \
         <a href=\"summary.json\">summary.json</a>, <a href=\"run.json\">run.json</a>.</p>",
        count(run.resolved.scenes.len(), "scene"),
        count(run.resolved.methods.len(), "method"),
        count(scored, "frame"),
        table_links(run),
    );
    if !overview.errors.is_empty() {
        let _ = writeln!(text, "<h2>Not scored</h2>\n<ul class=\"errors\">");
        for error in overview.errors.iter().take(MOST_ERRORS) {
            let frame = error.frame.map(|frame| format!(", frame {frame}")).unwrap_or_default();
            let eye =
                if error.eye.is_empty() { String::new() } else { format!(", {} eye", error.eye) };
            let place = format!("{}, {}{eye}{frame}", error.scene, error.label());
            let _ = writeln!(text, "<li>{}: {}</li>", escaped(&place), escaped(&error.message));
        }
        text.push_str("</ul>\n");
        if overview.errors.len() > MOST_ERRORS {
            let more = overview.errors.len() - MOST_ERRORS;
            let _ = writeln!(text, "<p class=\"note\">{more} more are in summary.json.</p>");
        }
    }
    for (name, table) in tables {
        self::table(&mut text, name, table);
    }
    if !figures.is_empty() {
        text.push_str("<h2>Figures</h2>\n");
    }
    self::figures(&mut text, figures);
    let made = format!(
        "fovqa {}; experiment <code>{}</code>, SHA-256 <code>{}</code>; {}",
        escaped(&run.version),
        escaped(&run.experiment.file),
        escaped(&run.experiment.sha256),
        count(inputs, "input file"),
    );
    end(&mut text, &made);
    text
}

/// Writes a table. One of very many rows or columns is in a box that scrolls; the page only links to
/// one that is too large.
fn table(text: &mut String, name: &str, table: &RunTable) {
    let name = escaped(name);
    let _ = writeln!(text, "<h2>{}</h2>", escaped(table.caption()));
    let too_large = match table.html() {
        Some(html) => {
            let class = if table.is_long() { "long" } else { "wide" };
            let _ = writeln!(text, "<div class=\"{class}\">\n{html}</div>");
            ""
        }
        None => "The table is too large for a page. ",
    };
    let legend = Some(table.html_legend()).filter(|legend| !legend.is_empty());
    let notes: Vec<String> = legend.into_iter().chain(table.notes()).collect();
    let _ = writeln!(
        text,
        "<p class=\"note\">{too_large}{} (<a href=\"{name}.md\">Markdown</a>, <a href=\"{name}.tex\">LaTeX</a>, \
         <a href=\"{name}.csv\">CSV</a>)</p>",
        escaped(&notes.join(" "))
    );
}

/// The beginning of the page up to its heading.
pub(crate) fn begin(name: &str) -> String {
    begin_with(name, "")
}

fn begin_with(name: &str, style: &str) -> String {
    let name = escaped(name);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{name}</title>\n\
         <style>\n{STYLE}{style}</style>\n</head>\n<body>\n<h1>{name}</h1>\n"
    )
}

/// Writes what made the page, and the end of the page.
pub(crate) fn end(text: &mut String, made: &str) {
    let _ = writeln!(text, "<footer><p>{made}.</p></footer>\n</body>\n</html>");
}

/// Writes figures with their captions, side by side if there is space.
pub(crate) fn figures(text: &mut String, figures: &[PageFigure<'_>]) {
    if figures.is_empty() {
        return;
    }
    text.push_str("<div class=\"figures\">\n");
    for PageFigure { path, caption, endings, width_px } in figures {
        let (path, caption) = (escaped(path), escaped(caption));
        let link =
            |ending: &&str| format!("<a href=\"{path}.{ending}\">{}</a>", ending.to_uppercase());
        let links = endings.iter().map(link).collect::<Vec<_>>().join(", ");
        // No browser shows a PDF as an image.
        let shown = endings.iter().find(|ending| ["svg", "png"].contains(*ending));
        let image = shown.map_or_else(String::new, |ending| {
            format!("<img src=\"{path}.{ending}\" width=\"{width_px:.0}\" alt=\"{caption}\">\n")
        });
        let _ =
            writeln!(text, "<figure>{image}<figcaption>{caption} ({links})</figcaption></figure>");
    }
    text.push_str("</div>\n");
}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

/// A path as a URL. Characters that are special in a URL or not plain ASCII are percent-encoded.
pub(crate) fn address(path: &str) -> String {
    let mut plain = String::new();
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' => {
                plain.push(char::from(byte));
            }
            byte => {
                let _ = write!(plain, "%{byte:02X}");
            }
        }
    }
    plain
}

/// Links to the files with all values.
fn table_links(run: &RunRecord) -> String {
    // A record that somebody edited may have any names: only those of fovqa become links.
    let mut tables = vec![RESULTS_CSV, RESULTS_PARQUET];
    tables.retain(|name| run.files.contains_key(*name));
    if tables.is_empty() {
        // Earlier versions wrote this file without recording the formats.
        tables.push(RESULTS_CSV);
    }
    let links = tables.iter().map(|name| format!("<a href=\"{name}\">{name}</a>"));
    links.collect::<Vec<_>>().join(", ")
}
