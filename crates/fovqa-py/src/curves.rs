//! Computes curves of shading rates, and draws them.

use std::path::PathBuf;

use fovqa::{Dialect, Locking};
use fovqa_report::Text;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::document::Document;
use crate::error::exception;
use crate::worker::work;

/// Writes the values, figures and tables of a curves file, or of a table with its keys, to a folder.
#[pyfunction]
#[pyo3(signature = (curves, output, *, progress=None))]
pub(crate) fn curves<'py>(
    py: Python<'py>,
    curves: &Bound<'py, PyAny>,
    output: PathBuf,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let file = Document::of(curves)?.curves()?;
    let (drawn, heard) = work(py, Dialect::Experiment, progress, move |events| {
        fovqa::curves(&file, Some(&output), Locking::default(), events)
    })?;
    let (folder, drawn) = drawn.map_err(|error| exception(&error, Dialect::Experiment))?;
    let result = PyDict::new(py);
    result.set_item("folder", folder)?;
    let text = |table| {
        let mut text = Text::default();
        text.push_table(table);
        text.to_string()
    };
    let tables: Vec<String> = drawn.tables.into_iter().map(text).collect();
    result.set_item("tables", tables)?;
    result.set_item("warnings", heard.warnings)?;
    result.set_item("notes", heard.notes)?;
    Ok(result)
}
