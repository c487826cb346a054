//! run.json describes a run, so that its report can be made again and the run can be repeated and
//! verified.

use std::collections::BTreeMap;

use fovqa_plan::Resolved;
use serde::{Deserialize, Serialize};

use crate::checksums::Checksums;
use crate::inputs::Inputs;

/// Name and version of the format.
pub const RUN_SCHEMA: &str = "fovqa.run/1";

/// The content of run.json. It does not depend on the time, the place or the number of threads of
/// the run: the same inputs give the same bytes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// Name and version of the format.
    pub schema: String,
    /// Version of fovqa.
    pub version: String,
    /// The experiment as it was written.
    pub experiment: ExperimentRecord,
    /// The experiment with all its defaults.
    pub resolved: Resolved,
    /// Every file that was read, by path.
    pub inputs: Inputs,
    /// The checksums of the files beside this one; empty in files of earlier versions.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: Checksums,
}

/// An experiment file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ExperimentRecord {
    /// The file's name, without its folder.
    pub file: String,
    /// Its SHA-256, in hexadecimal digits.
    pub sha256: String,
    /// Its text.
    pub text: String,
}
