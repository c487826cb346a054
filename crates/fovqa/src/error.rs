//! What can go wrong: what, where, and how to mend it.

use fovqa_config::ExperimentError;
use fovqa_engine::EngineError;
use thiserror::Error;

/// Something that cannot be done.
///
/// Help texts have settings in braces, `{alpha=ignore}`: whoever shows them spells those as the user gives
/// them, as an option of a command or as a key of an experiment file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// An experiment file, or a file of curves, with mistakes in it.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// What was asked for cannot be: nothing was read.
    #[error("{}", listed(.0))]
    Usage(Vec<Complaint>),
    /// An input is missing, unreadable or does not fit, or an output cannot be written.
    #[error("{}", listed(.0))]
    Input(Vec<Complaint>),
}

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// What is wrong, and where.
    pub message: String,
    /// How to mend it; may be empty.
    pub help: String,
}

impl Error {
    /// An error of what was asked for.
    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage(vec![Complaint { message: message.into(), help: help.into() }])
    }

    /// An error of an input or an output.
    pub(crate) fn input(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Input(vec![Complaint { message: message.into(), help: help.into() }])
    }

    /// Whether what was asked for is wrong, rather than an input.
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
