//! Lists the image files that a path argument stands for.

use std::fs;
use std::path::{Path, PathBuf};

use super::frame_pattern::FramePattern;
use super::listing::FileListing;
use super::listing_error::ListingError;
use super::wildcards::{WildcardError, fitting, is_glob};

/// Extensions of the files that count as images in folders and globs.
const ENDINGS: [&str; 4] = ["png", "jpg", "jpeg", "exr"];

/// The files that an argument below a folder stands for, as in [`list`]. Wildcard characters in the
/// folder's own name have no special meaning.
///
/// # Errors
/// As [`list`].
pub fn list_below(folder: &Path, argument: &Path) -> Result<FileListing, ListingError> {
    match argument.strip_prefix(folder) {
        Ok(below) => listed(argument, folder, below),
        Err(_) => list(argument),
    }
}

/// The files that an argument stands for: a file, a folder, a glob (`*.exr`) or a pattern with a
/// number (`gt.%04d.exr`, `gt.####.exr`). In folders and globs, files that are not images are
/// ignored. An entry with the name of an image is listed even if it cannot be read: a link to a
/// missing file or to a folder, or a pipe.
///
/// # Errors
/// When nothing exists there, it cannot be read, or two images have the same stem.
pub fn list(argument: &Path) -> Result<FileListing, ListingError> {
    listed(argument, Path::new(""), argument)
}

/// The files of an argument, which is `below` in the folder `start`. Only `below` may have
/// wildcards.
fn listed(argument: &Path, start: &Path, below: &Path) -> Result<FileListing, ListingError> {
    if argument.is_file() {
        return Ok(FileListing::of_file(argument));
    }
    if argument.is_dir() {
        return images(argument, entries(argument)?);
    }
    let name = argument.file_name().unwrap_or_default();
    // A broken link whose name contains a wildcard character is that link itself.
    let is_there = fs::symlink_metadata(argument).is_ok();
    match FramePattern::parse(&name.to_string_lossy()).filter(|_| !is_there) {
        Some(Ok(pattern)) => return numbered(argument, &pattern),
        Some(Err(detail)) => return Err(pattern_error(argument, detail)),
        None => {}
    }
    if is_there || !is_glob(below) {
        return Err(ListingError::nothing_at(argument));
    }
    let mut paths = fitting(start, below).map_err(|error| match error {
        WildcardError::Pattern(error) => pattern_error(argument, &error.to_string()),
        WildcardError::Io { path, error } => ListingError::Io { path, error },
    })?;
    paths.retain(|path| !is_folder(path));
    images(argument, paths)
}

fn pattern_error(path: &Path, detail: &str) -> ListingError {
    ListingError::Pattern { path: path.to_owned(), detail: detail.to_owned() }
}

/// The listing of the images among the files that were found.
fn images(argument: &Path, paths: Vec<PathBuf>) -> Result<FileListing, ListingError> {
    let (images, others): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| is_image(path));
    if images.is_empty() {
        let other_files = others.len();
        return Err(ListingError::Empty { path: argument.to_owned(), other_files });
    }
    FileListing::of_names(argument, images)
}

fn is_image(path: &Path) -> bool {
    path.extension().is_some_and(|e| ENDINGS.iter().any(|ending| e.eq_ignore_ascii_case(ending)))
}

/// The entries of a folder without hidden entries and folders.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, ListingError> {
    let io_error = |error| ListingError::Io { path: folder.to_owned(), error };
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(io_error)? {
        let name = entry.map_err(io_error)?.file_name();
        let path = folder.join(&name);
        let hidden = name.as_encoded_bytes().starts_with(b".");
        if !hidden && !is_folder(&path) {
            paths.push(path);
        }
    }
    // The system returns no defined order, and messages name the first entry.
    paths.sort();
    Ok(paths)
}

