//! The identity of an input: its size and its SHA-256.

use std::fmt::Write as _;
use std::io::{self, Read, Write as _};
use std::path::Path;

use fovqa_frame::source::InputId;
use sha2::{Digest, Sha256};

use crate::small_file::open_regular_file;

/// Size and hash of a file's bytes.
///
/// # Errors
/// When the file cannot be read.
pub fn id_of_file(path: &Path) -> io::Result<InputId> {
    id_of(open_regular_file(path)?)
}

/// Size and hash of all remaining bytes of a reader.
///
/// # Errors
/// When the reader reports an error.
pub fn id_of(mut reader: impl Read) -> io::Result<InputId> {
    /// A buffer size that fits into the second-level cache and needs few system calls.
    const CHUNK: usize = 128 << 10;
    let mut chunk = vec![0; CHUNK];
    let mut id = IdWriter::default();
    loop {
        match reader.read(&mut chunk) {
            Ok(0) => break,
            Ok(read) => id.write_all(&chunk[..read])?,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(id.id())
}

/// Computes the identity of the bytes that are written to it. Writing never fails.
#[derive(Clone, Default)]
pub struct IdWriter {
    hash: Sha256,
    bytes: u64,
}

impl IdWriter {
    /// Size and hash of the bytes so far.
    pub fn id(self) -> InputId {
        let mut sha256 = String::with_capacity(64);
        for byte in self.hash.finalize() {
            // Writing to a string does not fail.
            let _ = write!(sha256, "{byte:02x}");
        }
        InputId { bytes: self.bytes, sha256 }
    }
}

impl io::Write for IdWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.hash.update(bytes);
        self.bytes += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The expected hash is the example of FIPS 180-4.
    #[test]
    fn the_hash_is_that_of_the_standard() {
        let id = id_of(&b"abc"[..]).unwrap();
        assert_eq!(id.bytes, 3);
        assert_eq!(id.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
