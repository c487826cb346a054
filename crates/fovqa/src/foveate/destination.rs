//! The files that emulated frames and their buffers are written to.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use fovqa_engine::FoundView;
use fovqa_frame::source::{Origin, Source};
use fovqa_io::{EncodeError, FrameFormat};
use fovqa_plan::Plan;

use super::{FoveateOutputs, inputs};
use crate::error::Error;

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Destination {
    pub(super) path: PathBuf,
    pub(super) format: FrameFormat,
    /// Whether the user gave the folder instead of the file.
    pub(super) is_in_folder: bool,
}

impl Destination {
    /// The file of one of several layers, counted from 1: the number stands before the ending. A
    /// single layer needs no number.
    pub(super) fn layer(&self, layer: usize, layers: usize) -> PathBuf {
        if layers == 1 {
            return self.path.clone();
        }
        let part = |part: Option<&OsStr>| part.unwrap_or_default().to_owned();
        let mut name: OsString = part(self.path.file_stem());
        name.push(format!("-{layer}."));
        name.push(part(self.path.extension()));
        self.path.with_file_name(name)
    }
}

/// The files for all frames of a view.
#[derive(Debug)]
pub(super) struct Destinations {
    /// By the index of the input in its source.
    frames: Vec<(usize, Destination)>,
    buffers: Option<Vec<(usize, Destination)>>,
}

impl Destinations {
    /// Decides where every frame is written. Nothing is created yet.
    pub(super) fn new(
        plan: &Plan,
        view: &FoundView,
        outputs: &FoveateOutputs,
    ) -> Result<Self, Error> {
        let source = &*view.sources.reference;
        let indices = || view.frames.iter().map(|frame| frame.reference);
        let all = |path: &Path| -> Result<Vec<(usize, Destination)>, Error> {
            let place = Place::new(path, source, view.frames.len())?;
            indices().map(|index| Ok((index, place.of(source, index)?))).collect()
        };
        let frames = all(&outputs.frames)?;
        let buffers = outputs.buffers.as_deref().map(all).transpose()?;
        let eye = &plan.scenes[view.scene].eyes[view.eye];
        let read = inputs::files(view, eye);
        let mut seen = BTreeSet::new();
        for (_, destination) in frames.iter().chain(buffers.iter().flatten()) {
            let path = &destination.path;
            if inputs::contains(&read, path) {
                let message = format!("{} is an input; it would be replaced", plan.shown(path));
                return Err(Error::usage(message, "give another output"));
            }
            if !seen.insert(path) {
                let message = format!("two outputs have the same name {}", plan.shown(path));
                return Err(Error::usage(message, "give each output a name of its own"));
            }
        }
        Ok(Self { frames, buffers })
    }

    /// The file for the frame of an input.
    pub(super) fn frame(&self, index: usize) -> &Destination {
        find(&self.frames, index)
    }

    /// The file for the buffer of an input, if buffers are written.
    pub(super) fn buffer(&self, index: usize) -> Option<&Destination> {
        self.buffers.as_ref().map(|buffers| find(buffers, index))
    }
}

/// The inputs are nearly always in the order of their indices.
fn find(destinations: &[(usize, Destination)], index: usize) -> &Destination {
    let at = destinations.binary_search_by_key(&index, |(index, _)| *index);
    let found = at.ok().or_else(|| destinations.iter().position(|(other, _)| *other == index));
    let Some(at) = found else { unreachable!("every frame has a destination") };
    &destinations[at].1
}

/// What the user gave as output.
enum Place {
    File(PathBuf, FrameFormat),
    Folder(PathBuf),
}

impl Place {
    fn new(path: &Path, source: &dyn Source, frames: usize) -> Result<Self, Error> {
        let listing = source.listing();
        let ends_like_folder =
            path.as_os_str().as_encoded_bytes().last() == Some(&(MAIN_SEPARATOR as u8));
        if path.is_dir() || ends_like_folder {
            return Ok(Self::Folder(path.to_owned()));
        }
        let format = FrameFormat::of_path(path);
        if frames == 1 {
            return match format {
                Ok(format) => Ok(Self::File(path.to_owned(), format)),
                // A folder with a single frame is still a folder.
                Err(EncodeError::UnknownEnding { .. }) if !listing.is_single => {
                    Ok(Self::Folder(path.to_owned()))
                }
                Err(error) => Err(Error::usage(error.to_string(), error.help())),
            };
        }
        match format {
            Err(EncodeError::UnknownEnding { .. }) if !path.is_file() => {
                Ok(Self::Folder(path.to_owned()))
            }
            Err(error @ EncodeError::Video { .. }) => {
                Err(Error::usage(error.to_string(), error.help()))
            }
            Ok(_) | Err(_) => {
                let message =
                    format!("{} is a file, but the input has {frames} frames", path.display());
                Err(Error::usage(message, "give a folder"))
            }
        }
    }

    fn of(&self, source: &dyn Source, index: usize) -> Result<Destination, Error> {
        match self {
            Self::File(path, format) => {
                Ok(Destination { path: path.clone(), format: *format, is_in_folder: false })
            }
            Self::Folder(folder) => {
                let name = name(source, index);
                let format = FrameFormat::of_path(Path::new(&name))
                    .map_err(|error| Error::usage(error.to_string(), error.help()))?;
                Ok(Destination { path: folder.join(name), format, is_in_folder: true })
            }
        }
    }
}

/// The name of an output in a folder: that of the input or, for a frame of a video, the name of the
/// video with the number of the frame.
fn name(source: &dyn Source, index: usize) -> OsString {
    let listing = source.listing();
    match listing.entries().get(index) {
        None => {
            let stem = Path::new(&listing.argument).file_stem().unwrap_or(OsStr::new("frame"));
            // A built-in scene has a colon in its name, which some systems do not allow in files.
            let mut name: OsString = stem.to_string_lossy().replace(':', "-").into();
            name.push(format!(".{index:06}.png"));
            name
        }
        Some(entry) => {
            let file = source.origins(index).into_iter().find_map(|(_, origin)| match origin {
                Origin::File(path) => path.file_name().map(OsStr::to_owned),
                Origin::Made(_) => None,
            });
            file.unwrap_or_else(|| {
                let mut name = entry.stem.clone();
                name.push(".png");
                name
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_numbered_before_the_ending() {
        let destination = Destination {
            path: "out/a.b.png".into(),
            format: FrameFormat::Png,
            is_in_folder: false,
        };
        assert_eq!(destination.layer(1, 1), Path::new("out/a.b.png"));
        assert_eq!(destination.layer(2, 3), Path::new("out/a.b-2.png"));
    }
}
