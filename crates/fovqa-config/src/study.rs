//! Turns a study file into analyses.

use std::path::Path;

use fovqa_plan::StudyFile;

use crate::fault::ExperimentError;
use crate::file;
use crate::grammar::STUDY;
use crate::resolve;

/// Reads a study file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes. All mistakes that can be found are returned together.
pub fn read_study(path: &Path) -> Result<StudyFile, ExperimentError> {
    parse_study(path, &file::read(path)?)
}

/// Parses the text of a study file. Its relative paths start in the folder of `path`.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_study(path: &Path, text: &str) -> Result<StudyFile, ExperimentError> {
    file::parse(path, text, ("the study", STUDY), |root, faults| resolve::study(root, path, faults))
}
