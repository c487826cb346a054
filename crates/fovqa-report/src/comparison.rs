//! The comparison table of the papers (RMFR, Table 1): a row a scene, metrics side by side, within
//! each the methods, the best of each row marked, an average row at the end.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use fovqa_config::Plot;
use fovqa_metrics::{Better, Metric};
use fovqa_results::{ComparisonSummary, RunRecord, SummaryRecord};

use crate::terminal::printable;

/// A table of means over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonTable {
    methods: Vec<String>,
    metrics: Vec<Metric>,
    rows: Vec<Row>,
}

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
        if metrics.is_empty() {
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
        Some(Self { methods, metrics, rows })
    }

    /// GitHub's Markdown; the best of each row in bold.
    pub fn markdown(&self) -> String {
        let mut text = String::from("| scene |");
        for metric in &self.metrics {
            let blanks = " |".repeat(self.methods.len() - 1);
            let _ = write!(text, " {} |{blanks}", heading(*metric));
        }
        text.push_str("\n| :-- |");
        text.push_str(&" --: |".repeat(self.metrics.len() * self.methods.len()));
        text.push_str("\n| |");
        for _ in &self.metrics {
            for method in &self.methods {
                let _ = write!(text, " *{}* |", escaped(method));
            }
        }
        text.push('\n');
        for row in &self.rows {
            let _ = write!(text, "| {} |", escaped(&row.label));
            for (metric, cells) in self.metrics.iter().zip(&row.cells) {
                for cell in cells {
                    let number = shown(*metric, cell.value);
                    let bold = if cell.best { "**" } else { "" };
                    let _ = write!(text, " {bold}{number}{bold} |");
                }
            }
            text.push('\n');
        }
        for note in self.notes() {
            let _ = writeln!(text, "\n{note}");
        }
        text
    }

    /// What has to be said of the numbers wherever they are shown.
    pub fn notes(&self) -> Vec<&'static str> {
        let mut notes = vec!["Means over frames; the best of each row is marked."];
        if self.metrics.contains(&Metric::Fpsnr) || self.metrics.contains(&Metric::Fssim) {
            notes.push(
                "FPSNR and FSSIM: the papers print no constants for the foveal weight, so compare \
                 methods, not papers.",
            );
        }
        notes
    }

    /// CSV: a row a scene, for each metric a column a method (`psnr RMFR`) and one with the best of
    /// the row (`psnr best`; several share it with ` = ` between them). Full precision.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut header = vec!["scene".to_owned()];
        for metric in &self.metrics {
            header.extend(self.methods.iter().map(|method| format!("{} {method}", metric.key())));
            header.push(format!("{} best", metric.key()));
        }
        // Writing to memory does not fail, and the rows are of one length.
        let _ = writer.write_record(&header);
        for row in &self.rows {
            let mut record = vec![row.label.clone()];
            for cells in &row.cells {
                let text = |cell: &Cell| cell.value.map(|v| format!("{v:?}")).unwrap_or_default();
                record.extend(cells.iter().map(text));
                let best = self.methods.iter().zip(cells).filter(|(_, cell)| cell.best);
                let best: Vec<&str> = best.map(|(method, _)| method.as_str()).collect();
                record.push(best.join(" = "));
            }
            let _ = writer.write_record(&record);
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }

    /// For a terminal: metric by metric below each other, or, where there is but one scene, method
    /// by method; `*` behind the best of each scene.
    pub fn terminal(&self) -> String {
        if let [row] = self.rows.as_slice() {
            return self.one_scene(row);
        }
        let mut text = String::new();
        for (index, metric) in self.metrics.iter().enumerate() {
            let heading = heading(*metric);
            let mut table = plain_table(
                [heading.as_str()].into_iter().chain(self.methods.iter().map(String::as_str)),
            );
            for row in &self.rows {
                let cells = row.cells[index].iter().map(|cell| starred(*metric, cell));
                table.add_row([printable(&row.label)].into_iter().chain(cells));
            }
            text.push_str(&aligned(table));
            text.push('\n');
        }
        text
    }

    fn one_scene(&self, row: &Row) -> String {
        let headings: Vec<String> = self.metrics.iter().map(|metric| heading(*metric)).collect();
        let label = printable(&row.label);
        let mut table =
            plain_table([label.as_str()].into_iter().chain(headings.iter().map(String::as_str)));
        for (index, method) in self.methods.iter().enumerate() {
            let metrics = self.metrics.iter().zip(&row.cells);
            let cells = metrics.map(|(metric, cells)| starred(*metric, &cells[index]));
            table.add_row([printable(method)].into_iter().chain(cells));
        }
        aligned(table)
    }

    /// HTML of the same layout.
    pub(crate) fn html(&self) -> String {
        let mut text = String::from("<table>\n<thead>\n<tr><th rowspan=\"2\">scene</th>");
        for metric in &self.metrics {
            let span = self.methods.len();
            let _ = write!(text, "<th colspan=\"{span}\">{}</th>", heading(*metric));
        }
        text.push_str("</tr>\n<tr>");
        for _ in &self.metrics {
            for method in &self.methods {
                let _ = write!(text, "<th>{}</th>", crate::page::escaped(method));
            }
        }
        text.push_str("</tr>\n</thead>\n<tbody>\n");
        for row in &self.rows {
            let class = if row.average { " class=\"average\"" } else { "" };
            let _ = write!(text, "<tr{class}><th>{}</th>", crate::page::escaped(&row.label));
            for (metric, cells) in self.metrics.iter().zip(&row.cells) {
                for (index, cell) in cells.iter().enumerate() {
                    let first = if index == 0 { " class=\"first\"" } else { "" };
                    let number = shown(*metric, cell.value);
                    let number = if cell.best { format!("<b>{number}</b>") } else { number };
                    let _ = write!(text, "<td{first}>{number}</td>");
                }
            }
            text.push_str("</tr>\n");
        }
        text.push_str("</tbody>\n</table>\n");
        text
    }
}

fn plain_table<'a>(header: impl Iterator<Item = &'a str>) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header);
    table
}

/// Names to the left, numbers to the right, nothing behind the last column.
fn aligned(mut table: Table) -> String {
    for (index, column) in table.column_iter_mut().enumerate() {
        let side = if index == 0 { CellAlignment::Left } else { CellAlignment::Right };
        column.set_cell_alignment(side);
        column.set_padding(if index == 0 { (0, 1) } else { (1, 0) });
    }
    let mut text = String::new();
    for line in table.lines() {
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

fn starred(metric: Metric, cell: &Cell) -> String {
    format!("{}{}", shown(metric, cell.value), if cell.best { "*" } else { " " })
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

/// Values with the best marked: what prints as the best does is as good. One method alone is none.
fn marked(metric: Metric, values: impl Iterator<Item = Option<f64>>) -> Vec<Cell> {
    let values: Vec<Option<f64>> = values.collect();
    let found = values.iter().copied().flatten();
    let best = match metric.info().better {
        Better::Higher => found.reduce(f64::max),
        Better::Lower => found.reduce(f64::min),
    };
    let several = values.len() > 1;
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

/// The mean of the finite values; infinite where there is no other, `None` without any.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    if finite.is_empty() {
        return values.first().copied();
    }
    Some(finite.iter().sum::<f64>() / finite.len() as f64)
}

/// Text that Markdown takes as it is.
fn escaped(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        if matches!(c, '|' | '*' | '_' | '`' | '\\' | '<' | '>' | '[' | ']' | '#') {
            plain.push('\\');
        }
        plain.push(c);
    }
    plain
}
