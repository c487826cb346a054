//! run.json describes a run, so that its report can be made again and the run can be repeated and
//! verified.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_plan::Resolved;
use serde::{Deserialize, Serialize};

use crate::checksums::Checksums;
use crate::files::{FileError, INPUTS_CSV, RUN_JSON, read_json_file};
use crate::inputs::Inputs;
use crate::inputs_csv::read_inputs;

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
    /// Every file that was read, by path; in the file, empty if they are in [`RunRecord::inputs_file`].
    pub inputs: Inputs,
    /// The file in the same folder with all inputs, if there are more than [`MOST_LISTED_INPUTS`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_file: Option<String>,
    /// The checksums of the files beside this one; empty in files of earlier versions.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: Checksums,
}

/// The largest number of inputs that run.json lists itself: with more, it would be too large for an editor.
pub const MOST_LISTED_INPUTS: usize = 10_000;

impl RunRecord {
    /// Reads run.json in a folder, with all inputs.
    ///
    /// # Errors
    /// If there is no such file, or it is damaged.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(RUN_JSON);
        let mut record: Self = read_json_file(&path, RUN_SCHEMA, "the record of a run")?;
        match record.inputs_file.as_deref() {
            None => {}
            Some(INPUTS_CSV) => record.inputs = read_inputs(&folder.join(INPUTS_CSV))?,
            // Nothing else is read, wherever a changed record points.
            Some(other) => {
                let detail = format!("its inputs_file is {other:?}, not {INPUTS_CSV:?}");
                return Err(FileError::Format { path, expected: "the record of a run", detail });
            }
        }
        Ok(record)
    }
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
