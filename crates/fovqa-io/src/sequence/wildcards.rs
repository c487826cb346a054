//! Finds the paths that match a path with wildcards: `renders/*/gt.[0-9]*.exr`.
//!
//! Entries that cannot be read, such as broken links, and names that are not UTF-8 are found like
//! all others.

use std::ffi::OsStr;
use std::io;
use std::path::{Component, Path, PathBuf};

use glob::{MatchOptions, Pattern, PatternError};

/// The reason why no paths were found.
#[derive(Debug)]
pub(super) enum WildcardError {
    /// The pattern is not valid.
    Pattern(PatternError),
    /// A folder cannot be read.
    Io { path: PathBuf, error: io::Error },
}

/// Whether a path contains wildcards.
pub fn is_glob(path: &Path) -> bool {
    path.as_os_str().as_encoded_bytes().iter().any(|byte| b"*?[".contains(byte))
}

/// Escapes a name for use in a pattern, so that `[`, `*` and `?` in the names of folders are not
/// wildcards.
pub fn literal(name: &str) -> String {
    Pattern::escape(name)
}

/// The paths below `start` that match a relative path; an absolute path is matched by itself.
/// Wildcards do not match separators, nor a dot at the start of a name; `**` stands for any number
/// of folders.
pub(super) fn fitting(start: &Path, wanted: &Path) -> Result<Vec<PathBuf>, WildcardError> {
    let mut found = vec![start.to_owned()];
    let mut last = wanted.components().peekable();
    while let Some(component) = last.next() {
        let folders = last.peek().is_some();
        let name = component.as_os_str();
        let wild = matches!(component, Component::Normal(_)) && is_glob(Path::new(name));
        if name == "**" {
            let mut all = Vec::new();
            for path in found {
                below(path, 0, &mut all)?;
            }
            found = all;
        } else if wild {
            let text = name.to_string_lossy();
            let pattern = Pattern::new(&text).map_err(WildcardError::Pattern)?;
            let mut next = Vec::new();
            for folder in found.iter().filter(|path| path.as_os_str().is_empty() || path.is_dir()) {
                next.extend(in_folder(folder, &pattern, folders)?);
            }
            found = next;
        } else {
            for path in &mut found {
                path.push(name);
            }
            // A path below something that is not a folder does not exist.
            found.retain(|path| path.symlink_metadata().is_ok());
        }
    }
    Ok(found)
}

/// The entries of a folder whose names match.
fn in_folder(
    folder: &Path,
    pattern: &Pattern,
    folders: bool,
) -> Result<Vec<PathBuf>, WildcardError> {
    let options = MatchOptions { require_literal_leading_dot: true, ..MatchOptions::default() };
    let mut found = Vec::new();
    for name in names(folder)? {
        if pattern.matches_with(&name.to_string_lossy(), options) {
            let path = folder.join(name);
            if !folders || path.is_dir() {
                found.push(path);
            }
        }
    }
    Ok(found)
}

/// A folder and all folders below it, without hidden ones and without following links.
fn below(folder: PathBuf, depth: usize, all: &mut Vec<PathBuf>) -> Result<(), WildcardError> {
    /// No tree of renders is deeper.
    const DEEPEST: usize = 64;
    if depth < DEEPEST {
        for name in names(&folder)? {
            let path = folder.join(&name);
            let hidden = name.as_encoded_bytes().starts_with(b".");
            if !hidden && path.symlink_metadata().is_ok_and(|entry| entry.is_dir()) {
                below(path, depth + 1, all)?;
            }
        }
    }
    all.push(folder);
    Ok(())
}

/// The names in a folder, sorted.
fn names(folder: &Path) -> Result<Vec<std::ffi::OsString>, WildcardError> {
    let failed = |error| WildcardError::Io { path: folder.to_owned(), error };
    let here = if folder.as_os_str() == OsStr::new("") { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(here).map_err(failed)?;
    let names: io::Result<Vec<_>> = entries.map(|entry| Ok(entry?.file_name())).collect();
    let mut names = names.map_err(failed)?;
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree() -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        for file in ["a/x1.png", "a/x2.png", "a/.x3.png", "b/c/x4.png", "b[1]/x5.png"] {
            std::fs::create_dir_all(dir.path().join(file).parent().unwrap()).unwrap();
            std::fs::write(dir.path().join(file), "").unwrap();
        }
        dir
    }

    fn found(dir: &Path, wanted: &str) -> Vec<String> {
        let paths = fitting(dir, Path::new(wanted)).unwrap();
        let below = |path: &PathBuf| path.strip_prefix(dir).unwrap().display().to_string();
        let mut paths: Vec<String> = paths.iter().map(below).collect();
        paths.sort();
        paths
    }

    #[test]
    fn wildcards_in_names_and_folders() {
        let dir = tree();
        assert_eq!(found(dir.path(), "a/*.png"), ["a/x1.png", "a/x2.png"]);
        assert_eq!(found(dir.path(), "*/x[1-2].png"), ["a/x1.png", "a/x2.png"]);
        assert_eq!(found(dir.path(), "**/x?.png").len(), 4);
        assert_eq!(found(dir.path(), "b/*/../c/x*.png"), ["b/c/../c/x4.png"]);
        assert_eq!(found(&dir.path().join("b[1]"), "*"), ["x5.png"].map(|_| "x5.png"));
        assert!(found(dir.path(), "a/x1.png/*").is_empty());
        assert!(matches!(fitting(dir.path(), Path::new("a/[")), Err(WildcardError::Pattern(_))));
    }

    #[cfg(unix)]
    #[test]
    fn unreadable_entries_are_found() {
        use std::os::unix::ffi::OsStrExt;
        let dir = tree();
        std::os::unix::fs::symlink("nowhere", dir.path().join("a/x9.png")).unwrap();
        std::fs::write(dir.path().join("a").join(OsStr::from_bytes(b"x\xff.png")), "").unwrap();
        let paths = fitting(dir.path(), Path::new("a/x*.png")).unwrap();
        assert_eq!(paths.len(), 4, "{paths:?}");
    }
}
