//! PNG with 8 and 16 bits (fewer bits are widened): gray, RGB, palette, alpha, interlaced.

mod chunks;
mod samples;

use std::io::{BufRead, ErrorKind, Seek};

use fovqa_frame::{Channels, Frame};
use png::{BitDepth, ColorType, DecodeOptions, Decoder, DecodingError, Limits, Transformations};

use crate::decoded::Decoded;
use crate::error::ReadErrorKind;
use crate::exif::is_turned;
use crate::note::Note;
use crate::read_options::ReadOptions;
use chunks::Chunks;
use samples::samples;

/// Memory that a PNG may need besides its picture and its Exif data, in bytes.
const SMALL_THINGS_BYTES: u64 = 32 << 20;
/// Bytes per pixel of a row, enough for a few rows of the widest pixels.
const ROWS_BYTES_A_PIXEL: u64 = 64;
/// The decoder allocates up to twice the size of the chunk.
const EXIF_ROOM: u64 = 2;

/// Reads a file.
///
/// # Errors
/// When it is damaged or too large, or the options do not allow its alpha.
pub(crate) fn read(
    mut file: impl BufRead + Seek,
    options: &ReadOptions,
) -> Result<Decoded, ReadErrorKind> {
    let (width, height) = size(&mut file)?;
    options.check_size(width as u64, height as u64)?;
    let chunks = Chunks::read(&mut file)?;
    file.rewind()?;
    let mut reading = DecodeOptions::default();
    // Chunks that do not concern pixels are skipped and may have any length.
    reading.set_ignore_text_chunk(true);
    reading.set_ignore_iccp_chunk(true);
    let mut decoder = Decoder::new_with_options(file, reading);
    // The limit covers rows and small chunks only: the buffer of the picture is ours, and its size
    // has been checked.
    let bytes = SMALL_THINGS_BYTES
        .saturating_add(width as u64 * ROWS_BYTES_A_PIXEL)
        .saturating_add(chunks.exif_bytes.saturating_mul(EXIF_ROOM));
    decoder.set_limits(Limits { bytes: usize::try_from(bytes).unwrap_or(usize::MAX) });
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let (colour, depth) = reader.output_color_type();
    let (channels, has_alpha) = match colour {
        ColorType::Grayscale => (Channels::Gray, false),
        ColorType::GrayscaleAlpha => (Channels::Gray, true),
        ColorType::Rgb => (Channels::Rgb, false),
        ColorType::Rgba => (Channels::Rgb, true),
        ColorType::Indexed => return Err(unexpected("its palette is missing")),
    };
    let length = reader.output_buffer_size().ok_or_else(|| unexpected("it is too large"))?;
    let samples = match depth {
        BitDepth::Sixteen => {
            let mut codes = vec![0u16; length / 2];
            reader.next_frame(bytemuck::cast_slice_mut(&mut codes)).map_err(damaged)?;
            for code in &mut codes {
                *code = u16::from_be(*code);
            }
            samples(codes, channels, has_alpha, width, options.alpha)?
        }
        BitDepth::Eight => {
            let mut codes = vec![0u8; length];
            reader.next_frame(&mut codes).map_err(damaged)?;
            samples(codes, channels, has_alpha, width, options.alpha)?
        }
        other => return Err(unexpected(&format!("its samples have {} bits", other as u8))),
    };
    let frame = Frame::new(width, height, channels, samples)
        .map_err(|error| unexpected(&error.to_string()))?
        .encoded();
    // Exif data may also follow after the pixels. Other errors there do not matter, and further
    // frames of an animation are not read.
    if reader.info().animation_control.is_none() {
        let _ = reader.finish();
    }
    let mut notes = Vec::new();
    if reader.info().exif_metadata.as_ref().is_some_and(|exif| is_turned(exif)) {
        notes.push(Note::Orientation);
    }
    if !chunks.colour.is_empty() {
        notes.push(Note::ColourChunks(chunks.colour.join(", ")));
    }
    Ok(Decoded::without_guides(frame, notes, options))
}

/// The size that a file declares.
///
/// # Errors
/// When its header is damaged.
pub(crate) fn size(mut file: impl BufRead + Seek) -> Result<(usize, usize), ReadErrorKind> {
    file.rewind()?;
    let mut decoder = Decoder::new(file);
    let (width, height) = decoder.read_header_info().map_err(damaged)?.size();
    Ok((width as usize, height as usize))
}

fn unexpected(detail: &str) -> ReadErrorKind {
    ReadErrorKind::Damaged { format: "PNG", detail: detail.to_owned() }
}

fn damaged(error: DecodingError) -> ReadErrorKind {
    match error {
        DecodingError::IoError(error) if error.kind() != ErrorKind::UnexpectedEof => {
            ReadErrorKind::Io(error)
        }
        error => unexpected(&error.to_string()),
    }
}
