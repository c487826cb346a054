//! Reads, saves and updates the baselines that a gate compares with.

mod frames;

pub(crate) use frames::{BaselineFrames, place_metric};

use std::path::{Path, PathBuf};

use fovqa_results::{Baseline, Difference, replaces, write_json_output};

use crate::error::Error;
use crate::finish::text_hash;
use crate::finished_run::FinishedRun;
use crate::reopened::{ExperimentFile, KnownInputs, reopen};
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

/// Whether a baseline keeps the frames of its run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Frames {
    /// It keeps none.
    #[default]
    None,
    /// It keeps reduced pictures and maps of all frames in a folder beside its file. They are read again,
    /// with this experiment file, or with one of the recorded name and text that is found beside the
    /// baseline, near the working directory or around the results.
    Kept(Option<PathBuf>),
}

/// A saved baseline.
#[derive(Debug)]
pub struct Saved {
    /// The baseline.
    pub baseline: Baseline,
    /// Number of frames that it keeps.
    pub frames: usize,
    /// Whether frames of earlier values were removed.
    pub removed: bool,
}

/// Makes the baseline of a run and of further runs of the same build. Everything in the runs must have
/// been scored.
fn of_run(
    finished: &mut FinishedRun,
    results: &Path,
    repeats: &[PathBuf],
) -> Result<Baseline, Error> {
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

/// Writes a baseline and its frames. The frames are found before anything is written.
fn write(
    baseline: Baseline,
    path: &Path,
    (finished, results): (&FinishedRun, &Path),
    frames: &Frames,
) -> Result<Saved, Error> {
    let reopened = match frames {
        Frames::None => None,
        Frames::Kept(file) => {
            let beside = [path.to_owned()];
            let file = match file {
                Some(file) => ExperimentFile::At(file),
                None => ExperimentFile::Beside(&beside),
            };
            Some(reopen(results, &finished.record, file)?)
        }
    };
    if reopened.is_some() && path.exists() && !path.is_file() {
        let message =
            format!("{}: frames are kept beside a file, and this is none", path.display());
        return Err(Error::usage(message, "give a file, or leave out --frames"));
    }
    let known = KnownInputs::of(&finished.record);
    let frames = match &reopened {
        Some(reopened) => BaselineFrames::prepare(path, &baseline, reopened, &known)?,
        None => 0,
    };
    write_json_output(path, &baseline).map_err(|error| {
        BaselineFrames::forget(path);
        Error::input(error.to_string(), "give another file")
    })?;
    if reopened.is_none() {
        let folder = BaselineFrames::folder_of(path);
        let removed = BaselineFrames::remove(path).map_err(|error| {
            let message = format!("{}: {error}", folder.display());
            Error::input(message, "remove the folder: its frames are of earlier values")
        })?;
        return Ok(Saved { baseline, frames, removed });
    }
    BaselineFrames::accept(path).map_err(|error| {
        let folder = BaselineFrames::folder_of(path);
        let help =
            "the values are written; free the folder, and use `fovqa baseline accept --frames`";
        Error::input(format!("{}: {error}", folder.display()), help)
    })?;
    Ok(Saved { baseline, frames, removed: false })
}

/// Saves the values of a run as a baseline in a new file. `repeats` are the folders of further runs of the
/// same build, for rules that test the spread of repeated runs.
///
/// # Errors
/// If the file exists already, or not everything was scored, or the frames to keep are not there.
pub fn save_baseline(
    results: &Path,
    path: &Path,
    repeats: &[PathBuf],
    frames: &Frames,
) -> Result<Saved, Error> {
    if replaces(path) {
        let message = format!("{}: the file already exists", path.display());
        let help = "`fovqa baseline accept` shows what differs and updates it";
        return Err(Error::input(message, help));
    }
    let mut finished = FinishedRun::read(results)?;
    let baseline = of_run(&mut finished, results, repeats)?;
    write(baseline, path, (&finished, results), frames)
}

/// An updated baseline that is not written yet.
#[derive(Debug)]
pub struct Accepted {
    baseline: Baseline,
    finished: FinishedRun,
    results: PathBuf,
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
    let mut finished = FinishedRun::read(results)?;
    let new = of_run(&mut finished, results, repeats)?;
    let baseline = before.accepting(&new, scenes).map_err(|why| {
        let message = format!("{}: {why}", path.display());
        Error::input(message, "accept the complete run, without --scene")
    })?;
    let taken_otherwise = before.refuses(&new.resolved);
    let differences = before.differences(&new, scenes);
    let results = results.to_owned();
    Ok(Accepted { baseline, finished, results, differences, taken_otherwise })
}

impl Accepted {
    /// Writes the baseline to a file. If no frames are kept, those of earlier values are removed.
    ///
    /// # Errors
    /// If a file cannot be written, or the frames to keep are not there.
    pub fn write(self, path: &Path, frames: &Frames) -> Result<Saved, Error> {
        write(self.baseline, path, (&self.finished, &self.results), frames)
    }
}
