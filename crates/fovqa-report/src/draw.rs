//! Everything that is drawn from the files of a run, and from nothing else: drawing again gives the
//! same bytes.

use std::path::Path;

use fovqa_plan::{Plot, PlotKind};
use fovqa_results::{
    CsvNames, RUN_JSON, RUN_SCHEMA, RunRecord, SUMMARY_JSON, SUMMARY_SCHEMA, SummaryRecord,
    check_files, read_json_file,
};

use crate::comparison::ComparisonTable;
use crate::figures::{Source, default_plots, figures, ratio_tables};
use crate::frame_values::FrameValues;
use crate::page::{PageFigure, page};
use crate::sheet::{NamedFigure, NamedTable, Names, PLOTS, ReportError, Sheet};

/// What was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The first comparison table; `None` where nothing was scored.
    pub table: Option<ComparisonTable>,
    /// How many figures.
    pub figures: usize,
    /// What the user should know of the files of the run.
    pub warning: Option<String>,
}

/// Draws tables, figures and the page of a run into its folder.
///
/// # Errors
/// When a file of the run is missing or broken, or the folder cannot be written to.
pub fn draw(folder: &Path) -> Result<Drawn, ReportError> {
    let run: RunRecord = read_json_file(&folder.join(RUN_JSON), RUN_SCHEMA, "the record of a run")?;
    let summary: SummaryRecord =
        read_json_file(&folder.join(SUMMARY_JSON), SUMMARY_SCHEMA, "the summary of a run")?;
    let csv_names = CsvNames::from(&run.resolved);
    let values = FrameValues::read(folder, csv_names)?;
    let warning = check_files(folder, &run)?;
    let source = Source { run: &run, summary: &summary, values: &values };
    let plots = match run.resolved.plots.as_slice() {
        [] => default_plots(&source),
        plots => plots.to_vec(),
    };
    let mut names = Names::default();
    let (mut tables, mut drawn) = (Vec::new(), Vec::new());
    for plot in &plots {
        for (name, table) in tables_of(&source, plot) {
            tables.push((names.free(&name), table));
        }
        for figure in figures(&source, plot) {
            drawn.push(NamedFigure { name: names.free(&figure.name), ..figure });
        }
    }

    let paths: Vec<String> = drawn.iter().map(|f| format!("{PLOTS}/{}", f.name)).collect();
    let on_page = paths.iter().zip(&drawn);
    let on_page: Vec<PageFigure<'_>> =
        on_page.map(|(path, figure)| PageFigure { path, caption: &figure.caption }).collect();
    let files = tables.iter().map(|(name, table)| NamedTable {
        name: name.clone(),
        files: vec![("md", table.markdown()), ("csv", table.csv()), ("tex", table.latex())],
    });
    let files = files.collect();
    let tables: Vec<ComparisonTable> = tables.into_iter().map(|(_, table)| table).collect();
    let page = page(&run, &summary, &tables, &on_page);
    let figures = drawn.len();
    Sheet { tables: files, figures: drawn, page, names: csv_names }.write(folder)?;
    Ok(Drawn { table: tables.into_iter().next(), figures, warning })
}

/// The tables of a plot, with their names.
fn tables_of(source: &Source<'_>, plot: &Plot) -> Vec<(String, ComparisonTable)> {
    match plot.kind {
        PlotKind::Table => {
            let table = ComparisonTable::new(source.run, source.summary, plot);
            table.map(|table| ("table".to_owned(), table)).into_iter().collect()
        }
        PlotKind::Ratios => ratio_tables(source, plot),
        _ => Vec::new(),
    }
}
