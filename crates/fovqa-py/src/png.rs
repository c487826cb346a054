//! Frames as pictures of 8-bit codes.

use fovqa::{Dialect, ReadOptions, SignalParams};
use fovqa_emulate::Picture;
use fovqa_frame::SignalTables;
use fovqa_io::{FrameFormat, encode_frame};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::array;
use crate::document::Document;
use crate::error::wrong_input;
use crate::worker::work;

/// An array as PNG. `document` has an experiment whose signal says how values become codes.
#[pyfunction]
#[pyo3(signature = (image, document=None))]
pub(crate) fn png<'py>(
    py: Python<'py>,
    image: &Bound<'py, PyAny>,
    document: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let signal = match document {
        None => SignalParams::default(),
        Some(document) => {
            Document::arguments(document)?.experiment()?.plan.scenes[0].eyes[0].settings.signal
        }
    };
    let frame = array::frame("image", image, ReadOptions::default().max_megapixels)?;
    let (bytes, _) = work(py, Dialect::Arguments, None, move |_| {
        let codes = Picture::from_frame(&frame, &SignalTables::new(signal)).to_codes8();
        encode_frame(&codes, FrameFormat::Png).map_err(|error| error.to_string())
    })?;
    let bytes = bytes.map_err(|error| wrong_input(error, "give a smaller frame"))?;
    Ok(PyBytes::new(py, &bytes))
}
