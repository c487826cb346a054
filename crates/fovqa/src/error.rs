//! Errors. Each says what is wrong, where, and how to correct it.

use fovqa_config::ExperimentError;
use fovqa_engine::EngineError;
use thiserror::Error;

/// Why a request cannot be fulfilled.
///
/// Help texts contain settings in braces, `{alpha=ignore}`. The code that shows a text replaces
/// them by what the user writes: an option of a command, or a key of an experiment file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// An experiment file or a curves file that contains mistakes.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// The request is not possible. Nothing was read.
    #[error("{}", listed(.0))]
    Usage(Vec<Complaint>),
    /// An input is missing, unreadable or does not fit, or an output cannot be written.
    #[error("{}", listed(.0))]
    Input(Vec<Complaint>),
}

/// One error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// What is wrong, and where.
    pub message: String,
    /// How to correct it; may be empty.
    pub help: String,
}

impl Error {
    /// An error in the request.
    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage(vec![Complaint { message: message.into(), help: help.into() }])
    }

    /// An error in an input or an output.
    pub(crate) fn input(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Input(vec![Complaint { message: message.into(), help: help.into() }])
    }

    /// Whether the error is in the request rather than in an input.
    pub fn is_usage(&self) -> bool {
        !matches!(self, Self::Input(_))
    }
}

impl From<EngineError> for Error {
    fn from(error: EngineError) -> Self {
        let complaint = vec![Complaint { message: error.to_string(), help: error.help() }];
        if error.is_usage() { Self::Usage(complaint) } else { Self::Input(complaint) }
    }
}

fn listed(complaints: &[Complaint]) -> String {
    let messages: Vec<&str> = complaints.iter().map(|c| c.message.as_str()).collect();
    messages.join("; ")
}
