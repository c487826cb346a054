//! The verdict in a results folder, for the page of the run.

use std::path::{Path, PathBuf};

use super::json::{GATE_SCHEMA, VerdictRecord};
use super::verdict::Verdict;
use crate::files::{FileError, read_json_file};
use crate::output::{make_folder, write_json_file};

/// The folder of the verdict and its pictures, in a results folder.
pub const GATE: &str = "gate";

fn file(results: &Path) -> PathBuf {
    results.join(GATE).join("verdict.json")
}

/// Writes the verdict into a results folder.
///
/// # Errors
/// If it cannot be written.
pub fn keep_verdict(results: &Path, verdict: &Verdict) -> Result<(), FileError> {
    let path = file(results);
    let folder = results.join(GATE);
    make_folder(&folder).map_err(|error| FileError::Write { path: folder, error })?;
    write_json_file(&path, &VerdictRecord::from(verdict))
}

/// The verdict in a results folder; `None` if there is none.
///
/// # Errors
/// If it cannot be read.
pub fn kept_verdict(results: &Path) -> Result<Option<VerdictRecord>, FileError> {
    let path = file(results);
    if !path.exists() {
        return Ok(None);
    }
    read_json_file(&path, GATE_SCHEMA, "the verdict of a gate").map(Some)
}

/// The file of the verdict, whether it exists or not.
pub fn verdict_file(results: &Path) -> PathBuf {
    file(results)
}
