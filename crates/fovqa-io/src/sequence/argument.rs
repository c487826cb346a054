//! One path argument to a list of image files.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::natural_order::{last_number, natural_cmp};
#[cfg(doc)]
use crate::ReadErrorKind;

/// Endings of the files that count as images in folders and globs.
const ENDINGS: [&str; 4] = ["png", "jpg", "jpeg", "exr"];

/// An image file of a sequence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameFile {
    /// The file.
    pub path: PathBuf,
    /// Its name without the ending.
    pub stem: String,
    /// The last run of digits in the stem, or what `%d` stood for.
    pub number: Option<u64>,
}

/// What a path argument stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listing {
    /// The argument.
    pub argument: PathBuf,
    /// Whether it names one file outright.
    pub is_file: bool,
    /// The files, in natural order.
    pub files: Vec<FrameFile>,
}

/// A path argument that stands for nothing, or for more than can be told apart.
#[derive(Debug, Error)]
pub enum ListingError {
    /// Nothing there.
    #[error("{}: there is no such file or folder", .0.display())]
    NotFound(PathBuf),
    /// A device, a pipe or the like.
    #[error("{}: it is neither a file nor a folder", .0.display())]
    NotRegular(PathBuf),
    /// The operating system refused.
    #[error("{}: it cannot be read: {error}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// A folder or pattern without an image.
    #[error("{}: {}", path.display(), nothing(*.other_files))]
    Empty {
        /// The argument.
        path: PathBuf,
        /// Files of other types that are there.
        other_files: usize,
    },
    /// Two images of one stem.
    #[error("{} and {} have one stem: which is the frame?", .0.display(), .1.display())]
    SameStem(PathBuf, PathBuf),
    /// A broken glob.
    #[error("{}: it is not a pattern: {detail}", path.display())]
    Pattern {
        /// The argument.
        path: PathBuf,
        /// What is wrong.
        detail: String,
    },
}

fn nothing(other_files: usize) -> String {
    match other_files {
        0 => "no file is there".to_owned(),
        1 => "no image is there, only a file of another type".to_owned(),
        n => format!("no image is there, only {n} files of other types"),
    }
}

impl ListingError {
    /// The same of other paths: as results show them.
    #[must_use]
    pub fn with_paths(self, shown: &dyn Fn(&Path) -> PathBuf) -> Self {
        match self {
            Self::NotFound(path) => Self::NotFound(shown(&path)),
            Self::NotRegular(path) => Self::NotRegular(shown(&path)),
            Self::Io { path, error } => Self::Io { path: shown(&path), error },
            Self::Empty { path, other_files } => Self::Empty { path: shown(&path), other_files },
            Self::SameStem(a, b) => Self::SameStem(shown(&a), shown(&b)),
            Self::Pattern { path, detail } => Self::Pattern { path: shown(&path), detail },
        }
    }

    /// How to mend it; settings stand in braces, as in [`ReadErrorKind::help`].
    pub fn help(&self) -> &'static str {
        match self {
            Self::NotFound(_) => "check the path; a relative one starts in {start}",
            Self::NotRegular(_) => "give a file, a folder or a pattern",
            Self::Io { .. } => "check that it may be read",
            Self::Empty { .. } => {
                "give a folder with .png, .jpg or .exr files, or a pattern that matches some"
            }
            Self::SameStem(..) => "give a pattern with the ending, such as 'renders/*.exr'",
            Self::Pattern { .. } => "use *, ? and [a-z], or one printf field such as %04d",
        }
    }
}

/// The characters of a path as themselves, for a pattern to be made of it: `[`, `*` and `?` in the
/// names of folders are no wildcards.
pub fn literal(path: &Path) -> PathBuf {
    glob::Pattern::escape(&path.to_string_lossy()).into()
}

/// Whether a path has wildcards in it.
pub fn is_glob(path: &Path) -> bool {
    path.to_string_lossy().contains(['*', '?', '['])
}

