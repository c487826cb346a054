//! What tells one version of an input from another: its size and its SHA-256.

use std::fmt::Write;
use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::small_file::open_regular_file;

/// Size and hash of a file's bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileId {
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 in lower-case hexadecimal digits, as `sha256sum` prints it.
    pub sha256: String,
}

impl FileId {
    /// Of a file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn of_file(path: &Path) -> io::Result<Self> {
        Self::of(open_regular_file(path)?)
    }

    /// Of everything a reader still has.
    ///
    /// # Errors
    /// When the reader has one.
    pub fn of(mut reader: impl Read) -> io::Result<Self> {
        /// Fits the second-level cache, and keeps system calls rare.
        const CHUNK: usize = 128 << 10;
        let mut chunk = vec![0; CHUNK];
        let (mut hash, mut bytes) = (Sha256::new(), 0);
        loop {
            match reader.read(&mut chunk) {
                Ok(0) => break,
                Ok(read) => {
                    hash.update(&chunk[..read]);
                    bytes += read as u64;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        let mut sha256 = String::new();
        for byte in hash.finalize() {
            // Writing to a string does not fail.
            let _ = write!(sha256, "{byte:02x}");
        }
        Ok(Self { bytes, sha256 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4's own example.
    #[test]
    fn the_hash_is_that_of_the_standard() {
        let id = FileId::of(&b"abc"[..]).unwrap();
        assert_eq!(id.bytes, 3);
        assert_eq!(id.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
