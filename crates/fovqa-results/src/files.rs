//! Names of the files of a run, and functions that read them.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_io::{open_regular_file, read_small_file};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

use crate::json::CheckedKeys;

/// All values, with one row per value.
pub const RESULTS_CSV: &str = "results.csv";
/// The table of all values as Parquet.
pub const RESULTS_PARQUET: &str = "results.parquet";
/// Name of the table of the values of a shard, which has the columns of [`RESULTS_PARQUET`].
pub const VALUES_PARQUET: &str = "values.parquet";
/// Statistics over the frames.
pub const SUMMARY_JSON: &str = "summary.json";
/// The record of the run: experiment, settings and inputs.
pub const RUN_JSON: &str = "run.json";
/// The inputs of a run that has very many of them.
pub const INPUTS_CSV: &str = "inputs.csv";
/// The list of figures and tables that were made. A later report uses it to remove files that it
/// does not make again.
pub const REPORT_JSON: &str = "report.json";
/// The page of a run.
pub const REPORT_HTML: &str = "report.html";
/// The page of a curves file, of limits, and of several folders; for a run, a page that forwards to
/// [`REPORT_HTML`].
pub const INDEX_HTML: &str = "index.html";
/// All values of a curves file.
pub const CURVES_CSV: &str = "curves.csv";
/// The record of a curves file.
pub const CURVES_JSON: &str = "curves.json";
/// All values that a search for limits measured.
pub const LIMITS_CSV: &str = "limits.csv";
/// The record of a search for limits.
pub const LIMITS_JSON: &str = "limits.json";
/// The results of analyses of user studies.
pub const STUDY_JSON: &str = "study.json";
/// Schema of [`STUDY_JSON`] of a study file. That of a single analysis is `fovqa.study/1`.
pub const STUDIES_SCHEMA: &str = "fovqa.studies/1";
/// Mean opinion scores that a run compares its metrics with.
pub const OPINIONS_CSV: &str = "opinions.csv";
/// Name and version of the format of [`CURVES_JSON`].
pub const CURVES_SCHEMA: &str = "fovqa.curves/1";

/// A file of a run that cannot be written or read.
#[derive(Debug, Error)]
pub enum FileError {
    /// It cannot be written.
    #[error("{}: it cannot be written: {error}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// It cannot be read.
    #[error("{}: it cannot be read: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// It does not have the expected content.
    #[error("{}: it is not {expected}: {detail}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The expected content.
        expected: &'static str,
        /// What is wrong.
        detail: String,
    },
}

/// Maximum size in bytes, far larger than the summary of the largest run.
const MOST_BYTES: u64 = 4 << 30;

/// Opens a file of a run.
///
/// # Errors
/// If it does not exist, or is not a regular file.
pub fn open_result_file(path: &Path) -> Result<File, FileError> {
    open_regular_file(path).map_err(|error| FileError::Read { path: path.to_owned(), error })
}

/// Reads a JSON file of a run with a given schema.
///
/// # Errors
/// If it does not exist, has another format or version, or contains a key twice.
pub fn read_json_file<T: DeserializeOwned>(
    path: &Path,
    schema: &str,
    expected: &'static str,
) -> Result<T, FileError> {
    let bytes = read_small_file(path, MOST_BYTES)
        .map_err(|error| FileError::Read { path: path.to_owned(), error })?;
    let format = |detail: String| FileError::Format { path: path.to_owned(), expected, detail };
    // Do not read the file into a tree of JSON values, which would take ten times the memory of the
    // text.
    let read = |error: serde_json::Error| format(error.to_string());
    serde_json::from_slice::<CheckedKeys>(&bytes).map_err(read)?;
    let found: Schema = serde_json::from_slice(&bytes).unwrap_or_default();
    match found.schema.as_ref().and_then(serde_json::Value::as_str) {
        Some(found) if found == schema => {}
        Some(found) => return Err(format(format!("its schema is {found}, not {schema}"))),
        None => return Err(format(format!("its schema is not {schema}"))),
    }
    serde_json::from_slice(&bytes).map_err(read)
}

/// The part of a file that names its format.
#[derive(Default, Deserialize)]
struct Schema {
    schema: Option<serde_json::Value>,
}
