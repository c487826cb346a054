//! Reads the folder of a finished run.

use std::path::Path;

use fovqa_engine::shard_in;
use fovqa_results::{FileError, RUN_JSON, RunRecord, RunValues, check_files};

use crate::error::Error;

/// The record and the values of a finished run.
#[derive(Debug)]
pub struct FinishedRun {
    /// The record: experiment, settings and inputs.
    pub record: RunRecord,
    /// The values.
    pub values: RunValues,
    /// A warning about its files.
    pub warning: Option<String>,
}

impl FinishedRun {
    /// Reads the folder of a run.
    ///
    /// # Errors
    /// If it contains no finished run, or the run is damaged.
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
            let record = RunRecord::read(folder)?;
            // The values are read before the checksums, because their errors explain more than a
            // wrong checksum.
            let values = RunValues::read(folder, (&record.resolved).into())?;
            let warning = check_files(folder, &record)?;
            Ok(Self { record, values, warning })
        };
        read().map_err(|error| Error::input(error.to_string(), "run the experiment again"))
    }
}
