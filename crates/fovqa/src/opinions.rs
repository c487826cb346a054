//! The mean opinion scores of an experiment (`[study]`). A copy in the results folder lets the report be
//! made again without the table.

use std::path::Path;
use std::{fs, io};

use fovqa_plan::Experiment;
use fovqa_results::{OPINIONS_CSV, write_whole};
use fovqa_study::input::{Data, Table};
use fovqa_study::metrics::check_opinions;

use crate::error::Error;

/// The bytes of the table.
#[derive(Debug)]
pub(crate) struct Opinions(Vec<u8>);

impl Opinions {
    /// Reads the table of an experiment, and checks that it has opinion scores; `None` if the experiment
    /// has none.
    ///
    /// # Errors
    /// If the table cannot be read, or has no opinion scores.
    pub(crate) fn read(experiment: &Experiment) -> Result<Option<Self>, Error> {
        let Some(study) = &experiment.study else { return Ok(None) };
        let path = experiment.plan.base.join(&study.file);
        let shown = path.display().to_string();
        let bytes = fs::read(&path).map_err(|error| {
            let help = "correct file in [study]: a CSV table with the columns scene, method, value";
            Error::input(format!("{shown} cannot be read: {error}"), help)
        })?;
        let selection = study.selection();
        let checked = Table::read(&shown, &bytes)
            .and_then(|table| check_opinions(&Data::new(&table, &selection)?));
        checked.map_err(|error| {
            let help = error.help().replace("--column ", "a key of [study]: ");
            Error::input(error.to_string(), help)
        })?;
        Ok(Some(Self(bytes)))
    }

    /// Writes the table into a results folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Error> {
        write_whole(&folder.join(OPINIONS_CSV), &self.0).map_err(|error| {
            Error::input(error.to_string(), "free some space, or give another folder with {output}")
        })
    }
}

/// Checks the mean opinion scores of an experiment.
///
/// # Errors
/// If the table cannot be read, or has no opinion scores.
pub fn check_study_of(experiment: &Experiment) -> Result<(), Error> {
    Opinions::read(experiment).map(|_| ())
}

/// Copies the table of a shard, if it has one, into the folder of the merged results.
pub(crate) fn copy_opinions(shard: &Path, results: &Path) -> io::Result<()> {
    match fs::read(shard.join(OPINIONS_CSV)) {
        Ok(bytes) => write_whole(&results.join(OPINIONS_CSV), &bytes).map_err(io::Error::other),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(error),
    }
}
