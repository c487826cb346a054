//! Figures, tables and the page of a study file.

use std::path::{Path, PathBuf};

use askama::Template;
use fovqa_plan::{StudyAnalysis, StudyFile};
use fovqa_results::{CsvNames, STUDIES_SCHEMA, STUDY_JSON, write_whole};
use fovqa_study::Analysis;
use serde::Serialize;

use super::figures::figures;
use super::parts::Part;
use super::printed::{self, ResultOfPrinted};
use super::{joined_parts, study_text};
use crate::figures::slug;
use crate::latex::usual_label;
use crate::page::{PageFigure, PageTable, Shell};
use crate::plain_table::PlainTable;
use crate::sentence::sentence;
use crate::sheet::{
    MakeText, NamedFigure, NamedTable, Names, PLOTS, ReportError, Sheet, drawn_before,
};
use crate::steps::BeginStep;
use crate::text::Text;

/// One analysis of a study file, and its result.
#[derive(Debug, Clone, PartialEq)]
pub struct AnsweredAnalysis<'a> {
    /// The analysis.
    pub of: &'a StudyAnalysis,
    /// Its result.
    pub result: Analysis,
    /// Its printed numbers, with the results that they are compared with.
    pub printed: Vec<ResultOfPrinted>,
}

/// What was made of a study file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawnStudy {
    /// The tables, for a terminal.
    pub text: Text,
    /// The results as JSON.
    pub json: String,
    /// Number of figures.
    pub figures: usize,
    /// What the user should know of the figures.
    pub warnings: Vec<String>,
}

/// The JSON of a study file.
#[derive(Serialize)]
struct Record<'a> {
    schema: &'static str,
    version: &'static str,
    name: &'a str,
    about: &'a str,
    analyses: Vec<RecordedAnalysis<'a>>,
}

#[derive(Serialize)]
struct RecordedAnalysis<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    title: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scores: Option<String>,
    confidence: f64,
    bootstrap: usize,
    seed: u64,
    result: &'a Analysis,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    printed: &'a [ResultOfPrinted],
}

/// The tables and remarks of one analysis, with the names of their files.
struct Section<'a> {
    of: &'a StudyAnalysis,
    tables: Vec<(String, PlainTable)>,
    remarks: Vec<String>,
    /// The beginning of the names of its figures.
    figures: Vec<String>,
}

/// The figures, tables and page of a study, which are not yet written.
pub struct StudySheet<'a> {
    file: &'a StudyFile,
    answers: &'a [AnsweredAnalysis<'a>],
    sections: Vec<Section<'a>>,
    figures: Vec<NamedFigure>,
}

impl<'a> StudySheet<'a> {
    /// The figures and tables of the analyses of a file.
    pub fn new(file: &'a StudyFile, answers: &'a [AnsweredAnalysis<'a>]) -> Self {
        let (sections, figures) = sections(answers);
        Self { file, answers, sections, figures }
    }

    /// The first file in a folder that would be replaced although no report of fovqa wrote it.
    pub fn foreign(&self, folder: &Path) -> Option<PathBuf> {
        let tables = self.sections.iter().flat_map(|section| &section.tables);
        let tables = tables
            .flat_map(|(name, _)| ["md", "csv", "tex"].map(|ending| format!("{name}.{ending}")));
        let figures = self.figures.iter().flat_map(|figure| {
            figure.endings().map(|ending| format!("{PLOTS}/{}.{ending}", figure.name))
        });
        let known = drawn_before(folder);
        let is_foreign = |file: &String| !known.contains(file) && folder.join(file).exists();
        tables.chain(figures).find(is_foreign).map(|file| folder.join(file))
    }

    /// Writes everything, and the results, into the folder of the study. Each step is begun with
    /// `begin`.
    ///
    /// # Errors
    /// If the folder cannot be written to, or a figure does not fit into the size that was asked for.
    pub fn write(self, folder: &Path, begin: &BeginStep<'_>) -> Result<DrawnStudy, ReportError> {
        let Self { file, answers, sections, figures } = self;
        let labelled = slug(&file.name);
        let tables = sections.iter().flat_map(|section| &section.tables).map(|(name, table)| {
            let markdown: MakeText<'_> = Box::new(|| table.markdown());
            let latex: MakeText<'_> = Box::new(|| table.latex(&usual_label(&labelled, name)));
            let files = vec![("md", markdown), ("csv", Box::new(|| table.csv())), ("tex", latex)];
            NamedTable { name, files }
        });
        let sheet = Sheet {
            tables: tables.collect(),
            figures,
            page: Box::new(|figures| page(file, &sections, figures)),
            forward: None,
            names: CsvNames::Plain,
        };
        let warnings = sheet.write(folder, begin)?;
        let json = study_json(file, answers);
        // Last: a folder that was not finished has none.
        write_whole(&folder.join(STUDY_JSON), json.as_bytes())?;
        Ok(DrawnStudy { text: text(answers), json, figures: sheet.figures.len(), warnings })
    }
}

/// The tables, remarks and figures of all analyses.
fn sections<'a>(answers: &[AnsweredAnalysis<'a>]) -> (Vec<Section<'a>>, Vec<NamedFigure>) {
    let mut names = Names::default();
    let (mut sections, mut figures) = (Vec::new(), Vec::new());
    for answer in answers {
        let (section, of_section) = section(answer, &mut names);
        figures.extend(of_section);
        sections.push(section);
    }
    (sections, figures)
}

