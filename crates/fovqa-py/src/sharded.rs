//! Runs whose shards other processes score. A process finds the frames once for all of its shards.

use std::fs::{File, TryLockError, create_dir_all};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use fovqa::{Dialect, FoundView, Given, MergeOptions, Run, RunOptions};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::document::Document;
use crate::error::{exception, wrong_input};
use crate::run::{frames_of, locking, result_of, shard_of};
use crate::worker::work;

/// An experiment whose frames were found.
#[pyclass(frozen, module = "fovqa._native")]
pub(crate) struct Sharded {
    run: Arc<Run>,
}

#[pymethods]
impl Sharded {
    /// Finds the frames of an experiment: of a path, of a table, or of the text of the file at a path.
    #[new]
    #[pyo3(signature = (experiment, text=None, *, frames=None, maps=None, lock=true))]
    fn new(
        py: Python<'_>,
        experiment: &Bound<'_, PyAny>,
        text: Option<String>,
        frames: Option<&str>,
        maps: Option<PathBuf>,
        lock: bool,
    ) -> PyResult<Self> {
        let experiment = document(experiment, text)?.experiment()?;
        let (frames, locking) = (frames_of(frames)?, locking(lock));
        let options = RunOptions { frames, maps, locking, ..RunOptions::default() };
        let (found, _) = work(py, Dialect::Experiment, None, move |_| {
            Run::new(experiment, options, &Given::default())
        })?;
        let run = found.map_err(|error| exception(&error, Dialect::Experiment))?;
        Ok(Self { run: Arc::new(run) })
    }

    /// Checks what would only be noticed after scoring. Returns warnings.
    fn foresee(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let run = Arc::clone(&self.run);
        let (foreseen, heard) =
            work(py, Dialect::Experiment, None, move |events| run.foresee(events))?;
        foreseen.map_err(|error| exception(&error, Dialect::Experiment))?;
        Ok(heard.warnings)
    }

    /// The path of the experiment file.
    #[getter]
    fn path(&self) -> PathBuf {
        self.run.experiment().path.clone()
    }

    /// Its text.
    #[getter]
    fn text(&self) -> String {
        self.run.experiment().text.clone()
    }

    /// The name of the experiment.
    #[getter]
    fn name(&self) -> String {
        self.run.experiment().name.clone()
    }

    /// Number of frames of all scenes, with each eye counted on its own.
    #[getter]
    fn frames(&self) -> usize {
        self.run.found().views.iter().map(|view| view.frames.len()).sum()
    }

    /// Number of pairs of images.
    #[getter]
    fn pairs(&self) -> usize {
        self.run.found().views.iter().map(FoundView::pairs).sum()
    }

    /// Whether frames before a shard are read again.
    #[getter]
    fn reads_frames_before(&self) -> bool {
        self.run.reads_frames_before()
    }

    /// A hash of what all shards have in common.
    #[getter]
    fn fingerprint(&self, py: Python<'_>) -> String {
        py.detach(|| self.run.fingerprint())
    }

    /// Scores a shard into a folder, or continues with it.
    #[pyo3(signature = (shard, folder, *, resume=true))]
    fn score<'py>(
        &self,
        py: Python<'py>,
        shard: &str,
        folder: PathBuf,
        resume: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let Some(shard) = shard_of(Some(shard))? else { unreachable!("a shard was given") };
        let run = Arc::clone(&self.run);
        let (finished, heard) = work(py, Dialect::Experiment, None, move |events| {
            run.score_shard(shard, &folder, resume, events)
        })?;
        result_of(py, finished, heard)
    }
}

fn document(experiment: &Bound<'_, PyAny>, text: Option<String>) -> PyResult<Document> {
    match text {
        Some(text) => Ok(Document::of_text(experiment.extract()?, text)),
        None => Document::of(experiment),
    }
}

/// Merges the shards of an experiment, whose text is given, into its results.
#[pyfunction]
#[pyo3(signature = (path, text, shards, output, *, lock=true, progress=None))]
pub(crate) fn merge<'py>(
    py: Python<'py>,
    path: &Bound<'py, PyAny>,
    text: String,
    shards: Vec<PathBuf>,
    output: PathBuf,
    lock: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = document(path, Some(text))?.experiment()?;
    let options =
        MergeOptions { locking: locking(lock), values: true, experiment: Some(experiment) };
    let (finished, heard) = work(py, Dialect::Experiment, progress, move |events| {
        fovqa::merge(&shards, &output, options, events)
    })?;
    result_of(py, finished, heard)
}

/// A folder to which only one process writes.
#[pyclass(frozen, module = "fovqa._native")]
pub(crate) struct Lock(Mutex<Option<File>>);

#[pymethods]
impl Lock {
    /// Creates the folder and locks it.
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "Python gives it away")]
    fn new(folder: PathBuf) -> PyResult<Self> {
        let wrong = |error: String| {
            wrong_input(format!("{}: {error}", folder.display()), "give another folder as output")
        };
        let open = || {
            create_dir_all(&folder)?;
            File::options().create(true).append(true).open(folder.join(".lock"))
        };
        let file =
            open().map_err(|error| wrong(format!("cannot write to this folder: {error}")))?;
        match file.try_lock() {
            Ok(()) => Ok(Self(Mutex::new(Some(file)))),
            Err(TryLockError::WouldBlock) => {
                Err(wrong("another run is writing to this folder".to_owned()))
            }
            Err(TryLockError::Error(error)) => Err(wrong_input(
                format!("{}: cannot lock this folder: {error}", folder.display()),
                "give lock=False, and make sure that nothing else writes to the folder",
            )),
        }
    }

    /// Lets other processes write to the folder.
    fn release(&self) {
        // The lock ends when the file is closed.
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
    }
}
