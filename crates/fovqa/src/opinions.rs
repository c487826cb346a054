//! The mean opinion scores of an experiment (`[study]`). A copy in the results folder lets the report be
//! made again without the table.

use std::path::{Path, PathBuf};
use std::{fs, io};

use fovqa_engine::Events;
use fovqa_plan::Experiment;
use fovqa_results::{OPINIONS_CSV, write_whole};
use fovqa_study::input::{Data, Table};
use fovqa_study::metrics::{Condition, opinions};

use crate::error::Error;

/// A condition in a message beyond these is only counted.
const MOST_NAMED: usize = 5;

/// The table.
#[derive(Debug)]
pub(crate) struct Opinions {
    bytes: Vec<u8>,
    /// What the user should know of it: conditions that are not in the experiment.
    warning: Option<String>,
}

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
        let read = Table::read(&shown, &bytes)
            .and_then(|table| opinions(&Data::new(&table, &selection)?))
            .map_err(|error| {
                let help = error.help().replace("--column ", "[study]: ").replace('=', " = ");
                Error::input(error.to_string(), help.replace("NAME", "\"NAME\""))
            })?;
        let warning = unknown(experiment, &shown, &read);
        Ok(Some(Self { bytes, warning }))
    }

    /// What the user should know of the table before anything is scored.
    pub(crate) fn warn(&self, events: &dyn Events) {
        if let Some(warning) = &self.warning {
            events.warn(warning);
        }
    }

    /// Writes the table into a results folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Error> {
        write_whole(&folder.join(OPINIONS_CSV), &self.bytes).map_err(|error| {
            Error::input(error.to_string(), "free some space, or give another folder with {output}")
        })
    }
}

/// Which conditions are not in an experiment, in words; `None` if all are.
fn unknown(experiment: &Experiment, file: &str, conditions: &[Condition]) -> Option<String> {
    let plan = &experiment.plan;
    let is_known = |condition: &&Condition| {
        plan.scenes.iter().any(|scene| scene.name == condition.scene)
            && plan.methods.contains(&condition.method)
    };
    let unknown: Vec<String> = conditions
        .iter()
        .filter(|condition| !is_known(condition))
        .map(|condition| format!("{}/{}", condition.scene, condition.method))
        .collect();
    let more = match unknown.len().saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let named = unknown.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    (!unknown.is_empty()).then(|| {
        format!(
            "{file}: the experiment has no {named}{more} (scene/method): their scores are not used"
        )
    })
}

/// Checks the mean opinion scores of an experiment.
///
/// # Errors
/// If the table cannot be read, or has no opinion scores.
pub fn check_study_of(experiment: &Experiment, events: &dyn Events) -> Result<(), Error> {
    if let Some(opinions) = Opinions::read(experiment)? {
        opinions.warn(events);
    }
    Ok(())
}

/// Checks that shards have the same opinion scores.
///
/// # Errors
/// If two of them differ.
pub(crate) fn check_shards(shards: &[PathBuf]) -> Result<(), Error> {
    let tables =
        shards.iter().filter_map(|shard| Some((shard, fs::read(shard.join(OPINIONS_CSV)).ok()?)));
    let tables: Vec<(&PathBuf, Vec<u8>)> = tables.collect();
    let Some((first, known)) = tables.first() else { return Ok(()) };
    match tables.iter().find(|(_, table)| table != known) {
        None => Ok(()),
        Some((other, _)) => {
            let (a, b) = (first.display(), other.display());
            let message = format!("{a} and {b} have different opinion scores ({OPINIONS_CSV})");
            let help = "run one of them again with {resume}, which takes the present table";
            Err(Error::input(message, help))
        }
    }
}

/// Copies the table of a shard, if it has one, into the folder of the merged results.
pub(crate) fn copy_opinions(shard: &Path, results: &Path) -> io::Result<()> {
    match fs::read(shard.join(OPINIONS_CSV)) {
        Ok(bytes) => write_whole(&results.join(OPINIONS_CSV), &bytes).map_err(io::Error::other),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(error),
    }
}
