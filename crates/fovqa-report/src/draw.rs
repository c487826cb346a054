//! Makes all tables, figures and the page from the files of a run alone, so that repeating it gives
//! the same bytes.

use std::path::Path;

use fovqa_plan::{Plot, PlotKind};
use fovqa_results::{CsvNames, RunRecord, check_files, kept_verdict};

use crate::band_spread::BandSpread;
use crate::budgets::budgets;
use crate::comparison::ComparisonTable;
use crate::figures::{Source, default_plots, ratio_tables, slug};
use crate::frame_values::FrameValues;
use crate::latex::usual_label;
use crate::overview::Overview;
use crate::page::{PageInputs, PageVerdict, forward, run_page};
use crate::plain_table::PlainTable;
use crate::plot_figures::plot_figures;
use crate::run_table::RunTable;
use crate::sheet::{MakeText, NamedFigure, NamedTable, Names, ReportError, Sheet};
use crate::steps::BeginStep;
use crate::study::study_of_run;
use crate::sweep::optima;
use crate::viewer::Viewer;

/// The tables and figures that were made.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The first table; `None` if nothing was scored.
    pub table: Option<RunTable>,
    /// Number of figures.
    pub figures: usize,
    /// Warnings about the files of the run and about figures.
    pub warnings: Vec<String>,
}

/// Writes tables, figures and the page of a run into its folder. Each step is begun with `begin`.
///
/// # Errors
/// If a file of the run is missing or damaged, or the folder cannot be written to.
pub fn draw(folder: &Path, begin: &BeginStep<'_>) -> Result<Drawn, ReportError> {
    let reading = begin("reading the results", 0);
    let mut run = RunRecord::read(folder)?;
    // The page lists only the first, and a long sequence has very many.
    let inputs = PageInputs::of(&std::mem::take(&mut run.inputs));
    let overview = Overview::read(folder)?;
    let csv_names = CsvNames::from(&run.resolved);
    let values = FrameValues::read(folder, csv_names)?;
    let warning = check_files(folder, &run)?;
    let has_error_bars = |plot: &Plot| plot.error_bars.is_some() && plot.kind != PlotKind::Bars;
    let spread = if run.resolved.plots.iter().any(has_error_bars) {
        BandSpread::read(folder, csv_names)?
    } else {
        BandSpread::default()
    };
    let source = Source {
        run: &run,
        overview: &overview,
        values: &values,
        folder: Some(folder),
        spread: &spread,
    };
    let plots = match run.resolved.plots.as_slice() {
        [] => {
            let figure = &run.resolved.figures;
            let plots = default_plots(&source).into_iter();
            plots.map(|plot| Plot { figure: figure.clone(), ..plot }).collect()
        }
        plots => plots.to_vec(),
    };
    let mut names = Names::default();
    let (mut tables, mut drawn) = (Vec::new(), Vec::new());
    for plot in &plots {
        for (index, (name, table)) in tables_of(&source, plot).into_iter().enumerate() {
            let name = names.free(&name);
            let label = label(&run.resolved.name, plot, index, &name);
            tables.push((name, table.labelled(label)));
        }
        let of_plot = plot_figures(&source, plot);
        let several = of_plot.len() > 1;
        for figure in of_plot {
            let caption = match &plot.caption {
                None => figure.caption,
                // What tells the figures of one plot apart stays.
                Some(caption) if several => format!("{caption}: {}", figure.caption),
                Some(caption) => caption.clone(),
            };
            let (name, settings) = (names.free(&figure.name), plot.figure.clone());
            drawn.push(NamedFigure { name, caption, settings, ..figure });
        }
    }

    let study = study_of_run(folder, &run.resolved)?;
    for (name, table) in study.tables {
        let name = names.free(&name);
        let label = usual_label(&slug(&run.resolved.name), &name);
        tables.push((name, RunTable::plain(table).labelled(label)));
    }
    for figure in study.figures {
        drawn.push(NamedFigure { name: names.free(&figure.name), ..figure });
    }

    let figures = drawn.len();
    let viewer = Viewer::read(&source, folder)?;
    // The page has everything else if the verdict is damaged.
    let (verdict, damaged) = match kept_verdict(folder) {
        Ok(verdict) => (verdict, None),
        Err(error) => (None, Some(format!("{error}; `fovqa gate` writes the verdict again"))),
    };
    let sheet = Sheet {
        tables: tables.iter().map(|(name, table)| files_of(name, table)).collect(),
        figures: drawn,
        page: Box::new(|figures| {
            let verdict = verdict.as_ref().map(|verdict| PageVerdict::of(verdict, folder));
            let values = (&overview, &values, verdict);
            run_page((&run, &inputs), values, &tables, figures, viewer.json.clone())
        }),
        forward: Some(forward(&run.resolved.name)),
        names: csv_names,
    };
    drop(reading);
    let of_figures = sheet.write(folder, begin)?;
    drop(sheet);
    let warnings = warning.into_iter().chain(study.warning).chain(of_figures);
    let warnings = warnings.chain(viewer.warnings).chain(damaged);
    let warnings = warnings.collect();
    let table = tables.into_iter().next().map(|(_, table)| table);
    Ok(Drawn { table, figures, warnings })
}

/// The files of a table.
fn files_of<'a>(name: &'a str, table: &'a RunTable) -> NamedTable<'a> {
    let markdown: MakeText<'a> = Box::new(|| table.markdown());
    let files = vec![
        ("md", markdown),
        ("csv", Box::new(|| table.csv())),
        ("tex", Box::new(|| table.latex())),
    ];
    NamedTable { name, files }
}

/// The tables of a plot, with their names.
fn tables_of(source: &Source<'_>, plot: &Plot) -> Vec<(String, RunTable)> {
    let plain = |kind: &str, table: Option<PlainTable>| {
        let own = plot.name.as_deref().map(slug).filter(|name| !name.is_empty());
        let name = own.map_or_else(|| format!("table-{kind}"), |own| format!("table-{own}"));
        let captioned = |table: PlainTable| PlainTable {
            caption: plot.caption.clone().unwrap_or(table.caption),
            ..table
        };
        table.map(|table| (name, RunTable::plain(captioned(table)))).into_iter().collect()
    };
    match plot.kind {
        PlotKind::Table => {
            let own = plot.name.as_deref().map(slug).filter(|name| !name.is_empty());
            let name = own.map_or_else(|| "table".to_owned(), |own| format!("table-{own}"));
            let table = ComparisonTable::new(source.run, source.overview, source.values, plot);
            table.map(|table| (name, RunTable::Comparison(table))).into_iter().collect()
        }
        PlotKind::Ratios => {
            let tables = ratio_tables(source, plot).into_iter();
            tables.map(|(name, table)| (name, RunTable::Comparison(table))).collect()
        }
        PlotKind::Optima => plain("optima", optima(source, plot)),
        PlotKind::Budgets => plain("budgets", budgets(source, plot)),
        _ => Vec::new(),
    }
}

/// The label of a plot's table in LaTeX. Each table of one document needs a label of its own.
fn label(experiment: &str, plot: &Plot, index: usize, name: &str) -> String {
    match &plot.label {
        Some(label) if index == 0 => label.clone(),
        Some(label) => format!("{label}-{}", index + 1),
        None => usual_label(&slug(experiment), name),
    }
}