/// The files an argument below a folder stands for, as [`list`]; wildcards in the folder's own name
/// are none.
///
/// # Errors
/// As [`list`].
pub fn list_below(folder: &Path, argument: &Path) -> Result<Listing, ListingError> {
    match argument.strip_prefix(folder) {
        Ok(below) if is_glob(below) && !argument.exists() => list(&literal(folder).join(below)),
        _ => list(argument),
    }
}

/// The files an argument stands for: a file, a folder, a glob (`*.exr`) or a printf pattern
/// (`gt.%04d.exr`). In folders and globs, files that are not images are passed over.
///
/// # Errors
/// When nothing is there, it cannot be read, or two images share a stem.
pub fn list(argument: &Path) -> Result<Listing, ListingError> {
    let text = argument.to_string_lossy();
    let is_file = argument.is_file();
    let (paths, others): (Vec<PathBuf>, usize) = if is_file {
        (vec![argument.to_owned()], 0)
    } else if argument.is_dir() {
        let (images, others) =
            folder(argument)?.into_iter().partition::<Vec<_>, _>(|p| is_image(p));
        (images, others.len())
    } else if let Some(pattern) = Printf::parse(argument) {
        return printf(argument, &pattern?);
    } else if text.contains(['*', '?', '[']) {
        let visible =
            glob::MatchOptions { require_literal_leading_dot: true, ..Default::default() };
        let found =
            glob::glob_with(&text, visible).map_err(|e| pattern_error(argument, &e.to_string()))?;
        let mut paths = Vec::new();
        for path in found {
            paths.push(
                path.map_err(|e| ListingError::Io { path: e.path().to_owned(), error: e.into() })?,
            );
        }
        paths.retain(|p| p.is_file());
        let (images, others) = paths.into_iter().partition::<Vec<_>, _>(|p| is_image(p));
        (images, others.len())
    } else {
        return Err(nothing_at(argument));
    };
    let files = paths.into_iter().map(|path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let number = last_number(&stem);
        FrameFile { path, stem, number }
    });
    listing(argument, is_file, files.collect(), others)
}

/// Why a path is neither a file nor a folder.
fn nothing_at(argument: &Path) -> ListingError {
    let path = argument.to_owned();
    match fs::metadata(argument) {
        Ok(_) => ListingError::NotRegular(path),
        Err(error) if error.kind() == io::ErrorKind::NotFound => ListingError::NotFound(path),
        Err(error) => ListingError::Io { path, error },
    }
}

fn listing(
    argument: &Path,
    is_file: bool,
    mut files: Vec<FrameFile>,
    other_files: usize,
) -> Result<Listing, ListingError> {
    let path = argument.to_owned();
    if files.is_empty() {
        return Err(ListingError::Empty { path, other_files });
    }
    files.sort_by(|a, b| natural_cmp(&a.path.to_string_lossy(), &b.path.to_string_lossy()));
    let mut stems: BTreeMap<&str, &Path> = BTreeMap::new();
    for file in &files {
        if let Some(other) = stems.insert(&file.stem, &file.path) {
            return Err(ListingError::SameStem(other.to_owned(), file.path.clone()));
        }
    }
    Ok(Listing { argument: path, is_file, files })
}

fn pattern_error(path: &Path, detail: &str) -> ListingError {
    ListingError::Pattern { path: path.to_owned(), detail: detail.to_owned() }
}

fn is_image(path: &Path) -> bool {
    path.extension().is_some_and(|e| ENDINGS.iter().any(|ending| e.eq_ignore_ascii_case(ending)))
}

fn folder(path: &Path) -> Result<Vec<PathBuf>, ListingError> {
    let io_error = |error| ListingError::Io { path: path.to_owned(), error };
    let mut paths = Vec::new();
    for entry in fs::read_dir(path).map_err(io_error)? {
        let entry = entry.map_err(io_error)?;
        let hidden = entry.file_name().to_string_lossy().starts_with('.');
        if !hidden && entry.path().is_file() {
            paths.push(entry.path());
        }
    }
    Ok(paths)
}

/// A file name with one `%d` or `%04d` in it.
struct Printf {
    before: String,
    digits: usize,
    after: String,
}

