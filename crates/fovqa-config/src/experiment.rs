//! An experiment file to an experiment.

use std::path::Path;

use fovqa_plan::Experiment;

use crate::fault::ExperimentError;
use crate::file;
use crate::grammar::EXPERIMENT;
use crate::resolve;

/// Reads an experiment file. No other file is looked at.
///
/// # Errors
/// When it cannot be read, or has mistakes in it: all that can be told, in one go.
pub fn read_experiment(path: &Path) -> Result<Experiment, ExperimentError> {
    let text = file::read(path)?;
    parse_experiment(path, text)
}

/// Parses the text of an experiment file; relative paths in it begin in the folder of `path`.
///
/// # Errors
/// When it has mistakes in it.
pub fn parse_experiment(path: &Path, text: String) -> Result<Experiment, ExperimentError> {
    let resolved = file::parse(path, &text, EXPERIMENT, |root, faults| {
        resolve::experiment(root, path, &text, faults)
    });
    Ok(Experiment { text, ..resolved? })
}
