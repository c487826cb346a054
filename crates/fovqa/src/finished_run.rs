//! The folder of a finished run, read for whoever looks at its values.

use std::path::Path;

use fovqa_engine::shard_in;
use fovqa_results::{
    FileError, RUN_JSON, RUN_SCHEMA, RunRecord, RunValues, check_files, read_json_file,
};

use crate::error::Error;

/// What a run was of, and what it found.
#[derive(Debug)]
pub struct FinishedRun {
    /// What it was of.
    pub record: RunRecord,
    /// Its values.
    pub values: RunValues,
    /// What the user should know of its files.
    pub warning: Option<String>,
}

impl FinishedRun {
    /// Reads the folder of a run.
    ///
    /// # Errors
    /// When there is no finished run in it, or it is damaged.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        if !folder.join(RUN_JSON).is_file() {
            let shown = folder.display();
            let (message, help) = match shard_in(folder) {
                Some(shard) => (
                    format!(
                        "{shown}: the folder contains shard {shard} of a run, but no results yet"
                    ),
                    "`fovqa merge` joins shards",
                ),
                None => (
                    format!("{shown}: the folder contains no finished run"),
                    "give the folder that `fovqa run` wrote to",
                ),
            };
            return Err(Error::input(message, help));
        }
        let read = || -> Result<Self, FileError> {
            let record: RunRecord =
                read_json_file(&folder.join(RUN_JSON), RUN_SCHEMA, "the record of a run")?;
            // What is wrong in them says more than that something is.
            let values = RunValues::read(folder, (&record.resolved).into())?;
            let warning = check_files(folder, &record)?;
            Ok(Self { record, values, warning })
        };
        read().map_err(|error| Error::input(error.to_string(), "run the experiment again"))
    }
}
