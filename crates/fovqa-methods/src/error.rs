//! Errors of methods and their settings.

use thiserror::Error;

/// A method that cannot be applied.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MethodError {
    /// The frame, focal length or gaze is not possible.
    #[error("{0}")]
    Setting(String),
    /// The parameters contradict each other or do not fit the frame.
    #[error("{method}: {message}")]
    Params {
        /// The method's label.
        method: &'static str,
        /// What is wrong, and how to correct it.
        message: String,
    },
}
