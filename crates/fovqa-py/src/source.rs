//! What Python gives as frames: a path, an array, or a sequence of these.

use std::path::PathBuf;
use std::sync::Arc;

use fovqa::{ReadOptions, SourceOptions, open_source};
use fovqa_frame::source::{
    Entry, Frames, Length, Listing, Numbering, Origin, Picture, PictureGuides, Source, SourceError,
};
use fovqa_frame::{Frame, Guides};
use numpy::PyUntypedArrayMethods;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyList, PyMapping, PyTuple};

use crate::array;
use crate::document::working_folder;
use crate::error::{wrong_input, wrong_request};
use crate::fetch::fetch;

/// Maximum number of frames of a sequence: two days at 60 per second.
const MOST_FRAMES: usize = 10_000_000;

/// Frames as they were given.
pub(crate) enum GivenFrames {
    /// A file, a folder, a glob, a pattern or a video.
    Path(PathBuf),
    /// Frames in memory, or read by Python.
    Source(Box<PythonFrames>),
}

/// A frame of a sequence.
#[derive(Debug)]
enum Item {
    /// An array.
    Frame(Frame),
    /// A file.
    File(PathBuf),
}

#[derive(Debug)]
enum Items {
    /// All frames are known.
    Known(Vec<Item>),
    /// The frames are fetched from Python when they are needed, such as those of a data set.
    Fetched { sequence: Py<PyAny>, size: (usize, usize), bytes_per_pixel: u64 },
}

/// Frames from Python.
#[derive(Debug)]
pub(crate) struct PythonFrames {
    name: &'static str,
    listing: Listing,
    items: Items,
    read: ReadOptions,
    motion: Option<Py<PyAny>>,
    depth: Option<Py<PyAny>>,
}

impl GivenFrames {
    /// Takes a value as frames. `name` is that of the argument.
    pub(crate) fn of(
        name: &'static str,
        value: &Bound<'_, PyAny>,
        read: &ReadOptions,
    ) -> PyResult<Self> {
        if let Some(path) = path(value) {
            return Ok(Self::Path(path));
        }
        PythonFrames::of(name, value, read).map(|frames| Self::Source(Box::new(frames)))
    }
}

/// The path that a value is, if it is one.
fn path(value: &Bound<'_, PyAny>) -> Option<PathBuf> {
    let is_path = value.is_instance_of::<pyo3::types::PyString>()
        || value.hasattr("__fspath__").unwrap_or(false);
    if is_path { value.extract().ok() } else { None }
}

impl PythonFrames {
    fn of(name: &'static str, value: &Bound<'_, PyAny>, read: &ReadOptions) -> PyResult<Self> {
        let most = read.max_megapixels;
        let new = |listing, items| Self {
            name,
            listing,
            items,
            read: read.clone(),
            motion: None,
            depth: None,
        };
        let is_list = value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>();
        if !is_list && array::is_like_array(value) {
            let array = array::array_of(name, value)?;
            if array.ndim() != 4 {
                let frame = array::frame(name, &array, most)?;
                return Ok(new(single(name), Items::Known(vec![Item::Frame(frame)])));
            }
            not_empty(name, array.shape()[0])?;
            let frames = (0..array.shape()[0]).map(|nth| array.get_item(nth));
            let frames = frames.collect::<PyResult<Vec<_>>>()?;
            return Ok(new(counted(name, frames.len()), Items::Known(items(name, frames, most)?)));
        }
        let is_bytes = value.is_instance_of::<PyBytes>() || value.is_instance_of::<PyByteArray>();
        let is_sequence = !is_bytes
            && value.cast::<PyMapping>().is_err()
            && ["__len__", "__getitem__"].iter().all(|m| value.hasattr(*m).unwrap_or(false));
        if !is_sequence {
            // It is no array: the error says what is possible.
            array::array_of(name, value)?;
        }
        let length = value.len()?;
        not_empty(name, length)?;
        if is_list {
            let frames = value.try_iter()?.collect::<PyResult<Vec<_>>>()?;
            return Ok(new(counted(name, length), Items::Known(items(name, frames, most)?)));
        }
        let first = value.get_item(0)?;
        if path(&first).is_some() {
            let frames = (0..length).map(|nth| value.get_item(nth));
            let frames = frames.collect::<PyResult<Vec<_>>>()?;
            return Ok(new(counted(name, length), Items::Known(items(name, frames, most)?)));
        }
        let frame = array::frame(name, &first, most)?;
        let size = (frame.width(), frame.height());
        let bytes_per_pixel = bytes_per_pixel(&frame);
        let sequence = value.clone().unbind();
        Ok(new(counted(name, length), Items::Fetched { sequence, size, bytes_per_pixel }))
    }

