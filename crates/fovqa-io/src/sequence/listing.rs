//! The files that a path argument stands for, with the numbers of their frames.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use fovqa_frame::source::{Entry, Frames, Listing, Numbering};

use super::frame_number::frame_numbers;
use super::listing_error::ListingError;
use super::natural_order::natural_cmp;
use super::shown::shown;

/// An image file of a sequence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameFile {
    /// The file.
    pub path: PathBuf,
    /// Its name without the extension.
    pub stem: OsString,
    /// Its frame's number; `None` if the names do not identify the frames by number.
    pub number: Option<i64>,
}

/// The files that a path argument stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileListing {
    /// The argument.
    pub argument: PathBuf,
    /// Whether the argument names a single file.
    pub is_file: bool,
    /// The files, ordered by their numbers, or else in natural order.
    pub files: Vec<FrameFile>,
    /// How the numbers were found.
    pub numbering: Numbering,
}

impl FileListing {
    /// The listing of an argument that names a single file.
    pub(super) fn of_file(path: &Path) -> Self {
        Self { is_file: true, ..Self::by_name(path, vec![path.to_owned()]) }
    }

    /// The frames of the files, with names relative to a folder as in results.
    pub fn listing(&self, base: &Path) -> Listing {
        let entry = |file: &FrameFile| Entry {
            name: shown(base, &file.path).into(),
            stem: file.stem.clone(),
            number: file.number,
        };
        Listing {
            argument: shown(base, &self.argument),
            is_single: self.is_file,
            frames: Frames::Named(self.files.iter().map(entry).collect()),
            numbering: self.numbering.clone(),
        }
    }

    /// The listing of files whose names contain the numbers.
    ///
    /// # Errors
    /// When two files have the same stem.
    pub fn of_names(argument: &Path, paths: Vec<PathBuf>) -> Result<Self, ListingError> {
        Self::by_name(argument, paths).checked()
    }

    fn by_name(argument: &Path, mut paths: Vec<PathBuf>) -> Self {
        paths.sort_by(|a, b| in_natural_order(a, b));
        let stem = |path: &PathBuf| path.file_stem().unwrap_or_default().to_owned();
        let stems: Vec<OsString> = paths.iter().map(stem).collect();
        let texts: Vec<_> = stems.iter().map(|stem| stem.to_string_lossy()).collect();
        let texts: Vec<&str> = texts.iter().map(AsRef::as_ref).collect();
        let (numbers, numbering) = frame_numbers(&texts);
        let files = paths.into_iter().zip(&stems).zip(numbers);
        let files =
            files.map(|((path, stem), number)| FrameFile { path, stem: stem.clone(), number });
        Self { argument: argument.to_owned(), is_file: false, files: files.collect(), numbering }
    }

    /// The listing of files whose numbers a pattern has found.
    ///
    /// # Errors
    /// When two files have the same stem.
    pub(super) fn of_pattern(
        argument: &Path,
        files: Vec<(PathBuf, i64)>,
        numbering: Numbering,
    ) -> Result<Self, ListingError> {
        let known = numbering == Numbering::ByName;
        let file = |(path, number): (PathBuf, i64)| {
            let stem = path.file_stem().unwrap_or_default().to_owned();
            FrameFile { path, stem, number: Some(number).filter(|_| known) }
        };
        let files = files.into_iter().map(file).collect();
        Self { argument: argument.to_owned(), is_file: false, files, numbering }.checked()
    }

    /// Sorts the files and checks that each stem occurs once.
    fn checked(mut self) -> Result<Self, ListingError> {
        self.files.sort_by(|a, b| {
            a.number.cmp(&b.number).then_with(|| in_natural_order(&a.path, &b.path))
        });
        let mut stems: BTreeMap<String, &FrameFile> = BTreeMap::new();
        for file in &self.files {
            // On many systems, stems that differ only in upper and lower case are the same file.
            let key = file.stem.to_string_lossy().to_lowercase();
            if let Some(other) = stems.insert(key, file) {
                let utf8 = |file: &FrameFile| file.stem.to_str().is_some();
                if other.stem == file.stem || (utf8(other) && utf8(file)) {
                    return Err(ListingError::SameStem(other.path.clone(), file.path.clone()));
                }
            }
        }
        Ok(self)
    }
}

fn in_natural_order(a: &Path, b: &Path) -> Ordering {
    natural_cmp(&a.to_string_lossy(), &b.to_string_lossy()).then_with(|| a.cmp(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(names: &[&str]) -> Result<FileListing, ListingError> {
        FileListing::of_names(Path::new("gt"), names.iter().map(PathBuf::from).collect())
    }

    #[test]
    fn files_come_by_their_numbers() {
        let names = |listing: &FileListing| -> Vec<String> {
            listing.files.iter().map(|f| f.path.display().to_string()).collect()
        };
        let negative = listing(&["f.-1.png", "f.-2.png", "f.0.png", "f.10.png", "f.9.png"]);
        let wanted = ["f.-2.png", "f.-1.png", "f.0.png", "f.9.png", "f.10.png"];
        assert_eq!(names(&negative.unwrap()), wanted);
        assert_eq!(names(&listing(&["red.png", "blue.png"]).unwrap()), ["blue.png", "red.png"]);
        assert_eq!(names(&listing(&["blue2.png", "red1.png"]).unwrap())[0], "red1.png");
    }

    #[test]
    fn one_stem_is_one_frame() {
        for twice in [["0.png", "0.exr"], ["F1.png", "f1.png"]] {
            assert!(matches!(listing(&twice), Err(ListingError::SameStem(..))), "{twice:?}");
        }
    }
}
