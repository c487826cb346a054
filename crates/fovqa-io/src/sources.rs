//! The list of sources that a path argument may stand for.

use std::path::Path;
use std::sync::Arc;

use fovqa_frame::source::Source;

use crate::files::{Files, SourceOptions};
use crate::sequence::{ListingError, list_below};

/// The source of a path argument: a file, a folder, a glob or a pattern. Wildcards in the folder of
/// `options.base` are none.
///
/// # Errors
/// When the argument stands for nothing, or for more than can be told apart.
pub fn open_source(
    argument: &Path,
    options: SourceOptions,
) -> Result<Arc<dyn Source>, ListingError> {
    let files = list_below(&options.base, argument)?;
    Ok(Arc::new(Files::new(&files, options)))
}
