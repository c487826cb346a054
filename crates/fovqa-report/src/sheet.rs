//! Writes tables, figures and a page into a results folder, with a list of the files. The next
//! report uses the list to remove files that it does not write again.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use fovqa_methods::curves::CurveError;
use fovqa_params::Words;
use fovqa_plan::{FigureFormat, FigureSettings};
use fovqa_plot::{Figure, PlotError};
use fovqa_results::{
    Batch, CsvNames, FileError, INDEX_HTML, REPORT_HTML, REPORT_JSON, make_folder, read_json_file,
    take_away,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::doubts::{missing_in_words, unseen_in_words};
use crate::long_lines::for_picture;
use crate::page::{PageFigure, data_image, in_words};
use crate::print::{PNG_DPI, formats, set_axes, style_of};
use crate::steps::BeginStep;

/// Folder of the figures.
pub(crate) const PLOTS: &str = "plots";
/// Name and version of the format of [`REPORT_JSON`].
const SCHEMA: &str = "fovqa.report/1";

/// A figure with its name and caption.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedFigure {
    /// File name without folder and extension.
    pub(crate) name: String,
    pub(crate) caption: String,
    pub(crate) figure: Figure,
    /// How it is printed.
    pub(crate) settings: FigureSettings,
    /// Warnings about files that it shows.
    pub(crate) warnings: Vec<String>,
}

impl NamedFigure {
    /// A figure that is printed as usual.
    pub(crate) fn new(name: String, caption: String, figure: Figure) -> Self {
        Self { name, caption, figure, settings: FigureSettings::default(), warnings: Vec::new() }
    }

    /// The endings of its files.
    pub(crate) fn endings(&self) -> impl Iterator<Item = &'static str> {
        formats(&self.settings).into_iter().map(FigureFormat::word).chain(["csv"])
    }
}

/// The name of a table and, for each file extension, a function that makes its text. A table of
/// many methods is long, so its texts are made only when they are written.
pub(crate) struct NamedTable<'a> {
    pub(crate) name: &'a str,
    pub(crate) files: Vec<(&'static str, MakeText<'a>)>,
}

/// Makes the text of a file.
pub(crate) type MakeText<'a> = Box<dyn Fn() -> String + 'a>;

/// Makes the text of a page with figures.
pub(crate) type MakePage<'a> = Box<dyn Fn(&[PageFigure<'_>]) -> String + 'a>;

/// Everything that is written into a results folder.
pub(crate) struct Sheet<'a> {
    pub(crate) tables: Vec<NamedTable<'a>>,
    pub(crate) figures: Vec<NamedFigure>,
    /// Makes the page from its figures as they were drawn.
    pub(crate) page: MakePage<'a>,
    /// The text of `index.html`, which forwards to the page, `report.html`. If it is `None`, the page
    /// itself is `index.html`.
    pub(crate) forward: Option<String>,
    /// How names are written in CSV files.
    pub(crate) names: CsvNames,
}

/// Why tables and figures could not be made.
#[derive(Debug, Error)]
pub enum ReportError {
    /// A file that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A page that was not written by fovqa and must not be replaced.
    #[error("{}: fovqa did not write this file, so it is not replaced", path.display())]
    Foreign {
        /// The page.
        path: PathBuf,
    },
    /// A curve that is not possible.
    #[error("{name}: {error}")]
    Curve {
        /// The curve.
        name: String,
        /// The reason.
        error: CurveError,
    },
    /// A figure that cannot be drawn.
    #[error("{name}: {error}")]
    Plot {
        /// The figure.
        name: String,
        /// The reason.
        error: PlotError,
    },
}

impl ReportError {
    /// Whether a figure does not fit into the size that was asked for.
    pub fn is_of_settings(&self) -> bool {
        let Self::Plot { error, .. } = self else { return false };
        matches!(
            error,
            PlotError::Narrow { .. }
                | PlotError::Low { .. }
                | PlotError::FollowsFromWidth { .. }
                | PlotError::Size { .. }
        )
    }
}

