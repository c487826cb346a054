//! A page about several results folders, such as those of all figures of the papers.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use askama::Template;
use fovqa_results::{
    CURVES_JSON, CURVES_SCHEMA, CurvesRecord, FileError, INDEX_HTML, REPORT_HTML, RUN_JSON,
    RUN_SCHEMA, RunRecord, STUDIES_SCHEMA, STUDY_JSON, open_result_file, read_json_file,
    write_whole,
};
use serde::Deserialize;

use crate::page::{Shell, address};
use crate::sheet::{PLOTS, ReportError, drawn_before};

/// Marks a page as written by fovqa, so that it may be replaced.
const MARK: &str = "<meta name=\"generator\" content=\"fovqa report\">";

/// What the page says of a study.
#[derive(Default, Deserialize)]
struct StudyRecord {
    name: String,
    about: String,
}

/// Whether a folder has the results of a study file. Those of a single analysis have no page.
fn is_study(folder: &Path) -> bool {
    let record: Result<StudyRecord, FileError> =
        read_json_file(&folder.join(STUDY_JSON), STUDIES_SCHEMA, "the record of a study");
    record.is_ok()
}

/// A folder of results.
struct Entry {
    /// Its name relative to the folder that contains all of them.
    folder: String,
    name: String,
    about: String,
    /// The page about it, within the folder.
    page: &'static str,
    /// Paths of its figures relative to the page, and which ones they are in words.
    figures: Vec<(String, String)>,
    /// Paths of its tables in Markdown format.
    tables: Vec<String>,
}

/// Writes `index.html` about the results folders within a folder. Returns the number of these
/// folders; `None` if there are none.
///
/// # Errors
/// If a record cannot be read, or the page was not written by fovqa or cannot be written.
pub fn draw_index(folder: &Path) -> Result<Option<usize>, ReportError> {
    let unreadable = |error| FileError::Read { path: folder.to_owned(), error };
    let mut paths: Vec<PathBuf> = Vec::new();
    for item in fs::read_dir(folder).map_err(unreadable)? {
        let path = item.map_err(unreadable)?.path();
        if [RUN_JSON, CURVES_JSON].iter().any(|file| path.join(file).is_file()) || is_study(&path) {
            paths.push(path);
        }
    }
    if paths.is_empty() {
        return Ok(None);
    }
    paths.sort_by_key(|path| sorting(&path.file_name().unwrap_or_default().to_string_lossy()));
    let page = folder.join(INDEX_HTML);
    if page.symlink_metadata().is_ok() && !is_ours(&page) {
        return Err(ReportError::Foreign { path: page });
    }
    let entries: Result<Vec<Entry>, FileError> =
        paths.iter().map(|path| Entry::read(path)).collect();
    let entries = entries?;
    let name = folder.canonicalize().ok();
    let name = name.as_deref().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
    write_whole(&page, html(&name, &entries).as_bytes())?;
    Ok(Some(entries.len()))
}

/// Whether a page was written by fovqa.
fn is_ours(page: &Path) -> bool {
    let mut text = String::new();
    let read = open_result_file(page).map(|mut file| file.read_to_string(&mut text));
    // If a page cannot be read, the attempt to write it reports why.
    !matches!(read, Ok(Ok(_))) || text.contains(MARK)
}

/// A sort key that compares numbers in names as numbers, so that fig-8 comes before fig-10.
fn sorting(name: &str) -> Vec<(String, u64)> {
    let mut parts: Vec<(String, u64)> = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let start = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let digits = &rest[start..];
        let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        parts.push((rest[..start].to_owned(), digits[..end].parse().unwrap_or(u64::MAX)));
        rest = &digits[end..];
    }
    parts
}

impl Entry {
    fn read(path: &Path) -> Result<Self, FileError> {
        let (name, about) = if path.join(CURVES_JSON).is_file() {
            let record: CurvesRecord =
                read_json_file(&path.join(CURVES_JSON), CURVES_SCHEMA, "a record of curves")?;
            (record.name, record.about)
        } else if !path.join(RUN_JSON).is_file() {
            let record: StudyRecord =
                read_json_file(&path.join(STUDY_JSON), STUDIES_SCHEMA, "the record of a study")?;
            (record.name, record.about)
        } else {
            let record: RunRecord =
                read_json_file(&path.join(RUN_JSON), RUN_SCHEMA, "the record of a run")?;
            (record.resolved.name, record.resolved.about.unwrap_or_default())
        };
        let folder = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let drawn = drawn_before(path);
        // Curves, limits and runs of earlier versions have no other page than their index.
        let has_report = drawn.iter().any(|file| file == REPORT_HTML);
        let page = if has_report { REPORT_HTML } else { INDEX_HTML };
        let plots = || drawn.iter().filter(|file| file.starts_with(PLOTS));
        // A figure is shown by its SVG, or by its PNG if it has none.
        let figures = plots().filter(|file| match file.strip_suffix(".png") {
            Some(name) => !drawn.contains(&format!("{name}.svg")),
            None => file.strip_suffix(".svg").is_some(),
        });
        let figures = figures.map(|file| {
            let figure = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
            (format!("{folder}/{file}"), format!("Figure {figure} of {name}"))
        });
        let figures = figures.collect();
        let tables = drawn.iter().filter(|file| file.strip_suffix(".md").is_some());
        let tables = tables.map(|file| format!("{folder}/{file}"));
        Ok(Self { about, figures, tables: tables.collect(), page, folder, name })
    }

    /// The folder as an address.
    fn address(&self) -> String {
        address(&self.folder)
    }
}

#[derive(Template)]
#[template(path = "folders.html")]
struct FoldersPage<'a> {
    shell: Shell,
    mark: &'static str,
    entries: &'a [Entry],
    version: &'static str,
}

fn html(name: &str, entries: &[Entry]) -> String {
    let page = FoldersPage {
        shell: Shell::with_files(name),
        mark: MARK,
        entries,
        version: env!("CARGO_PKG_VERSION"),
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_in_their_order() {
        let mut names = ["vafr-fig-10", "vafr-fig-8", "rmfr-fig-11", "vafr-fig-5", "vafr-table-1"];
        names.sort_by_key(|name| sorting(name));
        assert_eq!(
            names,
            ["rmfr-fig-11", "vafr-fig-5", "vafr-fig-8", "vafr-fig-10", "vafr-table-1"]
        );
    }

    #[test]
    fn pages_of_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(draw_index(folder.path()).unwrap(), None);
        let inner = folder.path().join("a #1");
        fs::create_dir(&inner).unwrap();
        let record = "{\"schema\": \"fovqa.curves/1\", \"version\": \"0\", \"name\": \"a<b\", \
                      \"about\": \"\", \"acuity\": \"\", \"curves\": []}";
        fs::write(inner.join(CURVES_JSON), record).unwrap();
        let page = folder.path().join("index.html");
        fs::write(&page, "mine").unwrap();
        assert!(matches!(draw_index(folder.path()), Err(ReportError::Foreign { .. })));
        fs::remove_file(&page).unwrap();
        for _ in 0..2 {
            assert_eq!(draw_index(folder.path()).unwrap(), Some(1));
            assert!(
                fs::read_to_string(&page).unwrap().contains("href=\"a%20%231/index.html\">a&#60;b")
            );
        }
    }
}
