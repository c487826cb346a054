//! Reads experiment files, curves files and study files.

use std::path::Path;

use fovqa_config::{FileKind, file_kind};
use fovqa_plan::{CurvesFile, Experiment, StudyFile};

use crate::error::Error;

/// Reads an experiment file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes. All mistakes that can be found are returned together.
pub fn read_experiment(path: &Path) -> Result<Experiment, Error> {
    not_of_another_kind(path, FileKind::Experiment)?;
    Ok(fovqa_config::read_experiment(path)?)
}

/// Reads a curves file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes.
pub fn read_curves(path: &Path) -> Result<CurvesFile, Error> {
    not_of_another_kind(path, FileKind::Curves)?;
    Ok(fovqa_config::read_curves(path)?)
}

/// Reads a study file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes.
pub fn read_study(path: &Path) -> Result<StudyFile, Error> {
    not_of_another_kind(path, FileKind::Study)?;
    Ok(fovqa_config::read_study(path)?)
}

/// Parses the text of an experiment. Its relative paths start in the folder of `path`, which need not exist.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_experiment(path: &Path, text: String) -> Result<Experiment, Error> {
    Ok(fovqa_config::parse_experiment(path, text)?)
}

/// Parses the text of a curves file.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_curves(path: &Path, text: String) -> Result<CurvesFile, Error> {
    Ok(fovqa_config::parse_curves(path, text)?)
}

/// Parses the text of a study file. Its relative paths start in the folder of `path`.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_study(path: &Path, text: &str) -> Result<StudyFile, Error> {
    Ok(fovqa_config::parse_study(path, text)?)
}

/// Whether a file is of another kind than is wanted, as far as that can be told. A file that cannot be read
/// or understood is explained when it is read.
fn not_of_another_kind(path: &Path, wanted: FileKind) -> Result<(), Error> {
    let Ok(Some(kind)) = file_kind(path) else { return Ok(()) };
    if kind == wanted {
        return Ok(());
    }
    let (what, command) = match kind {
        FileKind::Curves => ("a curve file", "`fovqa curves` draws it"),
        FileKind::Study => ("a study file", "`fovqa study` carries it out"),
        FileKind::Experiment => ("an experiment", "`fovqa run` runs it"),
    };
    let message = format!("{}: this is {what}", path.display());
    Err(Error::usage(message, format!("{command}, and `fovqa check` checks it")))
}
