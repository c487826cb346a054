//! The metrics of a run against mean opinion scores.

use std::fs;
use std::path::Path;

use fovqa_metrics::{Better, Metric};
use fovqa_plan::Resolved;
use fovqa_results::{CsvNames, OPINIONS_CSV, RESULTS_CSV, STUDY_JSON, take_away, write_json_file};
use fovqa_study::input::Table;
use fovqa_study::{Analysis, Inputs, Request, metrics};

use super::figures::figures;
use super::joined_parts;
use super::parts::Part;
use crate::plain_table::PlainTable;
use crate::sheet::{NamedFigure, ReportError};

/// With what the names of its files begin.
const NAME: &str = "study";

/// What a run has about mean opinion scores.
#[derive(Debug, Default)]
pub(crate) struct StudyOfRun {
    pub(crate) tables: Vec<(String, PlainTable)>,
    pub(crate) figures: Vec<NamedFigure>,
    pub(crate) warning: Option<String>,
}

/// Compares the metrics of a run with its mean opinion scores, and writes the result into its folder. What
/// does not fit is a warning: the run has everything else.
///
/// # Errors
/// If the result cannot be written.
pub(crate) fn study_of_run(folder: &Path, run: &Resolved) -> Result<StudyOfRun, ReportError> {
    let Some(study) = &run.study else { return Ok(StudyOfRun::default()) };
    let read = |name: &str| {
        let bytes = fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
        Table::read(name, &bytes).map_err(|error| error.to_string())
    };
    let is_chosen = |metric: &Metric| {
        let is_scored = run.metrics.contains_key(metric.key());
        is_scored && (study.metrics.is_empty() || study.metrics.iter().any(|m| m == metric.key()))
    };
    let chosen: Vec<Metric> = run.metrics_in_order().into_iter().filter(is_chosen).collect();
    let keys = |keep: &dyn Fn(&Metric) -> bool| {
        let kept = chosen.iter().filter(|metric| keep(metric));
        kept.map(|metric| metric.key().to_owned()).collect::<Vec<String>>()
    };
    let answered = read(OPINIONS_CSV).and_then(|opinions| {
        let mut scores = read(RESULTS_CSV)?;
        let names = CsvNames::from(run);
        for column in ["scene", "method"] {
            scores.rewrite(column, |name| names.read(name).to_owned());
        }
        let scored = metrics::scored(&scores).map_err(|error| error.to_string())?;
        // A metric without a score of the whole image, such as energy by frequency, predicts nothing.
        let options = metrics::Options {
            metrics: keys(&|metric| {
                metric.info().better != Better::Neither
                    && scored.iter().any(|key| key == metric.key())
            }),
            lower_is_better: keys(&|metric| {
                metric.info().better == Better::Lower
                    && scored.iter().any(|key| key == metric.key())
            }),
        };
        if options.metrics.is_empty() {
            return Err(
                "no metric has a score of the whole image that is better if higher or lower"
                    .to_owned(),
            );
        }
        let inputs = Inputs { table: Some(&opinions), scores: Some(&scores) };
        let request = Request::Metrics(options);
        let answer = request.answer(inputs, &study.selection(), &study.settings());
        let answer = answer.map_err(|error| error.to_string())?;
        match &answer {
            Analysis::Metrics(document) if document.groups.iter().all(|g| g.result.n == 0) => {
                Err("no condition has an opinion score and a finite score of each metric"
                    .to_owned())
            }
            _ => Ok(answer),
        }
    });
    let analysis = match answered {
        Ok(analysis) => analysis,
        Err(why) => {
            // The user may have removed it already.
            let _ = take_away(&folder.join(STUDY_JSON));
            let warning = format!("the metrics are not compared with opinion scores: {why}");
            return Ok(StudyOfRun { warning: Some(warning), ..StudyOfRun::default() });
        }
    };
    write_json_file(&folder.join(STUDY_JSON), &analysis)?;
    Ok(of_analysis(&analysis, run))
}

fn of_analysis(analysis: &Analysis, run: &Resolved) -> StudyOfRun {
    let Some(study) = &run.study else { return StudyOfRun::default() };
    let (mut tables, mut remarks) = (Vec::new(), Vec::new());
    for part in joined_parts(analysis) {
        match part {
            Part::Table { name, table, .. } => tables.push((format!("table-{NAME}-{name}"), table)),
            Part::Remark(text) => remarks.push(text),
        }
    }
    if let Some((_, first)) = tables.first_mut() {
        first.notes.append(&mut remarks);
    }
    let figures = figures(analysis, NAME, &study.settings()).into_iter();
    let figures = figures.map(|figure| NamedFigure { settings: run.figures.clone(), ..figure });
    StudyOfRun { tables, figures: figures.collect(), warning: None }
}
