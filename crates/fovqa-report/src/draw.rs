//! Everything that is drawn from the files of a run, and from nothing else: drawing again gives the
//! same bytes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path};

use fovqa_config::PlotKind;
use fovqa_plot::{PlotError, png};
use fovqa_results::{
    FileError, RUN_JSON, RunRecord, SUMMARY_JSON, SummaryRecord, read_json_file, write_json_file,
    write_whole,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::comparison::ComparisonTable;
use crate::figures::{NamedFigure, Source, default_plots, figures};
use crate::frame_values::FrameValues;
use crate::page::{PageFigure, page};

/// Which files were drawn, so that another drawing takes away what it does not draw again.
const MANIFEST: &str = "report.json";
/// Folder of the figures.
const PLOTS: &str = "plots";
/// Name and version of the manifest's format.
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
    let run: RunRecord = read_json_file(&folder.join(RUN_JSON), "the record of a run")?;
    let summary: SummaryRecord =
        read_json_file(&folder.join(SUMMARY_JSON), "the summary of a run")?;
    let values = FrameValues::read(folder)?;
    let source = Source { run: &run, summary: &summary, values: &values };
    let plots = match run.resolved.plots.as_slice() {
        [] => default_plots(&source),
        plots => plots.to_vec(),
    };
    let mut names = Names::default();
    let (mut tables, mut drawn) = (Vec::new(), Vec::new());
    for plot in &plots {
        if plot.kind == PlotKind::Table {
            let table = ComparisonTable::new(&run, &summary, plot);
            tables.extend(table.map(|table| (names.free("table"), table)));
        }
        for figure in figures(&source, plot) {
            drawn.push(NamedFigure { name: names.free(&figure.name), ..figure });
        }
    }

    let mut files = Vec::new();
    for (name, table) in &tables {
        for (ending, text) in [("md", table.markdown()), ("csv", table.csv())] {
            let file = format!("{name}.{ending}");
            write_whole(&folder.join(&file), text.as_bytes())?;
            files.push(file);
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
    for figure in &drawn {
        let endings = ["svg", "png", "csv"].into_iter();
        files.extend(endings.map(|ending| format!("{PLOTS}/{}.{ending}", figure.name)));
    }
    let paths: Vec<String> = drawn.iter().map(|f| format!("{PLOTS}/{}", f.name)).collect();
    let on_page = paths.iter().zip(&drawn);
    let on_page: Vec<PageFigure<'_>> =
        on_page.map(|(path, figure)| PageFigure { path, caption: &figure.caption }).collect();
    let tables: Vec<ComparisonTable> = tables.into_iter().map(|(_, table)| table).collect();
    write_whole(&folder.join("index.html"), page(&run, &summary, &tables, &on_page).as_bytes())?;
    files.push("index.html".to_owned());
    remove_others(folder, &files);
    let manifest = Manifest { schema: SCHEMA.to_owned(), files };
    write_json_file(&folder.join(MANIFEST), &manifest)?;
    Ok(Drawn { table: tables.into_iter().next(), figures: drawn.len() })
}

/// Takes away what was drawn of an earlier run.
pub fn clear(folder: &Path) {
    remove_others(folder, &[]);
    // Where there is none, there is nothing to take away.
    let _ = fs::remove_file(folder.join(MANIFEST));
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

/// Removes the files of the last manifest that are not among `kept`.
fn remove_others(folder: &Path, kept: &[String]) {
    let manifest: Manifest =
        read_json_file(&folder.join(MANIFEST), "a list of files").unwrap_or_default();
    let below =
        |file: &str| Path::new(file).components().all(|part| matches!(part, Component::Normal(_)));
    let old = manifest.files.iter().filter(|file| !kept.contains(file) && below(file));
    for file in old {
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
