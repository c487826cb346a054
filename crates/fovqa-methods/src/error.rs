//! What is wrong with a method or its setting.

use thiserror::Error;

/// A method that cannot be applied.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MethodError {
    /// A frame, focal length or gaze that cannot be.
    #[error("{0}")]
    Setting(String),
    /// Parameters that do not go together, or not with the frame.
    #[error("{method}: {message}")]
    Params {
        /// The method.
        method: &'static str,
        /// What is wrong, and what would do.
        message: String,
    },
}
