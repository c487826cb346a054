//! Resolves a study file: its analyses with their options.

mod opinions;
mod options;
mod requests;

use std::ops::Range;
use std::path::{Path, PathBuf};

use fovqa_plan::{FigureSettings, PrintedNumber, StudyAnalysis, StudyFile};
use fovqa_study::input::Selection;
use fovqa_study::{Request, Settings};

use super::figures::figure;
use crate::fault::{Fault, Faults};
use crate::node::Node;
pub(super) use opinions::opinions;
use options::{assignments, has_only, names};
use requests::request;

/// The study. Mistakes are added to `faults`.
pub(crate) fn study(root: Node<'_>, path: &Path, faults: &mut Faults) -> StudyFile {
    let text = |key| root.text(key).unwrap_or_default().to_owned();
    let base = path.parent().map(Path::to_owned).unwrap_or_default();
    let figures = figure(root.table("figures"), &FigureSettings::default(), faults);
    let mut analyses: Vec<StudyAnalysis> = Vec::new();
    for (table, span) in root.tables("analysis") {
        let Some(found) = analysis(table, span, (&base, &figures), faults) else { continue };
        match analyses.iter().find(|other| other.name.to_lowercase() == found.name.to_lowercase()) {
            Some(other) => {
                let message = format!("there are two analyses named \"{}\"", other.name);
                let span = if table.has("name") { table.span("name") } else { table.span("kind") };
                let fault = Fault::new(span, message).label("the second");
                faults.push(fault.help(
                    "add name = \"…\": the names of its files begin with it; without one, the name is the kind",
                ));
            }
            None => analyses.push(found),
        }
    }
    if root.tables("analysis").is_empty() {
        let fault = Fault::new(root.span("analysis"), "the study has no analysis");
        faults.push(fault.help("add [[analysis]] with kind and file"));
    }
    StudyFile { name: text("name"), about: text("about"), path: path.to_owned(), analyses }
}

/// An analysis; `None` if it lacks something.
fn analysis(
    table: Node<'_>,
    span: Range<usize>,
    (base, figures): (&Path, &FigureSettings),
    faults: &mut Faults,
) -> Option<StudyAnalysis> {
    has_only(table, faults)?;
    let request = request(table, span.clone(), faults)?;
    let text = |key| table.text(key).map(str::to_owned);
    let file = |key| table.text(key).map(|path| base.join(path));
    let is_plan = matches!(request, Request::PlanPairs(_) | Request::PlanStaircase(_));
    let is_predicted = matches!(request, Request::PlanPredicted(_));
    if !is_plan && !is_predicted && !table.has("file") {
        let fault = Fault::new(span, "the analysis has no file");
        faults.push(fault.help("add file = \"answers.csv\": the table of answers"));
        return None;
    }
    Some(StudyAnalysis {
        name: text("name").unwrap_or_else(|| request.kind().to_owned()),
        title: text("title"),
        table: file("file"),
        scores: file("scores").or_else(|| Some(results_of(&file("results")?))),
        selection: Selection {
            by: names(table, "by"),
            filters: assignments(table, "where", faults),
            columns: assignments(table, "column", faults),
        },
        settings: settings(table),
        printed: printed(table, faults),
        figure: figure(table.table("figure"), figures, faults),
        request,
    })
}

/// The scores in the results folder of a run.
fn results_of(folder: &Path) -> PathBuf {
    folder.join("results.csv")
}

fn settings(table: Node<'_>) -> Settings {
    let default = Settings::default();
    Settings {
        confidence: table.number("confidence").unwrap_or(default.confidence),
        adjust: table.word("adjust").unwrap_or(default.adjust),
        bootstrap: table.number("bootstrap").map_or(default.bootstrap, |count| count as usize),
        seed: table.number("seed").map_or(default.seed, |seed| seed as u64),
    }
}

fn printed(table: Node<'_>, faults: &mut Faults) -> Vec<PrintedNumber> {
    let one = |(table, _): (Node<'_>, Range<usize>)| {
        let text = |key| table.text(key).unwrap_or_default().to_owned();
        if !text("at").starts_with('/') {
            let fault = Fault::new(table.span("at"), "at does not begin with /");
            faults.push(fault.help(
                "write the place in the JSON that `fovqa study … --format json` prints, such as \"/groups/0/pairs/0/p_two_sided\"",
            ));
        }
        PrintedNumber {
            quantity: text("quantity"),
            place: text("place"),
            value: text("value"),
            at: text("at"),
            note: text("note"),
            independent: table.flag("independent").unwrap_or(true),
        }
    };
    table.tables("printed").into_iter().map(one).collect()
}
