//! Opening a regular file, its first bytes, and the identity of what was read.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use fovqa_frame::source::InputId;

use crate::error::{ReadError, ReadErrorKind};
use crate::input_id::id_of;

/// The first bytes of every OpenEXR file.
pub(crate) const EXR_MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// What is decoded of a file, with the identity of its bytes.
pub(crate) fn hashed<T>(
    path: &Path,
    decode: impl FnOnce(File) -> Result<T, ReadErrorKind>,
) -> Result<(T, InputId), ReadError> {
    let read = || {
        let mut file = open(path)?;
        // One more pass over the file, whose pages are in memory from then on: no decoder reads all
        // of its bytes in order. The same open file, so that another one put in its place is not
        // taken for it.
        let id = id_of(&mut file)?;
        file.rewind()?;
        Ok((decode(file)?, id))
    };
    read().map_err(|kind: ReadErrorKind| kind.at(path))
}

/// Opens a regular file.
pub(crate) fn open(path: &Path) -> Result<File, ReadErrorKind> {
    let kind = match std::fs::metadata(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(std::fs::read_link(path).map_or(error.into(), ReadErrorKind::Dangling));
        }
        found => found?,
    };
    if kind.is_dir() {
        return Err(std::io::Error::from(std::io::ErrorKind::IsADirectory).into());
    }
    // Before it is opened, which a pipe without a writer would never end.
    if !kind.is_file() {
        return Err(ReadErrorKind::NotRegular);
    }
    Ok(File::open(path)?)
}

/// A file, and its first bytes.
pub(crate) fn buffered(file: File) -> Result<(BufReader<File>, Vec<u8>), ReadErrorKind> {
    /// Large enough to keep system calls rare, small enough for the second-level cache.
    const BUFFER: usize = 256 << 10;
    let mut file = BufReader::with_capacity(BUFFER, file);
    let mut magic = Vec::with_capacity(8);
    file.by_ref().take(8).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok((file, magic))
}
