//! Finds the frames of a finished run again, to look at some of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fovqa_engine::{FoundInputs, Given};
use fovqa_plan::Experiment;
use fovqa_results::{Input, RunRecord};

use crate::error::Error;
use crate::finish::text_hash;

/// A finished run with the frames that it has scored.
#[derive(Debug)]
pub(crate) struct Reopened {
    pub(crate) experiment: Experiment,
    pub(crate) found: FoundInputs,
}

/// Where the experiment file of a run is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ExperimentFile<'a> {
    /// It was given.
    At(&'a Path),
    /// It is looked for beside these files, in the working directory and its `configs`, and around the
    /// results folder.
    Beside(&'a [PathBuf]),
}

/// Finds the experiment file of a run and its frames again.
///
/// # Errors
/// If there is no such file with the same text, or its frames are not found.
pub(crate) fn reopen(
    folder: &Path,
    run: &RunRecord,
    file: ExperimentFile<'_>,
) -> Result<Reopened, Error> {
    let recorded = &run.experiment;
    let is_same = |path: &Path| {
        let text = std::fs::read_to_string(path);
        text.is_ok_and(|text| text_hash(&text) == recorded.sha256)
    };
    let path = match file {
        ExperimentFile::At(file) if is_same(file) => Some(file.to_owned()),
        ExperimentFile::At(file) if !file.is_file() => {
            let message = format!("{}: there is no such file", file.display());
            return Err(Error::input(message, "give the experiment file with {experiment}"));
        }
        ExperimentFile::At(file) => {
            let message = format!(
                "{}: this is not the experiment file that {} was scored with",
                file.display(),
                folder.display()
            );
            return Err(Error::input(
                message,
                "run the experiment again, or give its file as it was",
            ));
        }
        ExperimentFile::Beside(files) => {
            candidates(folder, &recorded.file, files).into_iter().find(|path| is_same(path))
        }
    };
    let Some(path) = path else {
        let message = format!(
            "{}: its experiment file {} was not found as it was",
            folder.display(),
            recorded.file
        );
        return Err(Error::input(
            message,
            "the frames are read again: give the file with {experiment}",
        ));
    };
    let mut experiment = fovqa_config::parse_experiment(&path, recorded.text.clone())?;
    let frames = run.resolved.frames.as_deref().map(str::parse).transpose();
    experiment.plan.frames = frames.map_err(|_| {
        Error::input(format!("{}: the record of its frames is damaged", folder.display()), "")
    })?;
    let found = fovqa_engine::find(&experiment.plan, &Given::default());
    match found.problems.first() {
        None => Ok(Reopened { experiment, found }),
        Some(problem) => {
            let message =
                format!("{}: its frames are not there: {}", folder.display(), problem.error);
            Err(Error::input(message, "the frames are read again: put them back, or run again"))
        }
    }
}

fn candidates(folder: &Path, file: &str, beside: &[PathBuf]) -> Vec<PathBuf> {
    // A record may be written by hand, and its name is looked for, wherever it points.
    let Some(name) = Path::new(file).file_name() else { return Vec::new() };
    let beside = beside.iter().filter_map(|path| path.parent().map(Path::to_owned));
    let mut folders: Vec<PathBuf> = beside.collect();
    folders.extend([PathBuf::new(), PathBuf::from("configs")]);
    let around = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    folders.extend(around.ancestors().map(Path::to_owned));
    folders.into_iter().map(|folder| folder.join(name)).collect()
}

/// The inputs of a run, to recognise files that have changed since.
pub(crate) struct KnownInputs(BTreeMap<String, String>);

impl KnownInputs {
    pub(crate) fn of(run: &RunRecord) -> Self {
        Self(run.inputs.all().map(|input| (input.path, input.sha256)).collect())
    }

    /// Whether an input has the bytes that were scored.
    pub(crate) fn is_same(&self, input: &Input) -> bool {
        self.0.get(&input.path).is_none_or(|sha256| *sha256 == input.sha256)
    }
}