/// The tables, remarks and figures of an analysis.
fn section<'a>(
    answer: &AnsweredAnalysis<'a>,
    names: &mut Names,
) -> (Section<'a>, Vec<NamedFigure>) {
    let of = answer.of;
    let begin = match slug(&of.name) {
        name if name.is_empty() => of.request.kind().to_owned(),
        name => name,
    };
    let (mut tables, mut remarks) = (Vec::new(), excluded(&answer.result));
    for part in printed::part(&answer.printed).into_iter().chain(joined_parts(&answer.result)) {
        match part {
            Part::Remark(text) => {
                remarks.push(sentence(text.strip_prefix("note: ").unwrap_or(&text)));
            }
            Part::Table { name, table, .. } => {
                tables.push((names.free(&format!("table-{begin}-{name}")), table));
            }
        }
    }
    let mut drawn = figures(&answer.result, &begin, &of.settings);
    for figure in &mut drawn {
        figure.name = names.free(&figure.name);
        figure.settings = of.figure.clone();
    }
    let figures = drawn.iter().map(|figure| format!("{PLOTS}/{}", figure.name)).collect();
    (Section { of, tables, remarks, figures }, drawn)
}

/// Which participants were left out.
fn excluded(result: &Analysis) -> Vec<String> {
    let excluded = result.excluded();
    let text = || format!("Excluded participants: {}.", excluded.join(", "));
    if excluded.is_empty() { Vec::new() } else { vec![text()] }
}

/// A path as the file names it, so that it does not depend on the working directory.
fn shown(file: &StudyFile, path: &Path) -> String {
    let base = file.path.parent().unwrap_or(Path::new(""));
    path.strip_prefix(base).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

fn record<'a>(file: &'a StudyFile, answers: &'a [AnsweredAnalysis<'_>]) -> Record<'a> {
    // As the file names them, so that they do not depend on the working directory.
    let base = file.path.parent().unwrap_or(Path::new(""));
    let shown =
        |path: &Path| path.strip_prefix(base).unwrap_or(path).to_string_lossy().replace('\\', "/");
    let analyses =
        answers.iter().map(|AnsweredAnalysis { of, result, printed }| RecordedAnalysis {
            name: &of.name,
            title: of.title.as_deref(),
            file: of.table.as_deref().map(shown),
            scores: of.scores.as_deref().map(shown),
            confidence: of.settings.confidence,
            bootstrap: of.settings.bootstrap,
            seed: of.settings.seed,
            result,
            printed,
        });
    Record {
        schema: STUDIES_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        name: &file.name,
        about: &file.about,
        analyses: analyses.collect(),
    }
}

/// The JSON of a study file.
fn study_json(file: &StudyFile, answers: &[AnsweredAnalysis<'_>]) -> String {
    serde_json::to_string_pretty(&record(file, answers)).unwrap_or_default() + "\n"
}

/// The tables of all analyses, for a terminal.
fn text(answers: &[AnsweredAnalysis<'_>]) -> Text {
    let mut text = Text::default();
    for answer in answers {
        let title = answer.of.title.as_ref().unwrap_or(&answer.of.name);
        let title = crate::text_table::printable(title);
        let line = "=".repeat(title.chars().count());
        let joint = if text.is_empty() { "" } else { "\n" };
        text.push_str(&[joint, &title, "\n", &line, "\n\n"].concat());
        if let Some(Part::Table { table, .. }) = printed::part(&answer.printed) {
            text.push_str(&[&table.caption, "\n"].concat());
            text.push_table(table.terminal());
            text.push_str("\n");
        }
        text.push(study_text(&answer.result));
    }
    text
}

/// What an analysis was made of, in a line.
fn made_of(study: &StudyFile, of: &StudyAnalysis) -> String {
    let mut parts = vec![format!("Analysis: {}", of.request.kind())];
    let file = |path: &PathBuf| {
        path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
    };
    parts.extend(of.table.as_ref().map(file));
    parts.extend(of.scores.as_ref().map(|path| format!("scores of {}", shown(study, path))));
    parts.extend(of.selection.filters.iter().map(|(column, value)| format!("{column} = {value}")));
    if !of.selection.by.is_empty() {
        parts.push(format!("by {}", of.selection.by.join(", ")));
    }
    let settings = &of.settings;
    parts.push(format!("{} % intervals", 100.0 * settings.confidence));
    parts.push(format!("{} bootstrap replicates, seed {}", settings.bootstrap, settings.seed));
    format!("{}.", parts.join("; "))
}

#[derive(Template)]
#[template(path = "study.html")]
struct StudyPage<'a> {
    shell: Shell,
    about: &'a str,
    sections: Vec<PageSection<'a>>,
    version: &'static str,
}

struct PageSection<'a> {
    /// The name of its place on the page.
    name: String,
    title: &'a str,
    made_of: String,
    remarks: &'a [String],
    tables: Vec<PageTable>,
    figures: Vec<&'a PageFigure<'a>>,
}

fn page(file: &StudyFile, sections: &[Section<'_>], figures: &[PageFigure<'_>]) -> String {
    let sections = sections.iter().enumerate();
    let page = StudyPage {
        shell: Shell::new(&file.name),
        about: &file.about,
        sections: sections.map(|(index, of)| PageSection::new(file, index, of, figures)).collect(),
        version: env!("CARGO_PKG_VERSION"),
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}

impl<'a> PageSection<'a> {
    fn new(
        file: &StudyFile,
        index: usize,
        section: &'a Section<'_>,
        figures: &'a [PageFigure<'a>],
    ) -> Self {
        // A figure that could not be drawn is missing.
        let is_own = |figure: &&PageFigure<'_>| section.figures.contains(&figure.path);
        let tables = section.tables.iter().map(|(name, table)| PageTable::in_section(name, table));
        Self {
            name: format!("analysis-{}", index + 1),
            title: section.of.title.as_ref().unwrap_or(&section.of.name),
            made_of: made_of(file, section.of),
            remarks: &section.remarks,
            tables: tables.collect(),
            figures: figures.iter().filter(is_own).collect(),
        }
    }
}
