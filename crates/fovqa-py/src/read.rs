//! Reads frames from files.

use std::path::PathBuf;

use fovqa::{SourceOptions, open_source};
use fovqa_frame::source::Length;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array;
use crate::document::{Document, working_folder};
use crate::error::wrong_input;
use crate::worker::work;

/// Reads a frame of a file, a folder, a pattern or a video. `document` has an experiment with the keys that say
/// how. Returns the frame as an array, its motion and depth, and notes about the file.
#[pyfunction]
#[pyo3(signature = (document, path, *, frame=None, guides=false))]
pub(crate) fn read<'py>(
    py: Python<'py>,
    document: &Bound<'py, PyDict>,
    path: PathBuf,
    frame: Option<i64>,
    guides: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = Document::arguments(document)?.experiment()?;
    let settings = experiment.plan.scenes[0].eyes[0].settings.clone();
    let mut read = settings.read;
    read.guides = settings.guides;
    let (picture, _) = work(py, fovqa::Dialect::Arguments, None, move |_| {
        let options = SourceOptions { base: working_folder(), read, hash: false };
        let wrong = |message: String, help: String| (message, help);
        let source = open_source(&path, options).map_err(|error| {
            wrong(
                error.to_string(),
                "give a file, a folder, a glob, a pattern or a y4m video".to_owned(),
            )
        })?;
        let listing = source.listing();
        let frames = match listing.length() {
            None => listing.entries().len(),
            Some(Length::Whole(frames) | Length::Damaged(frames)) => frames,
            Some(Length::Open) => usize::MAX,
        };
        let given = frame.map(usize::try_from);
        let nth = match frame {
            Some(_) if matches!(given, Some(Ok(nth)) if nth < frames) => {
                given.and_then(Result::ok).unwrap_or_default()
            }
            None if frames == 1 => 0,
            Some(nth) => {
                return Err(wrong(
                    format!("{}: there is no frame {nth}, only {frames}", listing.argument),
                    "frames are counted from 0".to_owned(),
                ));
            }
            None => {
                return Err(wrong(
                    format!("{}: there are {frames} frames", listing.argument),
                    "choose one with frame=0, 1, …".to_owned(),
                ));
            }
        };
        source.read(nth, guides).map_err(|error| wrong(error.message, error.help))
    })?;
    let spell = |text: &str| fovqa::Dialect::Arguments.spell(text);
    let picture = picture.map_err(|(message, help)| wrong_input(spell(&message), spell(&help)))?;
    let picture = match settings.crop {
        None => picture,
        Some(crop) => {
            let wrong = |error: fovqa_frame::CropError| {
                wrong_input(error.to_string(), "crop is in pixels of the file")
            };
            let frame = picture.frame.cropped(crop).map_err(wrong)?;
            let guides = picture.guides.cropped(crop).map_err(wrong)?;
            fovqa_frame::source::Picture { frame, guides, ..picture }
        }
    };
    let result = PyDict::new(py);
    result.set_item("image", array::of_frame(py, &picture.frame)?)?;
    let (motion, depth) = array::guide_arrays(py, &picture.guides)?;
    result.set_item("motion", motion)?;
    result.set_item("depth", depth)?;
    let notes: Vec<String> = picture.notes.iter().map(|note| spell(note)).collect();
    result.set_item("notes", notes)?;
    Ok(result)
}
