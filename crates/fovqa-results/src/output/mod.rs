//! Writes files so that a reader sees the old file or the new one, never a part of either, and that
//! files survive a power failure.

mod target;
mod temporary;

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::files::FileError;
use target::{Target, open_again, open_special};
pub use temporary::sweep;
use temporary::{Temporary, sweep_once};

/// Writes a file of a run completely: under a temporary name in the same folder, which is then
/// renamed.
///
/// A symbolic link stays, and the file that it points to is replaced or created. Anything else at
/// this path is replaced.
///
/// # Errors
/// If the operating system refuses. In that case nothing is left behind, and the old file stays.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    write_whole_with(path, |out| out.write_all(bytes))
}

/// Like [`write_whole`], for a file that is too large for memory.
///
/// # Errors
/// See [`write_whole`].
pub fn write_whole_with(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> Result<(), FileError> {
    let written = Target::file_at(path).and_then(|file| replace(&file, write));
    written.map_err(|error| FileError::Write { path: path.to_owned(), error })
}

/// Writes a value as indented JSON with a newline at its end.
///
/// # Errors
/// See [`write_whole`].
pub fn write_json_file(path: &Path, value: &impl Serialize) -> Result<(), FileError> {
    write_whole_with(path, |mut out| {
        serde_json::to_writer_pretty(&mut out, value)?;
        out.write_all(b"\n")
    })
}

/// Writes an output file that the user has named. A file is replaced as by [`write_whole`]; a
/// device or a pipe is written to.
///
/// # Errors
/// See [`write_whole`].
pub fn write_output(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let written = Target::of(path).and_then(|target| {
        let mut out = match target {
            Target::File(file) => return replace(&file, |out| out.write_all(bytes)),
            Target::Special(path) => open_special(&path)?,
            Target::Open(path, stream) => open_again(&path, stream)?,
        };
        out.write_all(bytes)?;
        out.flush()
    });
    written.map_err(|error| FileError::Write { path: path.to_owned(), error })
}

/// Like [`write_output`], for a value that is written as JSON.
///
/// # Errors
/// See [`write_whole`].
pub fn write_json_output(path: &Path, value: &impl Serialize) -> Result<(), FileError> {
    write_output(path, &json(path, value)?)
}

fn json(path: &Path, value: &impl Serialize) -> Result<Vec<u8>, FileError> {
    let mut bytes = serde_json::to_vec_pretty(value)
        .map_err(|error| FileError::Write { path: path.to_owned(), error: error.into() })?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Whether an output would replace an existing file.
pub fn replaces(path: &Path) -> bool {
    Target::of(path).is_ok_and(|target| match target {
        Target::File(file) => file.exists(),
        Target::Special(_) | Target::Open(..) => false,
    })
}

/// Removes a file of a run. If the path is a symbolic link, the link stays and the file that it
/// points to is removed.
///
/// # Errors
/// If the operating system refuses. A file that does not exist is not an error.
pub fn take_away(path: &Path) -> io::Result<()> {
    match fs::remove_file(Target::file_at(path)?) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Creates a folder and its parent folders. If a symbolic link points to a folder that does not
/// exist, that folder is created.
///
/// # Errors
/// If the operating system refuses.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(if path.is_dir() { path.to_owned() } else { Target::file_at(path)? })
}

/// Checks that files can be written in a folder.
///
/// # Errors
/// If the operating system refuses.
pub fn try_writing(folder: &Path) -> io::Result<()> {
    let temporary = Temporary::new(folder)?;
    (&temporary.file).write_all(b"fovqa")?;
    temporary.take_away()
}

fn replace(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let folder = folder_of(path);
    sweep_once(&folder);
    let temporary = Temporary::new(&folder)?;
    let mut out = BufWriter::new(&temporary.file);
    write(&mut out)?;
    out.flush()?;
    drop(out);
    temporary.become_file(path)
}

/// The folder that contains a file.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests;
