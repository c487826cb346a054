//! A file of curves to a plan of curves.

use std::path::Path;

use fovqa_plan::CurvesFile;

use crate::fault::ExperimentError;
use crate::file;
use crate::grammar::CURVES;
use crate::resolve;

/// Reads a file of curves. No other file is looked at.
///
/// # Errors
/// When it cannot be read, or has mistakes in it: all that can be told, in one go.
pub fn read_curves(path: &Path) -> Result<CurvesFile, ExperimentError> {
    parse_curves(path, file::read(path)?)
}

/// Parses the text of a file of curves.
///
/// # Errors
/// When it has mistakes in it.
pub fn parse_curves(path: &Path, text: String) -> Result<CurvesFile, ExperimentError> {
    let (name, about, plan) = file::parse(path, &text, CURVES, resolve::curves)?;
    Ok(CurvesFile { name, about, path: path.to_owned(), text, plan })
}

/// Whether a file is one of curves rather than an experiment: it has curves, plots or tables, and nothing
/// that is scored.
///
/// # Errors
/// When it cannot be read.
pub fn is_curves(path: &Path) -> Result<bool, ExperimentError> {
    let text = file::read(path)?;
    let any = |keys: &[&str]| file::has(&text, keys);
    Ok(any(&["curve", "plot", "table"]) && !any(&["scene", "method", "metrics", "signal"]))
}
