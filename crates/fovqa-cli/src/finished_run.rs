//! The folder of a finished run, read for whoever looks at its values.

use std::path::Path;

use fovqa_results::{FileError, RUN_JSON, RUN_SCHEMA, RunRecord, RunValues, read_json_file};

use crate::diagnostic;
use crate::exit::Exit;

/// What a run was of, and what it found.
#[derive(Debug)]
pub(crate) struct FinishedRun {
    pub(crate) record: RunRecord,
    pub(crate) values: RunValues,
}

impl FinishedRun {
    /// Reads a folder; what is wrong with it has been said otherwise.
    pub(crate) fn read(folder: &Path) -> Result<Self, Exit> {
        if !folder.join(RUN_JSON).is_file() {
            let message = format!("{}: there is no finished run in it", folder.display());
            diagnostic::error(&message, "give the folder that `fovqa run` wrote to");
            return Err(Exit::Input);
        }
        let read = || -> Result<Self, FileError> {
            let record = read_json_file(&folder.join(RUN_JSON), RUN_SCHEMA, "the record of a run")?;
            Ok(Self { record, values: RunValues::read(folder)? })
        };
        read().map_err(|error| {
            diagnostic::error(&error.to_string(), "run the experiment again");
            Exit::Input
        })
    }
}
