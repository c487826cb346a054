//! The comparison table of the papers (RMFR, Table 1): a row a scene, metrics side by side, within
//! each the methods, the best of each row marked, an average row at the end.

mod csv;
mod html;
mod latex;
mod markdown;
mod terminal;

use fovqa_config::Plot;
use fovqa_metrics::{Better, Metric};
use fovqa_results::{ComparisonSummary, RunRecord, SummaryRecord};

/// A table of means over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonTable {
    methods: Vec<String>,
    metrics: Vec<Metric>,
    rows: Vec<Row>,
    notes: Vec<String>,
}

const FOVEAL_NOTE: &str = "FPSNR and FSSIM: the papers print no constants for the foveal weight, \
                           so compare methods, not papers.";

#[derive(Debug, Clone, PartialEq)]
struct Row {
    label: String,
    /// Whether it is of all scenes together.
    average: bool,
    /// Metric by metric, within it method by method.
    cells: Vec<Vec<Cell>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    value: Option<f64>,
    best: bool,
}

impl ComparisonTable {
    /// The table a plot asks for: its scenes, methods and metric, or all. `None` where nothing was
    /// scored.
    pub fn new(run: &RunRecord, summary: &SummaryRecord, plot: &Plot) -> Option<Self> {
        let wanted = |names: &Option<Vec<String>>, name: &String| {
            names.as_ref().is_none_or(|names| names.contains(name))
        };
        let methods: Vec<String> =
            run.resolved.methods.iter().filter(|m| wanted(&plot.methods, m)).cloned().collect();
        let scenes: Vec<&str> = run
            .resolved
            .scenes
            .iter()
            .map(|scene| &scene.name)
            .filter(|name| wanted(&plot.scenes, name))
            .map(String::as_str)
            .collect();
        let scored =
            |metric: &Metric| summary.comparisons.iter().any(|c| c.metrics.contains_key(metric));
        let of_plot = |metric: &Metric| plot.metric.as_ref().is_none_or(|key| key == metric.key());
        let metrics: Vec<Metric> =
            Metric::ALL.into_iter().filter(|m| scored(m) && of_plot(m)).collect();
        if metrics.is_empty() || methods.is_empty() || scenes.is_empty() {
            return None;
        }
        let value = |scene: &str, method: &str, metric: Metric| {
            Some(overall(summary, scene, method)?.metrics.get(&metric)?.mean)
        };
        let mut rows: Vec<Row> = scenes
            .iter()
            .map(|scene| {
                let cells = metrics.iter().map(|&metric| {
                    marked(metric, methods.iter().map(|method| value(scene, method, metric)))
                });
                Row { label: (*scene).to_owned(), average: false, cells: cells.collect() }
            })
            .collect();
        rows.extend(average(&metrics, &rows));
        let mut notes = vec!["Means over frames; the best of each row is marked.".to_owned()];
        if metrics.contains(&Metric::Fpsnr) || metrics.contains(&Metric::Fssim) {
            notes.push(FOVEAL_NOTE.to_owned());
        }
        notes.extend(unequal_frames(summary, &scenes, &methods));
        notes.extend(identical_frames(summary, &scenes, &methods));
        Some(Self { methods, metrics, rows, notes })
    }

    /// What has to be said of the numbers wherever they are shown.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// The summary of a method in a scene: of both eyes, where there are two.
pub(crate) fn overall<'a>(
    summary: &'a SummaryRecord,
    scene: &str,
    method: &str,
) -> Option<&'a ComparisonSummary> {
    let eyes = |c: &&ComparisonSummary| c.eye.is_empty() || c.eye == "both";
    summary.comparisons.iter().filter(eyes).find(|c| c.scene == scene && c.method == method)
}

/// Metric, unit, and which way is better.
fn heading(metric: Metric) -> String {
    let info = metric.info();
    let unit = if info.unit.is_empty() { String::new() } else { format!(" ({})", info.unit) };
    let arrow = match info.better {
        Better::Higher => "↑",
        Better::Lower => "↓",
        Better::Neither => "",
    };
    format!("{}{unit} {arrow}", info.label)
}

