//! Runs an experiment.

use std::path::PathBuf;

use fovqa::{Dialect, Given, Locking, Run, RunOptions};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::document::Document;
use crate::error::{exception, wrong_request};
use crate::worker::work;

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
    let wrong = |what: &str, error: String| wrong_request(format!("{what}: {error}"), "");
    let shard = shard.map(str::parse).transpose();
    let shard = shard.map_err(|error: <fovqa::Shard as std::str::FromStr>::Err| {
        wrong("shard", error.to_string())
    })?;
    let frames = frames.map(str::parse).transpose();
    let frames =
        frames.map_err(|error: <fovqa_io::sequence::FrameRange as std::str::FromStr>::Err| {
            wrong("frames", error.to_string())
        })?;
    let locking = if lock { Locking::default() } else { Locking::Unlocked };
    let options = RunOptions { output, resume, shard, frames, maps, locking };
    let (finished, heard) = work(py, Dialect::Experiment, progress, move |events| {
        Run::new(experiment, options, &Given::default()).and_then(|run| run.start(events))
    })?;
    let finished = finished.map_err(|error| exception(&error, Dialect::Experiment))?;
    let result = PyDict::new(py);
    result.set_item("folder", &finished.folder)?;
    result.set_item("scored", finished.scored)?;
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
