//! Shows what a foveation method would have shown of frames.

use fovqa::{Dialect, Given, MetricChoice, ReadOptions};
use fovqa_plan::Gaze;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array;
use crate::error::{exception, wrong_input};
use crate::score::{add, all_failed, failure, plan_of};
use crate::source::{GivenFrames, no_guides};
use crate::worker::{AtWork, work};

/// Emulates a method on frames. `document` has the keys of an experiment with one scene and one method that is
/// emulated.
#[pyfunction]
#[pyo3(signature = (document, images, *, motion=None, gaze=None, buffers=false, progress=None))]
pub(crate) fn foveate<'py>(
    py: Python<'py>,
    document: &Bound<'py, PyDict>,
    images: &Bound<'py, PyAny>,
    motion: Option<&Bound<'py, PyAny>>,
    gaze: Option<Vec<[f64; 2]>>,
    buffers: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    const NAME: &str = "input";
    let _calling = AtWork::new();
    let mut plan = plan_of(document)?;
    plan.metrics = MetricChoice::Named(Vec::new());
    let mut given = Given::new();
    let eye = &mut plan.scenes[0].eyes[0];
    let guides = eye.settings.guides.clone();
    let read = ReadOptions { guides, ..eye.settings.read.clone() };
    eye.reference = match GivenFrames::of(NAME, images, &read)? {
        GivenFrames::Source(frames) => add(&mut given, NAME, frames.with_guides(motion, None)?),
        GivenFrames::Path(path) => {
            no_guides(motion, None)?;
            path.into()
        }
    };
    if let Some(points) = gaze {
        eye.settings.gaze = match points.as_slice() {
            [point] => Gaze::Point(*point),
            _ => Gaze::Each(points),
        };
    }
    let (foveated, heard) = work(py, Dialect::Arguments, progress, move |events| {
        let mut frames = Vec::new();
        let foveated = fovqa::foveate_frames(&plan, &given, buffers, events, &mut |frame| {
            frames.push(frame);
        });
        foveated.map(|foveated| (foveated, frames))
    })?;
    let (foveated, frames) = foveated.map_err(|error| exception(&error, Dialect::Arguments))?;
    all_failed(frames.len(), &foveated.failures)?;
    let mut json = Vec::new();
    foveated.record.write_json(&mut json).map_err(|error| wrong_input(error.to_string(), ""))?;
    let result = PyDict::new(py);
    result.set_item("json", String::from_utf8_lossy(&json))?;
    result.set_item("text", fovqa_report::foveate_text(&foveated.record).to_string())?;
    result.set_item("warnings", heard.warnings)?;
    result.set_item("failures", foveated.failures.iter().map(failure).collect::<Vec<_>>())?;
    let of_frame = |shown: &fovqa::ShownFrame| -> PyResult<_> {
        let buffers = shown.buffers.iter().map(|buffer| array::of_frame(py, buffer));
        let buffers = buffers.collect::<PyResult<Vec<_>>>()?;
        Ok((shown.number, array::of_frame(py, &shown.frame)?, buffers))
    };
    result.set_item("frames", frames.iter().map(of_frame).collect::<PyResult<Vec<_>>>()?)?;
    Ok(result)
}
