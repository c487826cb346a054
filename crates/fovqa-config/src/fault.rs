//! Mistakes in an experiment file and their positions.

use std::ops::Range;
use std::path::PathBuf;

use thiserror::Error;

/// One mistake: what is wrong, where, and how to correct it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong.
    pub message: String,
    /// The range of bytes in the file that it concerns; empty if it concerns the whole file.
    pub span: Range<usize>,
    /// A short label at the position, such as "did you mean psnr?"; may be empty.
    pub label: String,
    /// How to correct it; may be empty.
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

/// The mistakes of a file, up to a maximum number.
#[derive(Debug, Default)]
pub(crate) struct Faults(Vec<Fault>);

impl Faults {
    /// Maximum number of mistakes that are stored. A message may list every known name, and a file
    /// may contain a million mistakes.
    const MOST: usize = 10_000;
    /// From this number on, checks that compare an item with all others are skipped.
    const MANY: usize = 1000;

    pub(crate) fn push(&mut self, fault: Fault) {
        if self.0.len() < Self::MOST {
            self.0.push(fault);
        }
    }

    pub(crate) fn extend(&mut self, faults: impl IntoIterator<Item = Fault>) {
        faults.into_iter().for_each(|fault| self.push(fault));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether there are so many mistakes that slow checks are skipped.
    pub(crate) fn are_many(&self) -> bool {
        self.0.len() >= Self::MANY
    }

    /// The mistakes in the order of the file.
    pub(crate) fn in_order(mut self) -> Vec<Fault> {
        self.0.sort_by_key(|fault| (fault.span.start, fault.span.end));
        // General tables are checked again for each scene and eye, which repeats their mistakes.
        self.0.dedup();
        self.0
    }
}

/// Why an experiment file or a curves file is not valid.
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