fn shown(metric: Metric, value: Option<f64>) -> String {
    match value {
        None => "–".to_owned(),
        Some(value) if value.is_infinite() => "inf".to_owned(),
        Some(value) if metric.is_decibel() => format!("{value:.2}"),
        Some(value) if metric == Metric::Mse && value != 0.0 => format!("{value:.2e}"),
        Some(value) => format!("{value:.4}"),
    }
}

/// Values with the best marked: what prints as the best does is as good. One value alone is none.
fn marked(metric: Metric, values: impl Iterator<Item = Option<f64>>) -> Vec<Cell> {
    let values: Vec<Option<f64>> = values.collect();
    let found = values.iter().copied().flatten();
    let best = match metric.info().better {
        Better::Higher => found.reduce(f64::max),
        Better::Lower => found.reduce(f64::min),
        Better::Neither => None,
    };
    let several = values.iter().flatten().count() > 1;
    let best = best.filter(|_| several).map(|best| shown(metric, Some(best)));
    let cell = |value: Option<f64>| Cell {
        value,
        best: value.is_some() && best.as_ref() == Some(&shown(metric, value)),
    };
    values.into_iter().map(cell).collect()
}

/// The means over the scenes that all methods have; `None` where there are not two of them.
fn average(metrics: &[Metric], rows: &[Row]) -> Option<Row> {
    let mut scenes = Vec::new();
    let cells = metrics.iter().enumerate().map(|(index, &metric)| {
        let whole: Vec<&Vec<Cell>> = rows
            .iter()
            .map(|row| &row.cells[index])
            .filter(|cells| cells.iter().all(|cell| cell.value.is_some()))
            .collect();
        scenes.push(whole.len());
        let methods = rows[0].cells[index].len();
        marked(
            metric,
            (0..methods).map(|method| {
                mean(&whole.iter().filter_map(|cells| cells[method].value).collect::<Vec<_>>())
            }),
        )
    });
    let cells = cells.collect();
    let (fewest, most) = (scenes.iter().min().copied()?, scenes.iter().max().copied()?);
    let label = match fewest {
        0 | 1 => return None,
        all if all == rows.len() => "Average".to_owned(),
        count if count == most => format!("Average of the {count} scenes all methods have"),
        _ => "Average of the scenes all methods have".to_owned(),
    };
    Some(Row { label, average: true, cells })
}

/// The plain mean; `None` without any value. Infinite with any that is: what cannot be beaten in one
/// scene must not lose by it in the average.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The scenes in which methods were not scored on the same number of frames.
fn unequal_frames(summary: &SummaryRecord, scenes: &[&str], methods: &[String]) -> Option<String> {
    let unequal: Vec<String> = scenes
        .iter()
        .filter_map(|scene| {
            let scored: Vec<(&String, usize)> = methods
                .iter()
                .filter_map(|method| Some((method, overall(summary, scene, method)?.frames)))
                .collect();
            let most = scored.iter().map(|(_, frames)| *frames).max()?;
            let fewer = scored.iter().filter(|(_, frames)| *frames < most);
            let fewer: Vec<String> =
                fewer.map(|(method, frames)| format!("{method} {frames} of {most}")).collect();
            (!fewer.is_empty()).then(|| format!("{scene}: {}", fewer.join(", ")))
        })
        .collect();
    (!unequal.is_empty()).then(|| {
        format!("Not all methods were scored on the same frames ({}).", unequal.join("; "))
    })
}

/// The frames whose decibels are infinite and in no mean.
fn identical_frames(
    summary: &SummaryRecord,
    scenes: &[&str],
    methods: &[String],
) -> Option<String> {
    let pairs = scenes.iter().flat_map(|scene| methods.iter().map(move |method| (scene, method)));
    let identical: Vec<String> = pairs
        .filter_map(|(scene, method)| {
            let comparison = overall(summary, scene, method)?;
            let count = comparison.metrics.values().find_map(|s| s.identical_frames)?;
            (0 < count && count < comparison.frames)
                .then(|| format!("{scene}, {method}: {count} of {}", comparison.frames))
        })
        .collect();
    (!identical.is_empty()).then(|| {
        let which = identical.join("; ");
        format!("Means of decibels leave out frames that are identical to the reference ({which}).")
    })
}
