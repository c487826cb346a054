//! What can be wrong with an experiment file, and where in it.

use std::ops::Range;
use std::path::PathBuf;

use thiserror::Error;

/// One mistake: what, where, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong.
    pub message: String,
    /// The bytes of the file it is about; empty where it is about the whole.
    pub span: Range<usize>,
    /// A few words at the place, such as "did you mean psnr?"; may be empty.
    pub label: String,
    /// How to mend it; may be empty.
    pub help: String,
}

impl Fault {
    pub(crate) fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { message: message.into(), span, label: String::new(), help: String::new() }
    }

    pub(crate) fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: help.into(), ..self }
    }
}

/// An experiment file that is none.
#[derive(Debug, Error)]
pub enum ExperimentError {
    /// A file that cannot be read.
    #[error("{}: the file cannot be read: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// A file with mistakes in it.
    #[error("{}: {} {}", path.display(), faults.len(), if faults.len() == 1 { "mistake" } else { "mistakes" })]
    Faults {
        /// The file.
        path: PathBuf,
        /// Its text.
        text: String,
        /// The mistakes, in the order of the file; at least one.
        faults: Vec<Fault>,
    },
}
