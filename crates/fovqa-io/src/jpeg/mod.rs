//! JPEG (ITU-T T.81): baseline, extended sequential and progressive files with Huffman coding and 8
//! bits per sample; gray, RGB, YCbCr, CMYK and YCCK; any order of scans and any sampling with whole
//! ratios.
//!
//! Samples are equal to those of libjpeg-turbo with its default settings, to the last bit. Unlike
//! most decoders, this one refuses uncertain data: any damage that the format can show is an error,
//! and nothing is filled in or skipped.

mod application;
mod bits;
mod colour;
mod coverage;
mod decoder;
mod error;
mod frame_header;
mod head;
mod huffman;
mod idct;
mod intervals;
pub(crate) mod kind;
mod order;
mod picture;
mod progressive;
mod quantisation;
mod scan;
mod scan_header;
mod segments;
mod sequential;
mod standard_huffman;
mod upsample;

use std::io::{BufRead, Read, Seek};

use fovqa_frame::{Channels, Frame, Samples};

use crate::decoded::Decoded;
use crate::note::Note;
use crate::read_options::ReadOptions;
use colour::Colours;
use error::{Result, damaged};
use head::Head;

/// The largest file. A JPEG is read as a whole; this is four bytes per pixel of the largest picture
/// with default limits.
const MAX_BYTES: u64 = 1 << 30;

/// Reads a file.
///
/// # Errors
/// When it is damaged, too large, or of a kind that is not supported.
pub(crate) fn read(mut file: impl BufRead + Seek, options: &ReadOptions) -> Result<Decoded> {
    let mut bytes = Vec::new();
    file.by_ref().take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(damaged("it is longer than 1 GiB, the limit for JPEG files"));
    }
    let head = Head::read(&bytes)?;
    let frame = head.frame.clone();
    options.check_size(frame.width as u64, frame.height as u64)?;
    frame.check_length(head.segments.rest().len())?;
    let colours = Colours::of(&frame, &head.settings.application)?;
    let (planes, settings) = decoder::decode(head)?;
    let samples = picture::compose(&frame, &planes, colours);
    let channels = if colours == Colours::Gray { Channels::Gray } else { Channels::Rgb };
    let frame = Frame::new(frame.width, frame.height, channels, Samples::U8(samples.into()))
        .map_err(|error| damaged(error.to_string()))?;
    let mut notes = Vec::new();
    if settings.application.turned {
        notes.push(Note::Orientation);
    }
    if settings.application.profile {
        notes.push(Note::ColourChunks("ICC profile".to_owned()));
    }
    if matches!(colours, Colours::Cmyk | Colours::Ycck) {
        notes.push(Note::Inks);
    }
    Ok(Decoded::without_guides(frame, notes, options))
}

/// The size that a file declares.
///
/// # Errors
/// When its header is damaged, or of a kind that is not supported.
pub(crate) fn size(mut file: impl BufRead + Seek) -> Result<(usize, usize)> {
    /// Bytes that hold most headers, and those with thumbnails and profiles.
    const USUAL: [u64; 2] = [64 << 10, 4 << 20];
    let mut bytes = Vec::new();
    for part in USUAL {
        file.by_ref().take(part).read_to_end(&mut bytes)?;
        if let Ok(head) = Head::read(&bytes) {
            return Ok((head.frame.width, head.frame.height));
        }
    }
    file.take(MAX_BYTES).read_to_end(&mut bytes)?;
    let head = Head::read(&bytes)?;
    Ok((head.frame.width, head.frame.height))
}
