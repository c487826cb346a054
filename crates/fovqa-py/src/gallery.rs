//! The built-in scenes.

use std::path::PathBuf;
use std::sync::Arc;

use fovqa::{BuiltinSpec, Dialect, GalleryRequest, SceneName};
use fovqa_emulate::Picture;
use fovqa_frame::{SignalParams, SignalTables};
use fovqa_gallery::Builtin;
use fovqa_params::Words;
use fovqa_plan::SourceSpec;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array;
use crate::error::{exception, wrong_request};
use crate::score::plan_of;
use crate::worker::work;

/// A built-in scene for one eye. Its frames are drawn when they are asked for.
#[pyclass(frozen, module = "fovqa._native")]
pub(crate) struct Gallery {
    builtin: Arc<Builtin>,
    view: fovqa::ViewSpec,
    eye: Option<fovqa_plan::Eye>,
    ipd_m: f64,
}

#[pymethods]
impl Gallery {
    /// Prepares a scene. `document` has an experiment with one built-in scene, and `eye` is left, right or
    /// neither.
    #[new]
    #[pyo3(signature = (document, eye=None))]
    fn new(document: &Bound<'_, PyDict>, eye: Option<&str>) -> PyResult<Self> {
        let plan = plan_of(document)?;
        let scene = &plan.scenes[0];
        let eye = match eye {
            None => None,
            Some("left") => Some(fovqa_plan::Eye::Left),
            Some("right") => Some(fovqa_plan::Eye::Right),
            Some(other) => {
                let message = format!("eye cannot be {other:?}");
                return Err(wrong_request(
                    message,
                    "choose \"left\" or \"right\", or leave it out",
                ));
            }
        };
        let of_eye = scene.eyes.iter().find(|view| view.eye == eye).or(scene.eyes.first());
        let Some((view, SourceSpec::Builtin(frames))) = of_eye.map(|view| (view, &view.reference))
        else {
            return Err(wrong_request("the scene is not built in", "choose gallery or a pattern"));
        };
        let [width, height] = frames.size;
        let spec = match &view.settings.view {
            Some(spec) => spec.clone(),
            None if frames.spec.scene == SceneName::Gallery => {
                let message = Dialect::Arguments.spell("the gallery needs {view}");
                return Err(wrong_request(message, ""));
            }
            // Flat patterns and the chart are the same from anywhere.
            None => fovqa::ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(90.0) },
        };
        let resolved = spec.resolve(width, height);
        let resolved = resolved.map_err(|error| {
            wrong_request(error.to_string(), "give a view that fits frames of this size")
        })?;
        let builtin = Builtin::new(&frames.spec, resolved.view, frames.eye_m)
            .map_err(|error| wrong_request(error.to_string(), "give a number in this range"))?;
        Ok(Self { builtin: Arc::new(builtin), view: spec, eye, ipd_m: 2.0 * frames.eye_m.abs() })
    }

    /// The number of frames.
    fn __len__(&self) -> usize {
        self.spec().frames
    }

    /// Name of the scene, width and height in pixels, and frames per second.
    fn about(&self) -> (&'static str, usize, usize, f64) {
        let view = self.builtin.view();
        (self.spec().scene.word(), view.width, view.height, self.spec().fps)
    }

    /// The ground truth of a frame in linear light.
    fn image<'py>(&self, py: Python<'py>, frame: usize) -> PyResult<Bound<'py, PyAny>> {
        let builtin = Arc::clone(&self.builtin);
        let (light, _) = work(py, Dialect::Arguments, None, move |events| {
            builtin.ground_truth_watched(frame, &*events.step("drawing", 0))
        })?;
        array::of_frame(py, &light)
    }

    /// The ground truth of a frame as 8-bit codes.
    fn encoded<'py>(&self, py: Python<'py>, frame: usize) -> PyResult<Bound<'py, PyAny>> {
        let builtin = Arc::clone(&self.builtin);
        let (codes, _) = work(py, Dialect::Arguments, None, move |events| {
            let tables = SignalTables::new(SignalParams::default());
            let light = builtin.ground_truth_watched(frame, &*events.step("drawing", 0));
            Picture::from_frame(&light, &tables).to_codes8()
        })?;
        array::of_frame(py, &codes)
    }

    /// Motion (height x width x 2, pixels) and depth (height x width, metres) of a frame.
    fn guides<'py>(&self, py: Python<'py>, frame: usize) -> PyResult<array::GuideArrays<'py>> {
        let builtin = Arc::clone(&self.builtin);
        let (guides, _) = work(py, Dialect::Arguments, None, move |_| builtin.guides(frame))?;
        array::guide_arrays(py, &guides)
    }

    /// The gaze in a frame, in pixels.
    fn gaze(&self, frame: usize) -> [f64; 2] {
        self.builtin.gaze_px(frame)
    }

    /// Writes all frames as files, as `fovqa gallery` does.
    #[pyo3(signature = (folder, progress=None))]
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<usize> {
        let view = self.builtin.view();
        let request = GalleryRequest {
            eyes: self.eye.into_iter().collect(),
            ipd_m: self.ipd_m,
            ..GalleryRequest::new(self.spec().clone(), [view.width, view.height], self.view.clone())
        };
        let (written, _) = work(py, Dialect::Arguments, progress, move |events| {
            fovqa::write_gallery(&request, &folder, events)
        })?;
        written.map_err(|error| exception(&error, Dialect::Arguments))
    }
}

impl Gallery {
    fn spec(&self) -> &BuiltinSpec {
        self.builtin.spec()
    }
}
