//! Reads one file as one frame.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use fovqa_frame::Mask;
use fovqa_frame::source::InputId;

use crate::alpha::AlphaPolicy;
use crate::contain::contained;
use crate::decoded::Decoded;
use crate::error::{ReadError, ReadErrorKind};
use crate::guides::options::GuideOptions;
use crate::opened::{EXR_MAGIC, buffered, hashed, open};
use crate::read_options::ReadOptions;
use crate::{exr, jpeg, png};

const PNG_MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";
const JPEG_MAGIC: &[u8] = b"\xff\xd8\xff";
/// Reads a PNG, JPEG or OpenEXR file. The format is recognised by the first bytes, not by the name.
///
/// # Errors
/// When the file cannot be read, has another format, is damaged or too large, or does not fit the
/// options. A decoder that panics is an error too.
pub fn read_frame(path: &Path, options: &ReadOptions) -> Result<Decoded, ReadError> {
    open(path).and_then(|file| decode(file, options)).map_err(|kind| kind.at(path))
}

/// Reads a file as [`read_frame`] does, and returns the identity of the decoded bytes as well.
///
/// # Errors
/// As [`read_frame`].
pub fn read_frame_and_hash(
    path: &Path,
    options: &ReadOptions,
) -> Result<(Decoded, InputId), ReadError> {
    hashed(path, |file| decode(file, options))
}

fn decode(file: File, options: &ReadOptions) -> Result<Decoded, ReadErrorKind> {
    contained(|| decode_by_magic(file, options)).unwrap_or_else(|| {
        let detail = "the decoder failed on it".to_owned();
        Err(ReadErrorKind::Damaged { format: "image", detail })
    })
}

fn decode_by_magic(file: File, options: &ReadOptions) -> Result<Decoded, ReadErrorKind> {
    let (file, magic) = buffered(file)?;
    if magic.starts_with(PNG_MAGIC) {
        png::read(file, options)
    } else if magic.starts_with(JPEG_MAGIC) {
        jpeg::read(file, options)
    } else if magic.starts_with(EXR_MAGIC) {
        exr::read(file, options)
    } else {
        Err(ReadErrorKind::NotAnImage)
    }
}

/// The size of the frame in a file: its declared width and height, or those of its display window.
/// Only the header is read.
///
/// # Errors
/// When the header cannot be read. The rest of the file is not checked.
pub fn frame_size(path: &Path) -> Result<(usize, usize), ReadError> {
    let read = || {
        let file = open(path)?;
        contained(|| {
            let mut file = BufReader::new(file);
            let mut magic = Vec::with_capacity(8);
            file.by_ref().take(8).read_to_end(&mut magic)?;
            file.rewind()?;
            if magic.starts_with(EXR_MAGIC) {
                exr::size(file)
            } else if magic.starts_with(PNG_MAGIC) {
                png::size(file)
            } else if magic.starts_with(JPEG_MAGIC) {
                jpeg::size(file)
            } else {
                Err(ReadErrorKind::NotAnImage)
            }
        })
        .unwrap_or(Err(ReadErrorKind::NotAnImage))
    };
    read().map_err(|kind| kind.at(path))
}

/// Reads a mask: white (every channel above half of full scale) is visible. Alpha is ignored.
///
/// # Errors
/// As [`read_frame`].
pub fn read_mask(path: &Path, options: &ReadOptions) -> Result<Mask, ReadError> {
    let guides = GuideOptions::default();
    let options = ReadOptions { alpha: AlphaPolicy::Ignore, guides, ..options.clone() };
    Ok(Mask::of(&read_frame(path, &options)?.frame))
}
