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

/// The mistakes of a file, as far as anybody will read them.
#[derive(Debug, Default)]
pub(crate) struct Faults(Vec<Fault>);

impl Faults {
    /// Beyond these nothing is added: a mistake may name everything there is, and a file may have a
    /// million of them.
    const MOST: usize = 10_000;
    /// With these nothing is looked for that takes a look at everything else.
    const MANY: usize = 1000;

    pub(crate) fn push(&mut self, fault: Fault) {
        if self.0.len() < Self::MOST {
            self.0.push(fault);
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no use in looking far for more.
    pub(crate) fn are_many(&self) -> bool {
        self.0.len() >= Self::MANY
    }

    /// In the order of the file.
    pub(crate) fn in_order(mut self) -> Vec<Fault> {
        self.0.sort_by_key(|fault| (fault.span.start, fault.span.end));
        // What is general is read once for each scene and eye.
        self.0.dedup();
        self.0
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
