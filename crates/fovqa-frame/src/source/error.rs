//! Errors of sources that cannot read a frame.

use thiserror::Error;

/// A frame that a source cannot read. The message names it. The help says how to correct the error;
/// it has settings in braces (`{alpha=ignore}`), which the caller shows in the user's notation.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct SourceError {
    /// What is wrong, and where.
    pub message: String,
    /// How to correct it.
    pub help: String,
    /// Whether the source has ended: neither this frame nor any later one exists.
    pub has_ended: bool,
}

impl SourceError {
    /// An error of a single frame.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into(), has_ended: false }
    }
}