    /// A single frame.
    pub(crate) fn of_frame(name: &'static str, frame: Frame) -> Self {
        Self {
            name,
            listing: single(name),
            items: Items::Known(vec![Item::Frame(frame)]),
            read: ReadOptions::default(),
            motion: None,
            depth: None,
        }
    }

    /// The same frames with motion and depth, as sequences of arrays.
    pub(crate) fn with_guides(
        self,
        motion: Option<&Bound<'_, PyAny>>,
        depth: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let frames = self.length();
        for (what, given) in [("motion", motion), ("depth", depth)] {
            let Some(given) = given else { continue };
            let found = given.len()?;
            if found != frames {
                return Err(wrong_input(
                    format!("there are {found} arrays of {what} for {frames} frames"),
                    "give one for each frame of the reference",
                ));
            }
        }
        let kept = |given: Option<&Bound<'_, PyAny>>| given.map(|given| given.clone().unbind());
        Ok(Self { motion: kept(motion), depth: kept(depth), ..self })
    }

    fn length(&self) -> usize {
        match self.listing.length() {
            Some(Length::Whole(frames)) => frames,
            _ => self.listing.entries().len(),
        }
    }

    fn frame(&self, nth: usize, guides: bool) -> Result<Picture, SourceError> {
        match &self.items {
            Items::Known(items) => match &items[nth] {
                Item::Frame(frame) => Ok(picture_of(frame.clone())),
                Item::File(path) => self.file(path)?.read(0, guides),
            },
            Items::Fetched { sequence, .. } => {
                let (name, most) = (self.name, self.read.max_megapixels);
                self.fetched(nth, |py| array::frame(name, &sequence.bind(py).get_item(nth)?, most))
                    .map(picture_of)
            }
        }
    }

    /// What code of the user gives for a frame.
    fn fetched<T: Send>(
        &self,
        nth: usize,
        code: impl FnOnce(Python<'_>) -> PyResult<T> + Send,
    ) -> Result<T, SourceError> {
        fetch(code).map_err(|message| {
            let message = format!("{}: {message}", self.listing.label(nth));
            SourceError::new(message, "see the sequence that was given")
        })
    }

    /// A file of a sequence.
    fn file(&self, path: &std::path::Path) -> Result<Arc<dyn Source>, SourceError> {
        let options =
            SourceOptions { base: working_folder(), read: self.read.clone(), hash: false };
        open_source(path, options)
            .map_err(|error| SourceError::new(error.to_string(), "give the path of a frame"))
    }
}

/// Refuses arrays of motion and depth for frames that are files.
pub(crate) fn no_guides(
    motion: Option<&Bound<'_, PyAny>>,
    depth: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    if motion.is_none() && depth.is_none() {
        return Ok(());
    }
    Err(wrong_request(
        "arrays of motion and depth belong to frames that are arrays, but a path is given",
        "read the frames with fovqa.read, or say which channels or files have motion and depth",
    ))
}

fn not_empty(name: &str, frames: usize) -> PyResult<()> {
    match frames {
        0 => Err(wrong_input(format!("the {name} has no frames"), "give at least one frame")),
        1..=MOST_FRAMES => Ok(()),
        _ => Err(wrong_input(
            format!("the {name} says that it has {frames} frames, more than {MOST_FRAMES}"),
            "check its length, or score it in parts",
        )),
    }
}

/// The picture of an array. Floats that look like codes are noted.
fn picture_of(frame: Frame) -> Picture {
    /// Number of pixels that are looked at.
    const LOOKED_AT: usize = 4096;
    let (width, height) = (frame.width(), frame.height());
    let mut picture = Picture::new(frame);
    let frame = &picture.frame;
    if frame.samples().is_integer() {
        return picture;
    }
    let pixels = width * height;
    let mut most = 0.0f32;
    for at in (0..pixels).step_by(pixels.div_ceil(LOOKED_AT)) {
        let value = frame.sample(0, at % width, at / width);
        if value < 0.0 || value.fract() != 0.0 {
            return picture;
        }
        most = most.max(value);
    }
    // Whole numbers beyond white are hardly light.
    if most > 1.0 && most <= 65535.0 {
        picture.notes.push(format!(
            "its floats are whole numbers, up to {most} or more, like codes of a display, but floats are \
             linear light; convert them to uint8 or uint16"
        ));
    }
    picture
}

/// The items of a list.
fn items(name: &'static str, frames: Vec<Bound<'_, PyAny>>, most: u64) -> PyResult<Vec<Item>> {
    let item = |value: Bound<'_, PyAny>| match path(&value) {
        Some(path) => Ok(Item::File(path)),
        None => array::frame(name, &value, most).map(Item::Frame),
    };
    frames.into_iter().map(item).collect()
}

