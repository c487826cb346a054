//! What a TOML file describes, as its tables tell.

use std::path::Path;

use crate::fault::ExperimentError;
use crate::file;

/// What a TOML file describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Scenes, methods and metrics.
    Experiment,
    /// Curves, their figures and tables.
    Curves,
    /// Analyses of user studies.
    Study,
}

/// What a file describes; `None` if that cannot be told, because it has tables of several kinds or none, or
/// is not TOML.
///
/// # Errors
/// If it cannot be read.
pub fn file_kind(path: &Path) -> Result<Option<FileKind>, ExperimentError> {
    let text = file::read(path)?;
    let keys = file::keys(&text);
    let has = |wanted: &[&str]| keys.iter().any(|key| wanted.contains(&key.as_str()));
    Ok(if has(&["curve", "plot", "table"]) && !has(&["scene", "method", "metrics", "signal"]) {
        Some(FileKind::Curves)
    } else if has(&["analysis"]) && !has(&["scene", "method", "metrics"]) {
        Some(FileKind::Study)
    } else if has(&["scene"]) && !has(&["curve", "analysis"]) {
        Some(FileKind::Experiment)
    } else {
        None
    })
}