impl Printf {
    /// `None` when the file name has no `%`.
    fn parse(argument: &Path) -> Option<Result<Self, ListingError>> {
        let name = argument.file_name()?.to_string_lossy();
        let (before, rest) = name.split_once('%')?;
        let parse = || {
            let digits = rest.find('d')?;
            let width = &rest[..digits];
            let digits_wanted = if width.is_empty() {
                0
            } else {
                width.strip_prefix('0')?.parse().ok().filter(|n| *n < 20)?
            };
            let after = &rest[digits + 1..];
            (!after.contains('%')).then(|| Printf {
                before: before.to_owned(),
                digits: digits_wanted,
                after: after.to_owned(),
            })
        };
        let detail = "the % in it is not one field such as %d or %04d";
        Some(parse().ok_or_else(|| pattern_error(argument, detail)))
    }

    /// The number of a file name that fits.
    fn number(&self, name: &str) -> Option<u64> {
        let digits = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        let plain = digits.bytes().all(|b| b.is_ascii_digit());
        // %04d writes at least four digits, and more only without leading zeros.
        let fits = digits.len() == self.digits.max(1)
            || (digits.len() > self.digits.max(1) && !digits.starts_with('0'));
        (plain && fits).then(|| digits.parse().ok()).flatten()
    }
}

fn printf(argument: &Path, pattern: &Printf) -> Result<Listing, ListingError> {
    let parent = match argument.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !parent.is_dir() {
        return Err(ListingError::NotFound(parent.to_owned()));
    }
    let mut files = Vec::new();
    for path in folder(parent)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if let Some(number) = pattern.number(&name) {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let path = if parent == Path::new(".") { PathBuf::from(&name) } else { path };
            files.push(FrameFile { path, stem, number: Some(number) });
        }
    }
    listing(argument, false, files, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(names: &[&str]) -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        for name in names {
            fs::write(dir.path().join(name), b"").unwrap();
        }
        dir
    }

    fn stems(listing: &Listing) -> Vec<&str> {
        listing.files.iter().map(|f| f.stem.as_str()).collect()
    }

    #[test]
    fn folders_globs_and_patterns() {
        let dir = folder_with(&["f10.png", "f9.png", "notes.txt", "f11.EXR", ".f1.png", "g1.jpeg"]);
        let all = list(dir.path()).unwrap();
        assert_eq!(stems(&all), ["f9", "f10", "f11", "g1"]);
        assert_eq!(stems(&list(&dir.path().join("f*")).unwrap()), ["f9", "f10", "f11"]);
        assert_eq!(stems(&list(&dir.path().join("*.png")).unwrap()), ["f9", "f10"], "no dot files");
        let printf = list(&dir.path().join("f%d.png")).unwrap();
        assert_eq!(printf.files.iter().map(|f| f.number).collect::<Vec<_>>(), [Some(9), Some(10)]);
        assert_eq!(stems(&list(&dir.path().join("f%02d.png")).unwrap()), ["f10"]);
        assert!(list(&dir.path().join("f10.png")).unwrap().is_file);
    }

    #[test]
    fn says_what_is_not_there() {
        let dir = folder_with(&["a.txt", "b.md"]);
        assert!(matches!(list(dir.path()), Err(ListingError::Empty { other_files: 2, .. })));
        assert!(matches!(list(&dir.path().join("nope")), Err(ListingError::NotFound(_))));
        assert!(matches!(list(&dir.path().join("no/x%04d.png")), Err(ListingError::NotFound(_))));
        assert!(matches!(list(&dir.path().join("x%s.png")), Err(ListingError::Pattern { .. })));
        assert!(matches!(list(&dir.path().join("x%d%d.png")), Err(ListingError::Pattern { .. })));
        assert!(matches!(list(&dir.path().join("x[.png")), Err(ListingError::Pattern { .. })));
        let twice = folder_with(&["0.png", "0.exr"]);
        assert!(matches!(list(twice.path()), Err(ListingError::SameStem(..))));
    }
}
