//! run.json: what a run was of, so that it can be drawn again, repeated and trusted.

use std::collections::BTreeMap;

use fovqa_plan::Resolved;
use serde::{Deserialize, Serialize};

use crate::checksums::Checksums;
use crate::report::Input;

/// Name and version of the format.
pub const RUN_SCHEMA: &str = "fovqa.run/1";

/// The whole file. Nothing in it tells when, where or by how many threads a run was made: the same
/// inputs give the same bytes.
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
    pub inputs: Vec<Input>,
    /// The checksums of the files beside this one; none in those of earlier versions.
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
