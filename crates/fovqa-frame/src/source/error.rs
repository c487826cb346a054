//! Why a frame has no picture.

use thiserror::Error;

/// A frame that a source cannot give. The message names it; the help tells how to mend it, with settings in
/// braces (`{alpha=ignore}`), whose spelling is the caller's.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct SourceError {
    /// What is wrong, and where.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Whether the source has ended: there is no such frame, and none behind it.
    pub has_ended: bool,
}

impl SourceError {
    /// An error of a frame.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into(), has_ended: false }
    }
}
