//! Where frames come from.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::builtin::BuiltinFrames;
use crate::emulation::Emulation;

/// Where the frames of a sequence come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SourceSpec {
    /// A file, folder, glob or printf pattern.
    Files(PathBuf),
    /// A source that the program provides under this name when it runs the plan, such as images in
    /// memory.
    Given(String),
    /// A built-in sequence, which needs no files.
    Builtin(BuiltinFrames),
    /// Tests that are emulated from the reference. A reference cannot be one.
    Emulated(Box<Emulation>),
}

impl Default for SourceSpec {
    fn default() -> Self {
        Self::Files(PathBuf::new())
    }
}

impl From<PathBuf> for SourceSpec {
    fn from(path: PathBuf) -> Self {
        Self::Files(path)
    }
}

impl From<Emulation> for SourceSpec {
    fn from(emulation: Emulation) -> Self {
        Self::Emulated(Box::new(emulation))
    }
}

impl From<&str> for SourceSpec {
    fn from(path: &str) -> Self {
        Self::Files(path.into())
    }
}
