//! Everything that is drawn from the files of a run, and from nothing else: drawing again gives the
//! same bytes.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use fovqa_config::{Plot, PlotKind};
use fovqa_plot::{PlotError, png};
use fovqa_results::{
    FileError, REPORT_JSON, RUN_JSON, RUN_SCHEMA, RunRecord, SUMMARY_JSON, SUMMARY_SCHEMA,
    SummaryRecord, read_json_file, write_json_file, write_whole,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::comparison::ComparisonTable;
use crate::figures::{NamedFigure, Source, default_plots, figures, ratio_tables};
use crate::frame_values::FrameValues;
use crate::page::{PageFigure, page};

/// Folder of the figures.
const PLOTS: &str = "plots";
/// Name and version of the format of [`REPORT_JSON`].
const SCHEMA: &str = "fovqa.report/1";
/// Pixels of a PNG per pixel of the SVG: 288 dots an inch at half a page's width.
const PNG_SCALE: f32 = 2.0;

/// What was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The first comparison table; `None` where nothing was scored.
    pub table: Option<ComparisonTable>,
    /// How many figures.
    pub figures: usize,
}

/// Why nothing could be drawn.
#[derive(Debug, Error)]
pub enum ReportError {
    /// A file that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A figure that cannot be.
    #[error("{name}: {error}")]
    Plot {
        /// The figure.
        name: String,
        /// The reason.
        error: PlotError,
    },
}

#[derive(Default, Serialize, Deserialize)]
struct Manifest {
    schema: String,
    files: Vec<String>,
}

