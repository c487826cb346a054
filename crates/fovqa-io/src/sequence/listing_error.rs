//! Errors of path arguments that do not stand for a sequence of files.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

#[cfg(doc)]
use crate::ReadErrorKind;

/// A path argument that stands for nothing, or for files that cannot be ordered.
#[derive(Debug, Error)]
pub enum ListingError {
    /// Nothing exists at the path.
    #[error("{}: there is no such file or folder", .0.display())]
    NotFound(PathBuf),
    /// It is a link to something that does not exist.
    #[error("{}: it is a link to {}, which does not exist", link.display(), to.display())]
    Dangling {
        /// The link.
        link: PathBuf,
        /// The target of the link.
        to: PathBuf,
    },
    /// It is not a regular file but a device, a pipe or the like.
    #[error("{}: it is neither a file nor a folder", .0.display())]
    NotRegular(PathBuf),
    /// The operating system reports an error.
    #[error("{}: it cannot be read: {error}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// The folder or pattern has no image.
    #[error("{}: {}", path.display(), nothing(*.other_files))]
    Empty {
        /// The argument.
        path: PathBuf,
        /// Number of files of other types that exist there.
        other_files: usize,
    },
    /// Two images have the same stem.
    #[error("{} and {} have the same name without the ending, so the frame is ambiguous", .0.display(), .1.display())]
    SameStem(PathBuf, PathBuf),
    /// The pattern is not valid.
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
        0 => "it matches no file".to_owned(),
        1 => "it matches no image, only a file of another type".to_owned(),
        n => format!("it matches no image, only {n} files of other types"),
    }
}

impl ListingError {
    /// The reason why a path is neither a file nor a folder.
    pub(super) fn nothing_at(argument: &Path) -> Self {
        let path = argument.to_owned();
        match std::fs::metadata(argument) {
            Ok(_) => Self::NotRegular(path),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                match std::fs::read_link(argument) {
                    Ok(to) => Self::Dangling { link: path, to },
                    Err(_) => Self::NotFound(path),
                }
            }
            Err(error) => Self::Io { path, error },
        }
    }

    /// The same error with its paths as results show them.
    #[must_use]
    pub fn with_paths(self, shown: &dyn Fn(&Path) -> PathBuf) -> Self {
        match self {
            Self::NotFound(path) => Self::NotFound(shown(&path)),
            Self::Dangling { link, to } => Self::Dangling { link: shown(&link), to },
            Self::NotRegular(path) => Self::NotRegular(shown(&path)),
            Self::Io { path, error } => Self::Io { path: shown(&path), error },
            Self::Empty { path, other_files } => Self::Empty { path: shown(&path), other_files },
            Self::SameStem(a, b) => Self::SameStem(shown(&a), shown(&b)),
            Self::Pattern { path, detail } => Self::Pattern { path: shown(&path), detail },
        }
    }

    /// How to correct the error. Settings are in braces, as in [`ReadErrorKind::help`].
    pub fn help(&self) -> &'static str {
        match self {
            Self::NotFound(_) => "check the path; a relative one starts in {start}",
            Self::Dangling { .. } => {
                "fetch the file (git annex get, dvc pull), or correct the link"
            }
            Self::NotRegular(_) => {
                "give a file, a folder or a pattern; - stands for a y4m video on standard input"
            }
            Self::Io { .. } => "check that it can be read",
            Self::Empty { .. } => {
                "give a folder with .png, .jpg or .exr files, a pattern that matches some, or a y4m video by its name"
            }
            Self::SameStem(..) => "give a pattern with the ending, such as 'renders/*.exr'",
            Self::Pattern { .. } => "use *, ? and [a-z], or one number such as %04d or ####",
        }
    }
}