fn single(name: &str) -> Listing {
    let entry = Entry { name: name.into(), stem: name.into(), number: None };
    Listing {
        argument: name.to_owned(),
        is_single: true,
        frames: Frames::Named(vec![entry]),
        numbering: Numbering::ByPosition,
    }
}

fn counted(name: &str, length: usize) -> Listing {
    Listing::counted(name.to_owned(), Length::Whole(length))
}

fn bytes_per_pixel(frame: &Frame) -> u64 {
    frame.bytes() as u64 / (frame.width() * frame.height()).max(1) as u64
}

impl Source for PythonFrames {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, frame: usize) -> Result<(usize, usize), SourceError> {
        match &self.items {
            Items::Known(items) => match &items[frame] {
                Item::Frame(frame) => Ok((frame.width(), frame.height())),
                Item::File(path) => self.file(path)?.size(0),
            },
            Items::Fetched { size, .. } => Ok(*size),
        }
    }

    fn bytes_per_pixel(&self) -> u64 {
        match &self.items {
            Items::Known(items) => match items.first() {
                Some(Item::Frame(frame)) => bytes_per_pixel(frame),
                Some(Item::File(path)) => {
                    self.file(path).map_or(3, |source| source.bytes_per_pixel())
                }
                None => 3,
            },
            Items::Fetched { bytes_per_pixel, .. } => *bytes_per_pixel,
        }
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        let mut picture = self.frame(frame, guides)?;
        if guides && (self.motion.is_some() || self.depth.is_some()) {
            picture.guides = self.fetched(frame, |py| {
                let at = |given: &Py<PyAny>| given.bind(py).get_item(frame);
                let motion = self.motion.as_ref().map(|given| array::motion(&at(given)?));
                let depth = self.depth.as_ref().map(|given| array::depth(&at(given)?));
                Ok(Guides { motion: motion.transpose()?, depth: depth.transpose()? })
            })?;
            let size = (picture.frame.width(), picture.frame.height());
            let motion =
                picture.guides.motion.as_ref().map(|motion| (motion.width(), motion.height()));
            let depth = picture.guides.depth.as_ref().map(|depth| (depth.width(), depth.height()));
            for (what, found) in [("motion", motion), ("depth", depth)] {
                if let Some(found) = found.filter(|found| *found != size) {
                    let message = format!(
                        "{} has {}x{} pixels, but its {what} has {}x{}",
                        self.listing.label(frame),
                        size.0,
                        size.1,
                        found.0,
                        found.1
                    );
                    return Err(SourceError::new(message, "give arrays of the frame's size"));
                }
            }
        }
        Ok(picture)
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        let message = format!("{}: it has neither motion nor depth", self.listing.argument);
        Err(SourceError::new(message, "give motion and depth"))
    }

    fn origins(&self, frame: usize) -> Vec<(String, Origin)> {
        match &self.items {
            Items::Known(items) => match &items[frame] {
                Item::Frame(_) => Vec::new(),
                Item::File(path) => vec![(path.display().to_string(), Origin::File(path.clone()))],
            },
            Items::Fetched { .. } => Vec::new(),
        }
    }
}
