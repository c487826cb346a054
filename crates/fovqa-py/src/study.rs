//! Analyses the answers of viewers.

use std::path::PathBuf;

use fovqa::{Dialect, Locking};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::document::Document;
use crate::error::exception;
use crate::worker::work;

/// Carries out the analyses of a study file, or of a table with its keys, and writes them to a folder.
#[pyfunction]
#[pyo3(signature = (study, output, *, progress=None))]
pub(crate) fn study<'py>(
    py: Python<'py>,
    study: &Bound<'py, PyAny>,
    output: PathBuf,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let file = Document::of(study)?.study()?;
    let (finished, heard) = work(py, Dialect::Experiment, progress, move |events| {
        fovqa::study(&file, Some(&output), Locking::default(), events)
    })?;
    let finished = finished.map_err(|error| exception(&error, Dialect::Experiment))?;
    let result = PyDict::new(py);
    result.set_item("folder", &finished.folder)?;
    result.set_item("warnings", heard.warnings)?;
    result.set_item("notes", heard.notes)?;
    Ok(result)
}