/// Draws tables, figures and the page of a run into its folder.
///
/// # Errors
/// When a file of the run is missing or broken, or the folder cannot be written to.
pub fn draw(folder: &Path) -> Result<Drawn, ReportError> {
    let run: RunRecord = read_json_file(&folder.join(RUN_JSON), RUN_SCHEMA, "the record of a run")?;
    let summary: SummaryRecord =
        read_json_file(&folder.join(SUMMARY_JSON), SUMMARY_SCHEMA, "the summary of a run")?;
    let values = FrameValues::read(folder)?;
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

    let table_files = tables
        .iter()
        .flat_map(|(name, _)| ["md", "csv", "tex"].map(|ending| format!("{name}.{ending}")));
    let figure_files = drawn.iter().flat_map(|figure| {
        ["svg", "png", "csv"].map(|ending| format!("{PLOTS}/{}.{ending}", figure.name))
    });
    let mut files: Vec<String> = table_files.chain(figure_files).collect();
    files.push("index.html".to_owned());
    // Said before it is done: whoever comes after a drawing that was broken off knows what is there.
    let old = drawn_before(folder);
    let either = old.iter().filter(|old| !files.contains(old)).chain(&files).cloned();
    write_manifest(folder, either.collect())?;

    for (name, table) in &tables {
        for (ending, text) in
            [("md", table.markdown()), ("csv", table.csv()), ("tex", table.latex())]
        {
            write_whole(&folder.join(format!("{name}.{ending}")), text.as_bytes())?;
        }
    }
    let plots = folder.join(PLOTS);
    if !drawn.is_empty() {
        fs::create_dir_all(&plots)
            .map_err(|error| FileError::Write { path: plots.clone(), error })?;
    }
    let written: Result<Vec<()>, ReportError> =
        drawn.par_iter().map(|figure| write_figure(&plots, figure)).collect();
    written?;
    let paths: Vec<String> = drawn.iter().map(|f| format!("{PLOTS}/{}", f.name)).collect();
    let on_page = paths.iter().zip(&drawn);
    let on_page: Vec<PageFigure<'_>> =
        on_page.map(|(path, figure)| PageFigure { path, caption: &figure.caption }).collect();
    let tables: Vec<ComparisonTable> = tables.into_iter().map(|(_, table)| table).collect();
    let page = page(&run, &summary, &tables, &on_page);
    write_whole(&folder.join("index.html"), page.as_bytes())?;
    remove(folder, old.iter().filter(|old| !files.contains(old)));
    write_manifest(folder, files)?;
    Ok(Drawn { table: tables.into_iter().next(), figures: drawn.len() })
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

fn write_manifest(folder: &Path, files: Vec<String>) -> Result<(), FileError> {
    let manifest = Manifest { schema: SCHEMA.to_owned(), files };
    write_json_file(&folder.join(REPORT_JSON), &manifest)
}

/// Takes away what was drawn of an earlier run.
pub fn clear(folder: &Path) {
    let old = drawn_before(folder);
    if !old.is_empty() {
        remove(folder, old.iter());
        // Where it cannot be taken away, it tells nothing that is not so.
        let _ = fs::remove_file(folder.join(REPORT_JSON));
    }
}

fn write_figure(plots: &Path, figure: &NamedFigure) -> Result<(), ReportError> {
    let NamedFigure { name, figure, .. } = figure;
    let failed = |error| ReportError::Plot { name: name.clone(), error };
    let svg = figure.svg().map_err(failed)?;
    let pixels = png(&svg, PNG_SCALE).map_err(failed)?;
    for (ending, bytes) in
        [("svg", svg.as_bytes()), ("png", &pixels), ("csv", figure.csv().as_bytes())]
    {
        write_whole(&plots.join(format!("{name}.{ending}")), bytes)?;
    }
    Ok(())
}

/// The files of the last manifest. Only what a drawing could have written: a list can be anybody's.
fn drawn_before(folder: &Path) -> Vec<String> {
    let manifest = read_json_file(&folder.join(REPORT_JSON), SCHEMA, "a list of files");
    let Manifest { mut files, .. } = manifest.unwrap_or_default();
    files.retain(|file| is_drawn(file));
    files
}

fn is_drawn(file: &str) -> bool {
    let plain = |name: &str| !name.contains(['/', '\\', ':']) && !name.starts_with('.');
    let ends = |name: &str, endings: &[&str]| {
        name.rsplit_once('.').is_some_and(|(_, ending)| endings.contains(&ending))
    };
    match file.split_once('/') {
        Some((PLOTS, name)) => plain(name) && ends(name, &["svg", "png", "csv"]),
        Some(_) => false,
        None => {
            file == "index.html"
                || (["table", "ratios"].iter().any(|name| file.starts_with(name))
                    && plain(file)
                    && ends(file, &["md", "csv", "tex"]))
        }
    }
}

fn remove<'a>(folder: &Path, files: impl Iterator<Item = &'a String>) {
    for file in files {
        // What somebody has taken away already is as good.
        let _ = fs::remove_file(folder.join(file));
    }
}

/// File names that are given out once each.
#[derive(Default)]
struct Names(BTreeSet<String>);

impl Names {
    fn free(&mut self, name: &str) -> String {
        let mut free = name.to_owned();
        let mut count = 1;
        while !self.0.insert(free.clone()) {
            count += 1;
            free = format!("{name}-{count}");
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_of_files_takes_away_nothing_but_drawings() {
        for ours in [
            "index.html",
            "table.md",
            "table-2.csv",
            "table.tex",
            "ratios-haar.md",
            "plots/bars-psnr.png",
        ] {
            assert!(is_drawn(ours), "{ours}");
        }
        for other in [
            "thesis.tex",
            "results.csv",
            "../table.md",
            "plots/../x.svg",
            "plots/a/b.svg",
            "/x/table.md",
            "plots/x.tex",
            "table",
            "plots/.svg",
            "a/plots/x.svg",
            "plots\\x.svg",
            "",
        ] {
            assert!(!is_drawn(other), "{other}");
        }
    }

    #[test]
    fn names_are_given_out_once() {
        let mut names = Names::default();
        assert_eq!([names.free("a"), names.free("a"), names.free("a-2")], ["a", "a-2", "a-2-2"]);
    }
}
