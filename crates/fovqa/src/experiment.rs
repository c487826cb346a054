//! Reads experiment files, curves files and study files.

use std::path::Path;

use fovqa_plan::{CurvesFile, Experiment, StudyFile};

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
    if matches!(fovqa_config::is_study(path), Ok(true)) {
        let message = format!("{}: this is a study file", path.display());
        let help = "`fovqa study` carries it out, and `fovqa check` checks it";
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

/// Reads a study file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes.
pub fn read_study(path: &Path) -> Result<StudyFile, Error> {
    Ok(fovqa_config::read_study(path)?)
}
