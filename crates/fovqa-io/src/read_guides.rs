//! Reads files that hold motion or depth and need no colour.

use std::fs::File;
use std::path::Path;

use fovqa_frame::source::InputId;

use crate::contain::contained;
use crate::decoded::DecodedGuides;
use crate::error::{ReadError, ReadErrorKind};
use crate::exr;
use crate::opened::{EXR_MAGIC, buffered, hashed, open};
use crate::read_options::ReadOptions;

/// Reads motion and depth, as `options.guides` asks for them, from an OpenEXR file that may have no
/// colour. If the file has several layers, `options.layer` selects one.
///
/// # Errors
/// When the file cannot be read, is not OpenEXR, is damaged or too large, or lacks a channel that
/// was asked for. A decoder that panics is an error too.
pub fn read_guides(path: &Path, options: &ReadOptions) -> Result<DecodedGuides, ReadError> {
    open(path).and_then(|file| decode(file, options)).map_err(|kind| kind.at(path))
}

/// Reads a file as [`read_guides`] does, and returns the identity of the decoded bytes as well.
///
/// # Errors
/// As [`read_guides`].
pub fn read_guides_and_hash(
    path: &Path,
    options: &ReadOptions,
) -> Result<(DecodedGuides, InputId), ReadError> {
    hashed(path, |file| decode(file, options))
}

fn decode(file: File, options: &ReadOptions) -> Result<DecodedGuides, ReadErrorKind> {
    let read = || {
        let (file, magic) = buffered(file)?;
        if magic.starts_with(EXR_MAGIC) {
            exr::read_guides(file, options)
        } else {
            Err(ReadErrorKind::NotOpenExr)
        }
    };
    contained(read).unwrap_or_else(|| {
        let detail = "the decoder failed on it".to_owned();
        Err(ReadErrorKind::Damaged { format: "OpenEXR", detail })
    })
}
