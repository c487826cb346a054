//! Which rows of a table are read, and the error of a file that is not a table of results.

use std::path::Path;

use crate::files::FileError;

/// Which rows of the table are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// All rows.
    All,
    /// The rows of whole frames.
    WholeFrames,
}

/// The error for a file that was not written by a run.
pub(crate) fn not_results(path: &Path, detail: String) -> FileError {
    FileError::Format { path: path.to_owned(), expected: "the results of a run", detail }
}
