//! Turns a curves file into a plan of curves.

use std::path::Path;

use fovqa_plan::CurvesFile;

use crate::fault::ExperimentError;
use crate::file;
use crate::grammar::CURVES;
use crate::resolve;

/// Reads a curves file. No other file is read.
///
/// # Errors
/// If it cannot be read or contains mistakes. All mistakes that can be found are returned together.
pub fn read_curves(path: &Path) -> Result<CurvesFile, ExperimentError> {
    parse_curves(path, file::read(path)?)
}

/// Parses the text of a curves file.
///
/// # Errors
/// If it contains mistakes.
pub fn parse_curves(path: &Path, text: String) -> Result<CurvesFile, ExperimentError> {
    let (name, about, plan) =
        file::parse(path, &text, ("the curve file", CURVES), resolve::curves)?;
    Ok(CurvesFile { name, about, path: path.to_owned(), text, plan })
}
