//! Runs an experiment.

use std::path::PathBuf;
use std::str::FromStr;

use fovqa::{Dialect, Error, Finished, Given, Locking, Run, RunOptions, Shard};
use fovqa_io::sequence::FrameRange;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::document::Document;
use crate::error::{exception, wrong_request};
use crate::worker::{Heard, work};

/// Runs an experiment: the path of a file, or a table with its keys.
#[pyfunction]
#[pyo3(signature = (experiment, *, output=None, resume=false, shard=None, frames=None, maps=None, lock=true, progress=None))]
#[allow(clippy::too_many_arguments, reason = "Python calls it with keywords")]
pub(crate) fn run<'py>(
    py: Python<'py>,
    experiment: &Bound<'py, PyAny>,
    output: Option<PathBuf>,
    resume: bool,
    shard: Option<&str>,
    frames: Option<&str>,
    maps: Option<PathBuf>,
    lock: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = Document::of(experiment)?.experiment()?;
    let (shard, frames) = (shard_of(shard)?, frames_of(frames)?);
    let locking = locking(lock);
    let options = RunOptions { output, resume, shard, frames, maps, locking };
    let (finished, heard) = work(py, Dialect::Experiment, progress, move |events| {
        Run::new(experiment, options, &Given::default()).and_then(|run| run.start(events))
    })?;
    result_of(py, finished, heard)
}

/// A shard, as the package gives it.
pub(crate) fn shard_of(shard: Option<&str>) -> PyResult<Option<Shard>> {
    let shard = shard.map(str::parse).transpose();
    shard.map_err(|error: <Shard as FromStr>::Err| wrong_request(format!("shard: {error}"), ""))
}

/// The selected frames, as the package gives them.
pub(crate) fn frames_of(frames: Option<&str>) -> PyResult<Option<FrameRange>> {
    let frames = frames.map(str::parse).transpose();
    frames.map_err(|error: <FrameRange as FromStr>::Err| {
        wrong_request(format!("frames: {error}"), "")
    })
}

pub(crate) fn locking(lock: bool) -> Locking {
    if lock { Locking::Locked } else { Locking::Unlocked }
}

/// A finished run, as the package gets it.
pub(crate) fn result_of(
    py: Python<'_>,
    finished: Result<Finished, Error>,
    heard: Heard,
) -> PyResult<Bound<'_, PyDict>> {
    let finished = finished.map_err(|error| exception(&error, Dialect::Experiment))?;
    let result = PyDict::new(py);
    result.set_item("folder", &finished.folder)?;
    result.set_item("scored", finished.scored)?;
    result.set_item("known", finished.known)?;
    result.set_item("errors", finished.errors)?;
    let drawn = finished.drawn.as_ref();
    let table = drawn.and_then(|drawn| drawn.table.as_ref());
    result.set_item("table", table.map(|table| table.terminal().to_string()))?;
    let warnings = drawn.map(|drawn| drawn.warnings.clone()).unwrap_or_default();
    let warnings: Vec<String> = heard.warnings.into_iter().chain(warnings).collect();
    result.set_item("warnings", warnings)?;
    result.set_item("failures", heard.failures)?;
    Ok(result)
}