/// Whether a path is a folder. A link to a folder does not count if it has the name of an image: it
/// stands for a frame.
fn is_folder(path: &Path) -> bool {
    if is_image(path) {
        path.symlink_metadata().is_ok_and(|entry| entry.is_dir())
    } else {
        path.is_dir()
    }
}

/// The files in the argument's folder whose names match its pattern.
fn numbered(argument: &Path, pattern: &FramePattern) -> Result<FileListing, ListingError> {
    let parent = match argument.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !parent.is_dir() {
        return Err(ListingError::nothing_at(parent));
    }
    let paths = entries(parent)?;
    let names = paths.iter().map(|path| path.file_name().unwrap_or_default().to_string_lossy());
    let names: Vec<_> = names.collect();
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    let (fitting, numbering) = pattern.select(&names);
    if fitting.is_empty() {
        return Err(ListingError::Empty { path: argument.to_owned(), other_files: 0 });
    }
    let here = parent == Path::new(".");
    let file = |(index, number): (usize, i64)| {
        let path: &Path = &paths[index];
        let path = if here { Path::new(path.file_name().unwrap_or_default()) } else { path };
        (path.to_owned(), number)
    };
    FileListing::of_pattern(argument, fitting.into_iter().map(file).collect(), numbering)
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

    fn stems(listing: &FileListing) -> Vec<&str> {
        listing.files.iter().map(|f| f.stem.to_str().unwrap()).collect()
    }

    #[test]
    fn folders_globs_and_patterns() {
        let names = ["f10.png", "f9.png", "notes.txt", "f11.EXR", ".f1.png", "f12.jpeg"];
        let dir = folder_with(&names);
        let all = list(dir.path()).unwrap();
        assert_eq!(stems(&all), ["f9", "f10", "f11", "f12"]);
        assert_eq!(stems(&list(&dir.path().join("f1*")).unwrap()), ["f10", "f11", "f12"]);
        assert_eq!(stems(&list(&dir.path().join("*.png")).unwrap()), ["f9", "f10"], "no dot files");
        for pattern in ["f%d.png", "f#.png"] {
            let found = list(&dir.path().join(pattern)).unwrap();
            let numbers: Vec<_> = found.files.iter().map(|f| f.number).collect();
            assert_eq!(numbers, [Some(9), Some(10)]);
        }
        assert_eq!(stems(&list(&dir.path().join("f%02d.png")).unwrap()), ["f10"]);
        assert_eq!(stems(&list(&dir.path().join("f##.*")).unwrap()), ["f10", "f11", "f12"]);
        assert!(list(&dir.path().join("f10.png")).unwrap().is_file);
        let below = list_below(dir.path(), &dir.path().join("f1[01]*")).unwrap();
        assert_eq!(stems(&below), ["f10", "f11"]);
    }

    #[test]
    fn refuses_missing_paths_and_invalid_patterns() {
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

    #[test]
    fn a_file_is_itself_whatever_its_name() {
        let dir = folder_with(&["a#1.png", "b[1].png", "c%d.png"]);
        for name in ["a#1.png", "b[1].png", "c%d.png"] {
            assert!(list(&dir.path().join(name)).unwrap().is_file, "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn unreadable_entries_are_listed_as_frames() {
        use std::os::unix::fs::symlink;
        let dir = folder_with(&["f1.png", "f2.png"]);
        symlink("nowhere", dir.path().join("f3.png")).unwrap();
        symlink(".", dir.path().join("f4.png")).unwrap();
        symlink("nowhere", dir.path().join("notes.txt")).unwrap();
        fs::create_dir(dir.path().join("old")).unwrap();
        for argument in ["", "*.png", "f%d.png", "f*"] {
            let found = list(&dir.path().join(argument)).unwrap();
            assert_eq!(stems(&found), ["f1", "f2", "f3", "f4"], "{argument:?}");
        }
        assert!(matches!(list(&dir.path().join("f3.png")), Err(ListingError::Dangling { .. })));
    }
}
