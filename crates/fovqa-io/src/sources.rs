//! The list of sources that a path argument may stand for.

use std::path::Path;
use std::sync::Arc;

use fovqa_frame::source::{Source, SourceError};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::files::{Files, SourceOptions};
use crate::sequence::{ListingError, list_below};

/// Settings of one format alone, a field a format.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct FormatOptions {}

/// A path argument without a source.
#[derive(Debug, Error)]
pub enum OpenError {
    /// It stands for nothing, or for more than can be told apart.
    #[error(transparent)]
    Listing(#[from] ListingError),
    /// It is there, and no sequence of frames.
    #[error(transparent)]
    Source(#[from] SourceError),
}

/// The source of a path argument: a file, a folder, a glob or a pattern. Wildcards in the folder of
/// `options.base` are none.
///
/// # Errors
/// When the argument stands for nothing, or for something that is no sequence of frames.
pub fn open_source(argument: &Path, options: SourceOptions) -> Result<Arc<dyn Source>, OpenError> {
    let files = list_below(&options.base, argument)?;
    Ok(Arc::new(Files::new(&files, options)))
}
