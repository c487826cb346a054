//! Reads experiment files and curves files.

use std::path::Path;

use fovqa_plan::{CurvesFile, Experiment};

use crate::error::Error;

/// Reads an experiment file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes. All mistakes that can be found are returned together.
pub fn read_experiment(path: &Path) -> Result<Experiment, Error> {
    if matches!(fovqa_config::is_curves(path), Ok(true)) {
        let message = format!("{}: this is a curve file", path.display());
        let help = "`fovqa curves` draws it, and `fovqa check` checks it";
        return Err(Error::usage(message, help));
    }
    Ok(fovqa_config::read_experiment(path)?)
}

/// Reads a curves file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes.
pub fn read_curves(path: &Path) -> Result<CurvesFile, Error> {
    Ok(fovqa_config::read_curves(path)?)
}