#[derive(Default, Serialize, Deserialize)]
struct Manifest {
    schema: String,
    files: Vec<String>,
}

impl Sheet<'_> {
    /// Writes all files into a folder. Returns warnings about the figures.
    pub(crate) fn write(
        &self,
        folder: &Path,
        begin: &BeginStep<'_>,
    ) -> Result<Vec<String>, ReportError> {
        let table_files = self.tables.iter().flat_map(|table| {
            table.files.iter().map(|(ending, _)| format!("{}.{ending}", table.name))
        });
        let figure_files = self.figures.iter().flat_map(|figure| {
            figure.endings().map(|ending| format!("{PLOTS}/{}.{ending}", figure.name))
        });
        let mut files: Vec<String> = table_files.chain(figure_files).collect();
        files.extend(self.forward.iter().map(|_| REPORT_HTML.to_owned()));
        files.push(INDEX_HTML.to_owned());
        // The list is written before the files, so that after an interruption the next report knows
        // which files exist.
        let old = drawn_before(folder);
        let either = old.iter().filter(|old| !files.contains(old)).chain(&files).cloned();
        let batch = Batch::default();
        write_manifest(folder, either.collect(), &batch)?;
        // The list must not be lost if files on it are not.
        batch.flush();

        let done = begin("writing tables", self.tables.len());
        for NamedTable { name, files } in &self.tables {
            for (ending, text) in files {
                let path = folder.join(format!("{name}.{ending}"));
                let text = text();
                match *ending {
                    "csv" => batch.write(&path, self.names.in_csv(text).as_bytes())?,
                    _ => batch.write(&path, text.as_bytes())?,
                }
            }
            done();
        }
        drop(done);
        let plots = folder.join(PLOTS);
        if !self.figures.is_empty() {
            make_folder(&plots).map_err(|error| FileError::Write { path: plots.clone(), error })?;
        }
        let names = self.names;
        let done = begin("drawing figures", self.figures.len());
        let write = |figure| {
            let written = write_figure(&plots, figure, names, &batch);
            done();
            written
        };
        let written: Vec<Result<WrittenFigure, ReportError>> =
            self.figures.par_iter().map(write).collect();
        drop(done);
        let mut on_page: Vec<PageFigure<'_>> = Vec::new();
        // A figure that cannot be drawn must not take the others with it.
        let mut wrong = None;
        let mut drawn: Vec<(&NamedFigure, WrittenFigure)> = Vec::new();
        for (figure, written) in self.figures.iter().zip(written) {
            match written {
                Ok(written) => drawn.push((figure, written)),
                Err(error @ ReportError::Plot { .. }) => {
                    let path = format!("{PLOTS}/{}.", figure.name);
                    files.retain(|file| !file.starts_with(&path));
                    wrong = wrong.or(Some(error));
                }
                Err(error) => return Err(error),
            }
        }
        for (figure, WrittenFigure { caption, width_px, image, .. }) in &mut drawn {
            on_page.push(PageFigure {
                path: format!("{PLOTS}/{}", figure.name),
                caption,
                alternative: in_words(&figure.figure),
                endings: figure.endings().collect(),
                width_px: *width_px,
                image: image.take(),
            });
        }
        let _writing = begin("writing the page", 0);
        let page = (self.page)(&on_page);
        match &self.forward {
            None => batch.write(&folder.join(INDEX_HTML), page.as_bytes())?,
            Some(index) => {
                batch.write(&folder.join(REPORT_HTML), page.as_bytes())?;
                batch.write(&folder.join(INDEX_HTML), index.as_bytes())?;
            }
        }
        remove(folder, old.iter().filter(|old| !files.contains(old)));
        write_manifest(folder, files, &batch)?;
        wrong.map_or_else(|| Ok(warnings(&drawn)), Err)
    }
}

/// The warnings about figures, each once.
fn warnings(drawn: &[(&NamedFigure, WrittenFigure)]) -> Vec<String> {
    let mut warnings: Vec<String> = Vec::new();
    for (figure, written) in drawn {
        for warning in figure.warnings.iter().chain(&written.warnings) {
            if !warnings.contains(warning) {
                warnings.push(warning.clone());
            }
        }
    }
    let missing = drawn.iter().map(|(f, written)| (f.name.as_str(), &written.missing));
    warnings.extend(missing_in_words(missing));
    warnings
}

