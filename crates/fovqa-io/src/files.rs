//! Files on disk as a source of frames, with one file per frame.

use std::collections::BTreeMap;
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
    /// The paths of the files that cannot be found by their names in the listing. Keeping every path would
    /// double the memory of a long sequence.
    paths: BTreeMap<usize, PathBuf>,
    options: SourceOptions,
}

impl Files {
    pub(crate) fn new(files: &FileListing, options: SourceOptions) -> Self {
        let listing = files.listing(&options.base);
        let paths = files.files.iter().enumerate().filter_map(|(frame, file)| {
            let is_named = options.base.join(listing.name(frame)) == file.path;
            (!is_named).then(|| (frame, file.path.clone()))
        });
        Self { paths: paths.collect(), listing, options }
    }

    /// The file of a frame; `None` if there is no such frame.
    fn known_path(&self, frame: usize) -> Option<PathBuf> {
        let entry = self.listing.entries().get(frame)?;
        let path = self.paths.get(&frame).cloned();
        Some(path.unwrap_or_else(|| self.options.base.join(&*entry.name)))
    }

    fn path(&self, frame: usize) -> Result<PathBuf, SourceError> {
        self.known_path(frame).ok_or_else(|| SourceError {
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
        frame_size(&self.path(frame)?).map_err(|error| self.error(error))
    }

    fn bytes_per_pixel(&self) -> u64 {
        let is_exr = |path: PathBuf| {
            path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"))
        };
        if self.known_path(0).is_some_and(is_exr) { 6 } else { 3 }
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        let path = &*self.path(frame)?;
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
        let path = &*self.path(frame)?;
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
        let path = self.known_path(frame);
        path.map(|path| (shown(&self.options.base, &path), Origin::File(path)))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(base: &str, argument: &str, files: &[&str]) -> (Vec<Option<PathBuf>>, usize) {
        let files = files.iter().map(PathBuf::from).collect();
        let listing = FileListing::of_names(Path::new(argument), files).unwrap();
        let options = SourceOptions { base: base.into(), ..SourceOptions::default() };
        let files = Files::new(&listing, options);
        ((0..3).map(|frame| files.known_path(frame)).collect(), files.paths.len())
    }

    #[test]
    fn every_frame_has_its_path_but_few_are_kept() {
        let of = |path: &str| Some(PathBuf::from(path));
        for (base, one, two) in [
            ("", "gt/1.png", "gt/2.png"),
            ("/x", "/x/gt/1.png", "/x/gt/2.png"),
            ("x", "/y/1.png", "/y/2.png"),
        ] {
            assert_eq!(paths(base, "gt", &[one, two]), (vec![of(one), of(two), None], 0));
        }
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf8_keep_their_paths() {
        use std::os::unix::ffi::OsStrExt;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"gt/\xff1.png"));
        let listing = FileListing::of_names(Path::new("gt"), vec![path.to_owned()]).unwrap();
        let files = Files::new(&listing, SourceOptions::default());
        assert_eq!((files.known_path(0).as_deref(), files.paths.len()), (Some(path), 1));
        // So does a name that looks like one of these.
        assert_eq!(paths("", "gt", &[r"gt/\xff1.png"]).1, 1);
    }
}
