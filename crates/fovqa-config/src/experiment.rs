//! Turns an experiment file into an experiment.

use std::path::Path;

use fovqa_plan::Experiment;

use crate::fault::ExperimentError;
use crate::file;
use crate::grammar::EXPERIMENT;
use crate::resolve;

/// Reads an experiment file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes. All mistakes that can be found are returned together.
pub fn read_experiment(path: &Path) -> Result<Experiment, ExperimentError> {
    let text = file::read(path)?;
    parse_experiment(path, text)
}

/// Parses the text of an experiment file. Its relative paths start in the folder of `path`.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_experiment(path: &Path, text: String) -> Result<Experiment, ExperimentError> {
    let resolved = file::parse(path, &text, ("the experiment", EXPERIMENT), |root, faults| {
        resolve::experiment(root, path, &text, faults)
    });
    Ok(Experiment { text, ..resolved? })
}
