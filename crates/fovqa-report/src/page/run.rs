//! The page of a run, `report.html`.

use askama::Template;
use fovqa_results::{ErrorRecord, Input, Inputs, RESULTS_CSV, RESULTS_PARQUET, RunRecord};

use super::conditions::Conditions;
use super::figure::PageFigure;
use super::shell::Shell;
use super::table::PageTable;
use super::verdict::PageVerdict;
use crate::frame_values::FrameValues;
use crate::overview::Overview;
use crate::plain_table::grouped;
use crate::run_table::RunTable;

/// Maximum number of errors that the page lists.
const MOST_ERRORS: usize = 100;
/// Maximum number of input files that the page lists.
const MOST_INPUTS: usize = 200;
/// Maximum length of the resolved experiment on the page. A large sweep has megabytes.
const MOST_BYTES: usize = 1 << 20;
/// Number of parts up to which the page has no table of contents.
const MOST_PARTS_WITHOUT_CONTENTS: usize = 3;

/// The first input files of a run. A long sequence has very many, and only these are kept.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PageInputs {
    /// The files, and their sizes as people read them.
    first: Vec<(Input, String)>,
    all: usize,
}

impl PageInputs {
    pub(crate) fn of(inputs: &Inputs) -> Self {
        let first = inputs.all().take(MOST_INPUTS).map(|input| {
            let bytes = grouped(input.bytes as f64);
            (input, bytes)
        });
        Self { first: first.collect(), all: inputs.len() }
    }
}

/// The errors of a run, or its likely mistakes, in words.
struct PageErrors {
    first: Vec<String>,
    all: usize,
}

#[derive(Template)]
#[template(path = "run.html")]
struct RunPage<'a> {
    shell: Shell,
    run: &'a RunRecord,
    /// How many scenes, methods and frames there are.
    counts: String,
    /// The files with all values.
    value_files: Vec<&'static str>,
    /// The verdict of its gate.
    verdict: Option<PageVerdict>,
    /// The parts of the page: their places and their names.
    parts: Vec<(String, String)>,
    conditions: Conditions,
    errors: PageErrors,
    /// Likely mistakes in pairs that were scored.
    mistakes: PageErrors,
    /// The tables that readers look for first.
    tables: Vec<PageTable>,
    long_tables: Vec<PageTable>,
    figures: &'a [PageFigure<'a>],
    /// The data of the viewer of frames as JSON without `<`; `None` for no viewer.
    viewer: Option<String>,
    /// The experiment with all defaults; `None` if it is too long.
    resolved: Option<String>,
    inputs: &'a PageInputs,
    inputs_in_words: String,
}

/// Makes the page of a run. `viewer` is the data of the viewer of frames as JSON.
pub(crate) fn run_page(
    (run, inputs): (&RunRecord, &PageInputs),
    (overview, values, verdict): (&Overview, &FrameValues, Option<PageVerdict>),
    tables: &[(String, RunTable)],
    figures: &[PageFigure<'_>],
    viewer: Option<String>,
) -> String {
    let (first, others) = in_order(tables);
    let own = overview.all().iter().filter(|measured| !measured.is_of_both_eyes);
    let scored: usize = own.map(|measured| measured.frames).sum();
    let resolved = serde_json::to_string_pretty(&run.resolved).unwrap_or_default();
    let name = &run.resolved.name;
    let page = RunPage {
        shell: if viewer.is_some() { Shell::with_viewer(name) } else { Shell::new(name) },
        run,
        counts: format!(
            "{}, {}, {}",
            count(run.resolved.scenes.len(), "scene"),
            count(run.resolved.methods.len(), "method"),
            count(scored, "frame"),
        ),
        value_files: value_files(run),
        parts: {
            let verdict = verdict.iter().map(|_| ("verdict".to_owned(), "Verdict".to_owned()));
            verdict.chain(parts(&first, figures, viewer.is_some(), &others)).collect()
        },
        verdict,
        conditions: Conditions::of(run, overview, values),
        errors: PageErrors {
            first: overview.errors.iter().take(MOST_ERRORS).map(in_words).collect(),
            all: overview.errors.len(),
        },
        mistakes: PageErrors {
            first: overview.mistakes.iter().take(MOST_ERRORS).cloned().collect(),
            all: overview.mistakes.len(),
        },
        tables: first,
        long_tables: others,
        figures,
        viewer: viewer.map(|json| inside_script(&json)),
        resolved: Some(resolved).filter(|resolved| resolved.len() <= MOST_BYTES),
        inputs,
        inputs_in_words: count(inputs.all, "input file"),
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}

/// The tables that come before the figures, and those that come after them. If no table compares
/// methods by scenes, the first one comes before.
fn in_order(tables: &[(String, RunTable)]) -> (Vec<PageTable>, Vec<PageTable>) {
    let is_first =
        |index: usize, table: &RunTable| table.is_of_scenes() && (index == 0 || !table.is_long());
    let none = !tables.iter().enumerate().any(|(index, (_, table))| is_first(index, table));
    let (mut first, mut others) = (Vec::new(), Vec::new());
    for (index, (name, table)) in tables.iter().enumerate() {
        let on_page = PageTable::of_run(name, table);
        if is_first(index, table) || none && index == 0 {
            first.push(on_page);
        } else {
            others.push(on_page);
        }
    }
    (first, others)
}

fn parts(
    tables: &[PageTable],
    figures: &[PageFigure<'_>],
    has_viewer: bool,
    others: &[PageTable],
) -> Vec<(String, String)> {
    let part = |place: &str, name: &str| (place.to_owned(), name.to_owned());
    let of_table = |table: &PageTable| (table.name.clone(), table.caption.clone());
    let mut parts = vec![part("conditions", "Conditions")];
    parts.extend(tables.iter().map(of_table));
    parts.extend((!figures.is_empty()).then(|| part("figures", "Figures")));
    parts.extend(has_viewer.then(|| part("viewer", "Viewer")));
    parts.extend(others.iter().map(of_table));
    parts.push(part("experiment", "Experiment"));
    parts
}

fn in_words(error: &ErrorRecord) -> String {
    let frame = error.frame.map(|frame| format!(", frame {frame}")).unwrap_or_default();
    let eye = if error.eye.is_empty() { String::new() } else { format!(", {} eye", error.eye) };
    format!("{}, {}{eye}{frame}: {}", error.scene, error.label(), error.message)
}

/// JSON that cannot end the element that it is in. Within JSON, `<` is only in texts.
fn inside_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

/// The files with all values.
fn value_files(run: &RunRecord) -> Vec<&'static str> {
    // A record that somebody edited may have any names: only those of fovqa become links.
    let mut tables = vec![RESULTS_CSV, RESULTS_PARQUET];
    tables.retain(|name| run.files.contains_key(*name));
    if tables.is_empty() {
        // Earlier versions wrote this file without recording the formats.
        tables.push(RESULTS_CSV);
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_of_the_viewer_cannot_end_its_element() {
        let json = serde_json::json!({ "scene": "</script><!--" });
        let embedded = inside_script(&json.to_string());
        assert!(!embedded.contains('<'), "{embedded}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&embedded).unwrap(), json);
    }
}
