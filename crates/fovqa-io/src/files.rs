//! Files on disk as a source of frames, with one file per frame.

use std::path::{Path, PathBuf};

use fovqa_frame::source::{
    InputId, Listing, MissingGuides, Origin, Picture, PictureGuides, Source, SourceError,
};

use crate::decode::{frame_size, read_frame, read_frame_and_hash};
use crate::error::ReadError;
use crate::guides::{DepthChannels, GuideOptions, GuideSearch, MotionChannels};
use crate::note::Note;
use crate::read_guides::{read_guides, read_guides_and_hash};
use crate::read_options::ReadOptions;
use crate::sequence::{FileListing, shown};

/// Options for reading a source of files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SourceOptions {
    /// The folder to which the paths in results are relative.
    pub base: PathBuf,
    /// Options for reading each file.
    pub read: ReadOptions,
    /// Whether size and hash of every file are computed.
    pub hash: bool,
}

/// A source of files on disk.
#[derive(Debug)]
pub(crate) struct Files {
    listing: Listing,
    paths: Vec<PathBuf>,
    options: SourceOptions,
}

impl Files {
    pub(crate) fn new(files: &FileListing, options: SourceOptions) -> Self {
        let listing = files.listing(&options.base);
        let paths = files.files.iter().map(|file| file.path.clone()).collect();
        Self { listing, paths, options }
    }

    fn path(&self, frame: usize) -> Result<&Path, SourceError> {
        self.paths.get(frame).map(PathBuf::as_path).ok_or_else(|| SourceError {
            has_ended: true,
            ..SourceError::new(
                format!("{}: it has no frame {frame}", self.listing.argument),
                "check which frames are requested",
            )
        })
    }

    /// The error with the file's name as results show it.
    fn error(&self, error: ReadError) -> SourceError {
        let path = PathBuf::from(shown(&self.options.base, &error.path));
        SourceError::from(ReadError { path, ..error })
    }

    fn inputs(&self, path: &Path, id: Option<InputId>) -> Vec<(String, InputId)> {
        id.map(|id| (shown(&self.options.base, path), id)).into_iter().collect()
    }
}

impl From<ReadError> for SourceError {
    fn from(error: ReadError) -> Self {
        Self::new(error.to_string(), error.kind.help())
    }
}

impl Source for Files {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, frame: usize) -> Result<(usize, usize), SourceError> {
        frame_size(self.path(frame)?).map_err(|error| self.error(error))
    }

    fn bytes_per_pixel(&self) -> u64 {
        let is_exr = |path: &PathBuf| {
            path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"))
        };
        if self.paths.first().is_some_and(is_exr) { 6 } else { 3 }
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        let path = self.path(frame)?;
        let none = GuideOptions::default();
        let wanted = if guides { &self.options.read.guides } else { &none };
        let read = ReadOptions { guides: wanted.clone(), ..self.options.read.clone() };
        let (decoded, id) = if self.options.hash {
            let (decoded, id) =
                read_frame_and_hash(path, &read).map_err(|error| self.error(error))?;
            (decoded, Some(id))
        } else {
            (read_frame(path, &read).map_err(|error| self.error(error))?, None)
        };
        Ok(Picture {
            missing: self.missing(path, &read.guides, &decoded.guide_search),
            frame: decoded.frame,
            guides: decoded.guides,
            notes: decoded.notes.iter().map(Note::in_words).collect(),
            inputs: self.inputs(path, id),
            pixel_aspect: decoded.pixel_aspect,
        })
    }

    fn read_guides(&self, frame: usize) -> Result<PictureGuides, SourceError> {
        let path = self.path(frame)?;
        let (decoded, id) = if self.options.hash {
            let (decoded, id) = read_guides_and_hash(path, &self.options.read)
                .map_err(|error| self.error(error))?;
            (decoded, Some(id))
        } else {
            (read_guides(path, &self.options.read).map_err(|error| self.error(error))?, None)
        };
        Ok(PictureGuides {
            guides: decoded.guides,
            notes: decoded.notes.iter().map(Note::in_words).collect(),
            inputs: self.inputs(path, id),
        })
    }

    fn origins(&self, frame: usize) -> Vec<(String, Origin)> {
        let path = self.paths.get(frame);
        path.map(|path| (shown(&self.options.base, path), Origin::File(path.clone())))
            .into_iter()
            .collect()
    }
}

impl Files {
    /// The channels that the user has named but a file does not have. Channels that are looked for
    /// automatically may be missing.
    fn missing(&self, path: &Path, wanted: &GuideOptions, search: &GuideSearch) -> MissingGuides {
        let named_motion = !matches!(wanted.motion, MotionChannels::None | MotionChannels::Auto);
        let named_depth = !matches!(wanted.depth, DepthChannels::None | DepthChannels::Auto);
        let error = |kind| self.error(ReadError { path: path.to_owned(), kind });
        MissingGuides {
            motion: search.missing_motion().filter(|_| named_motion).map(error),
            depth: search.missing_depth().filter(|_| named_depth).map(error),
        }
    }
}