fn write_manifest(folder: &Path, files: Vec<String>, batch: &Batch) -> Result<(), FileError> {
    let manifest = Manifest { schema: SCHEMA.to_owned(), files };
    batch.write_json(&folder.join(REPORT_JSON), &manifest)
}

/// Removes the tables and figures of an earlier run.
pub fn clear(folder: &Path) {
    let old = drawn_before(folder);
    if !old.is_empty() {
        remove(folder, old.iter());
        // If the list cannot be removed, it does no harm.
        let _ = take_away(&folder.join(REPORT_JSON));
    }
}

/// A figure whose files were written.
struct WrittenFigure {
    /// Its caption, which says if it is empty.
    caption: String,
    /// The width in pixels that it has on a page.
    width_px: f64,
    /// The picture on a page, of the first format that a browser shows.
    image: Option<String>,
    warnings: Vec<String>,
    /// Characters that its PDF or PNG lacks.
    missing: BTreeSet<char>,
}

/// Writes the files of a figure.
fn write_figure(
    plots: &Path,
    figure: &NamedFigure,
    names: CsvNames,
    batch: &Batch,
) -> Result<WrittenFigure, ReportError> {
    let NamedFigure { name, caption, figure, settings, .. } = figure;
    let failed = |error| ReportError::Plot { name: name.clone(), error };
    let mut shown = for_picture(figure);
    if *settings != FigureSettings::default() {
        set_axes(shown.to_mut(), settings);
    }
    let unseen = unseen_in_words(&shown.unseen());
    let warnings = unseen.iter().map(|unseen| format!("{name}: {unseen}")).collect();
    let caption = [caption.as_str()].into_iter().chain(unseen.iter().map(String::as_str));
    let caption = caption.collect::<Vec<_>>().join("; ");
    let printed = shown.print(&style_of(&shown, settings)).map_err(failed)?;
    let formats = formats(settings);
    let is_drawn = formats.iter().any(|format| *format != FigureFormat::Svg);
    let missing = if is_drawn { printed.missing_characters() } else { BTreeSet::new() };
    let mut image = None;
    for format in formats {
        let bytes = match format {
            FigureFormat::Svg => printed.svg().map(String::into_bytes),
            FigureFormat::Pdf => printed.pdf(&caption),
            FigureFormat::Png => printed.png(PNG_DPI),
        };
        let bytes = bytes.map_err(failed)?;
        batch.write(&plots.join(format!("{name}.{}", format.word())), &bytes)?;
        image = image.or_else(|| data_image(format.word(), &bytes));
    }
    let data = names.in_csv(figure.csv());
    batch.write(&plots.join(format!("{name}.csv")), data.as_bytes())?;
    Ok(WrittenFigure { caption, width_px: printed.screen_width_px(), image, warnings, missing })
}

/// The files in the last list. Only names that a report could have written are accepted, because
/// anybody could have changed the list.
pub(crate) fn drawn_before(folder: &Path) -> Vec<String> {
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
        Some((PLOTS, name)) => plain(name) && ends(name, &["svg", "pdf", "png", "csv"]),
        Some(_) => false,
        None => {
            [INDEX_HTML, REPORT_HTML].contains(&file)
                || (["table", "ratios"].iter().any(|name| file.starts_with(name))
                    && plain(file)
                    && ends(file, &["md", "csv", "tex"]))
        }
    }
}

fn remove<'a>(folder: &Path, files: impl Iterator<Item = &'a String>) {
    for file in files {
        // The user may have removed the file already.
        let _ = take_away(&folder.join(file));
    }
}

/// File names, each of which is used only once.
#[derive(Default)]
pub(crate) struct Names(BTreeSet<String>);

impl Names {
    /// The name, with a number appended if it is used already.
    pub(crate) fn free(&mut self, name: &str) -> String {
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
            "report.html",
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
