//! Reads, saves and updates the baselines that a gate compares with.

use std::path::{Path, PathBuf};

use fovqa_results::{Baseline, Difference, replaces, write_json_output};

use crate::error::Error;
use crate::finish::text_hash;
use crate::finished_run::FinishedRun;
use crate::repeats::Repeats;

/// Reads a baseline.
///
/// # Errors
/// If the file does not contain a baseline.
pub fn read_baseline(path: &Path) -> Result<Baseline, Error> {
    Baseline::read(path).map_err(|error| {
        Error::input(error.to_string(), "`fovqa baseline save` makes a baseline from a run")
    })
}

/// Makes the baseline of a run and of further runs of the same build. Everything in the runs must have
/// been scored.
fn of_run(results: &Path, repeats: &[PathBuf]) -> Result<Baseline, Error> {
    let mut finished = FinishedRun::read(results)?;
    if let Some(error) = finished.values.errors.first() {
        let message = format!("{}: not everything was scored: {error}", results.display());
        let help = "a baseline needs a complete run: correct the inputs and run again";
        return Err(Error::input(message, help));
    }
    let resolved = &finished.record.resolved;
    let rules = &resolved.gates;
    Repeats::read(results, repeats, resolved, rules)?.add_to(&mut finished.values)?;
    Ok(Baseline::of(&finished.record, &finished.values, rules, &text_hash))
}

fn write(baseline: &Baseline, path: &Path) -> Result<(), Error> {
    write_json_output(path, baseline)
        .map_err(|error| Error::input(error.to_string(), "give another file"))
}

/// Saves the values of a run as a baseline in a new file. `repeats` are the folders of further runs of the
/// same build, for rules that test the spread of repeated runs.
///
/// # Errors
/// If the file exists already, not everything was scored, or the runs do not repeat the first one.
pub fn save_baseline(results: &Path, path: &Path, repeats: &[PathBuf]) -> Result<Baseline, Error> {
    if replaces(path) {
        let message = format!("{}: the file already exists", path.display());
        let help = "`fovqa baseline accept` shows what differs and updates it";
        return Err(Error::input(message, help));
    }
    let baseline = of_run(results, repeats)?;
    write(&baseline, path)?;
    Ok(baseline)
}

/// An updated baseline that is not written yet.
#[derive(Debug)]
pub struct Accepted {
    baseline: Baseline,
    /// The values that differ.
    pub differences: Vec<Difference>,
    /// Why the values of the run were computed under other conditions than the old ones.
    pub taken_otherwise: Option<String>,
}

/// Updates a baseline with the values of a run, for all scenes or only for some. For `repeats`, see
/// [`save_baseline`].
///
/// # Errors
/// If the run or the baseline cannot be read, or they do not fit together.
pub fn accept_baseline(
    results: &Path,
    path: &Path,
    scenes: &[String],
    repeats: &[PathBuf],
) -> Result<Accepted, Error> {
    let before = read_baseline(path)?;
    let new = of_run(results, repeats)?;
    let baseline = before.accepting(&new, scenes).map_err(|why| {
        let message = format!("{}: {why}", path.display());
        Error::input(message, "accept the complete run, without --scene")
    })?;
    let taken_otherwise = before.refuses(&new.resolved);
    let differences = before.differences(&new, scenes);
    Ok(Accepted { baseline, differences, taken_otherwise })
}

impl Accepted {
    /// Writes the baseline to a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        write(&self.baseline, path)
    }
}
