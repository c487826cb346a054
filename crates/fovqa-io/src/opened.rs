//! Opens a regular file, reads its first bytes and computes its identity.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use fovqa_frame::source::InputId;

use crate::error::{ReadError, ReadErrorKind};
use crate::input_id::id_of;

/// The first bytes of every OpenEXR file.
pub(crate) const EXR_MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// The result of decoding a file, with the identity of its bytes if `hash` is set.
pub(crate) fn hashed<T>(
    path: &Path,
    decode: impl FnOnce(File) -> Result<T, ReadErrorKind>,
) -> Result<(T, InputId), ReadError> {
    let read = || {
        let mut file = open(path)?;
        // Hashing needs one more pass over the file, because no decoder reads all bytes in order;
        // the file is in the page cache afterwards. The same open file is used, so that a file that
        // replaces it in the meantime is not hashed instead.
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
    // This is checked before opening, because opening a pipe without a writer would wait forever.
    if !kind.is_file() {
        return Err(ReadErrorKind::NotRegular);
    }
    Ok(File::open(path)?)
}

/// A buffered reader of a file, and the file's first bytes.
pub(crate) fn buffered(file: File) -> Result<(BufReader<File>, Vec<u8>), ReadErrorKind> {
    /// Large enough to need few system calls, small enough for the second-level cache.
    const BUFFER: usize = 256 << 10;
    let mut file = BufReader::with_capacity(BUFFER, file);
    let mut magic = Vec::with_capacity(8);
    file.by_ref().take(8).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok((file, magic))
}
