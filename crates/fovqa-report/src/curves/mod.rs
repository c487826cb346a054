//! Figures, tables and the page of a curves file.

mod axes;
mod bands;
mod contours;
mod labels;
mod looks;
mod models;
mod page;
mod picture;
mod rates;
mod response;
mod samples;
mod tables;
mod values;

use std::path::Path;

use fovqa_methods::curves::Curve;
use fovqa_plan::{CurvePlot, CurvePlotKind, CurvesFile};
use fovqa_results::{
    CURVES_CSV, CURVES_JSON, CsvNames, CurvesRecord, curves_csv, write_json_file, write_whole,
};

use crate::figures::slug;
use crate::foresee::check;
use crate::latex::usual_label;
use crate::plain_table::PlainTable;
use crate::sheet::{MakePage, MakeText, NamedFigure, NamedTable, Names, ReportError, Sheet};
use crate::steps::BeginStep;
use crate::text_table::TextTable;

/// The figures and tables that were made from a curves file.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnCurves {
    /// The tables for a terminal.
    pub tables: Vec<TextTable>,
    /// Number of figures.
    pub figures: usize,
    /// Warnings about figures.
    pub warnings: Vec<String>,
}

/// The data that figures and tables are made from.
struct Source<'a> {
    file: &'a CurvesFile,
    curves: &'a [Curve],
}

impl<'a> Source<'a> {
    /// The curves with the given names, or all curves.
    fn chosen(&self, names: Option<&[String]>) -> Vec<&'a Curve> {
        let chosen = |curve: &&Curve| names.is_none_or(|names| names.contains(&curve.spec.name));
        self.curves.iter().filter(chosen).collect()
    }
}

/// Writes curves, figures, tables and the page into a folder. Each step is begun with `begin`.
///
/// # Errors
/// If the folder cannot be written to, or a figure cannot be drawn.
pub fn draw_curves(
    folder: &Path,
    file: &CurvesFile,
    curves: &[Curve],
    begin: &BeginStep<'_>,
) -> Result<DrawnCurves, ReportError> {
    let source = Source { file, curves };
    let mut names = Names::default();
    let figures = figures(&source, &mut names)?;
    let mut made: Vec<(String, PlainTable)> = Vec::new();
    for table in &file.plan.tables {
        let (name, table) = tables::table(&source, table);
        made.push((names.free(name), table));
    }
    let files = made.iter().map(|(name, table)| {
        let markdown: MakeText<'_> = Box::new(|| table.markdown());
        let latex: MakeText<'_> = Box::new(|| table.latex(&usual_label(&slug(&file.name), name)));
        let files = vec![("md", markdown), ("csv", Box::new(|| table.csv())), ("tex", latex)];
        NamedTable { name, files }
    });
    let page: MakePage<'_> = Box::new(|figures| page::page(&source, &made, figures));
    let sheet =
        Sheet { tables: files.collect(), figures, page, forward: None, names: CsvNames::Plain };
    write_whole(&folder.join(CURVES_CSV), curves_csv(&file.plan, curves).as_bytes())?;
    write_json_file(&folder.join(CURVES_JSON), &CurvesRecord::new(file, curves))?;
    let warnings = sheet.write(folder, begin)?;
    let tables = made.iter().map(|(_, table)| table.terminal()).collect();
    Ok(DrawnCurves { tables, figures: sheet.figures.len(), warnings })
}

/// The first figure of a file that cannot have the size that was asked for.
///
/// # Errors
/// If a figure cannot be drawn at all.
pub fn impossible_curves(
    file: &CurvesFile,
    curves: &[Curve],
) -> Result<Option<ReportError>, ReportError> {
    let figures = figures(&Source { file, curves }, &mut Names::default())?;
    Ok(figures.into_iter().find_map(check))
}

/// The figures of the file.
fn figures(source: &Source<'_>, names: &mut Names) -> Result<Vec<NamedFigure>, ReportError> {
    let mut figures: Vec<NamedFigure> = Vec::new();
    for plot in &source.file.plan.plots {
        let Some(drawn) = drawn(source, plot)? else { continue };
        // The name may contain any character, but a file name is part of an address on the page.
        let name = match slug(&drawn.name) {
            name if name.is_empty() => "figure".to_owned(),
            name => name,
        };
        let (name, settings) = (names.free(&name), plot.figure.clone());
        figures.push(NamedFigure { name, settings, ..drawn });
    }
    Ok(figures)
}

/// The figure of a plot. `None` if the plot lacks the data of its kind, which no file gives.
fn drawn(source: &Source<'_>, plot: &CurvePlot) -> Result<Option<NamedFigure>, ReportError> {
    Ok(match plot.kind {
        CurvePlotKind::Rates => Some(rates::figure(source, plot)),
        CurvePlotKind::Density => Some(picture::figure(source, plot)?),
        CurvePlotKind::Accumulated => Some(models::accumulated(source, plot)),
        CurvePlotKind::HalfAxis => Some(models::half_axis(plot)),
        CurvePlotKind::Steps => Some(models::steps(source, plot)),
        CurvePlotKind::Outline => Some(models::outline(source, plot)),
        CurvePlotKind::Samples => Some(samples::positions(source, plot)?),
        CurvePlotKind::SamplesBars => Some(samples::bars(source, plot)),
        CurvePlotKind::Response => response::figure(source, plot),
        CurvePlotKind::Values => values::figure(plot),
    })
}
