//! PNG and JPEG, through the `image` crate.

use std::io::{BufRead, Read, Seek, SeekFrom};

use fovqa_frame::{Channels, Frame, Samples};
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::metadata::Orientation;
use image::{ColorType, ImageDecoder, ImageError, ImageReader, Limits};

use crate::alpha::{AlphaPolicy, require_opaque};
use crate::decode::{Decoded, Note, ReadOptions};
use crate::error::ReadErrorKind;

/// A JPEG is read whole; this is four bytes a pixel of the largest one by default.
const MAX_JPEG_BYTES: u64 = 1 << 30;

/// Memory a PNG may ask for beside its picture.
const SMALL_THINGS_BYTES: u64 = 32 << 20;
/// A few rows of the widest pixels.
const ROWS_BYTES_A_PIXEL: u64 = 64;

pub(crate) fn read_png(
    mut file: impl BufRead + Seek,
    options: &ReadOptions,
) -> Result<Decoded, ReadErrorKind> {
    let (width, height) = png_size(&mut file)?;
    options.check_size(width, height)?;
    let chunks = png_colour_chunks(&mut file)?;
    file.rewind()?;
    // Rows and small things: the picture's own buffer is ours, and its size has been checked. A
    // colour profile that inflates beyond this is dropped, as it would be anyway.
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(SMALL_THINGS_BYTES + width * ROWS_BYTES_A_PIXEL);
    let decoder = PngDecoder::with_limits(file, limits).map_err(|e| damaged("PNG", e))?;
    let mut decoded = read_samples("PNG", decoder, options)?;
    if !chunks.is_empty() {
        decoded.notes.push(Note::ColourChunks(chunks.join(", ")));
    }
    Ok(decoded)
}

pub(crate) fn read_jpeg(
    mut file: impl BufRead + Seek,
    options: &ReadOptions,
) -> Result<Decoded, ReadErrorKind> {
    let mut bytes = Vec::new();
    file.by_ref().take(MAX_JPEG_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_JPEG_BYTES {
        let detail = "it is longer than any picture of its kind, 1 GiB".to_owned();
        return Err(ReadErrorKind::Damaged { format: "JPEG", detail });
    }
    if !jpeg_is_whole(&bytes) {
        let detail = "its end-of-image marker is missing".to_owned();
        return Err(ReadErrorKind::Damaged { format: "JPEG", detail });
    }
    let mut decoder =
        JpegDecoder::new(std::io::Cursor::new(&bytes)).map_err(|e| damaged("JPEG", e))?;
    let (width, height) = decoder.dimensions();
    options.check_size(width.into(), height.into())?;
    let turned = decoder.orientation().is_ok_and(|o| o != Orientation::NoTransforms);
    let profile = decoder.icc_profile().is_ok_and(|p| p.is_some());
    let mut decoded = read_samples("JPEG", decoder, options)?;
    if turned {
        decoded.notes.push(Note::Orientation);
    }
    if profile {
        decoded.notes.push(Note::ColourChunks("ICC profile".to_owned()));
    }
    Ok(decoded)
}

/// The size a PNG or JPEG declares.
pub(crate) fn size(file: impl BufRead + Seek) -> Result<(usize, usize), ReadErrorKind> {
    let reader = ImageReader::new(file).with_guessed_format()?;
    let (width, height) = reader.into_dimensions().map_err(|e| damaged("image", e))?;
    Ok((width as usize, height as usize))
}

fn damaged(format: &'static str, error: ImageError) -> ReadErrorKind {
    match error {
        ImageError::IoError(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => {
            ReadErrorKind::Io(error)
        }
        error => ReadErrorKind::Damaged { format, detail: error.to_string() },
    }
}

fn read_samples(
    format: &'static str,
    decoder: impl ImageDecoder,
    options: &ReadOptions,
) -> Result<Decoded, ReadErrorKind> {
    let (width, height) = decoder.dimensions();
    let colour = decoder.color_type();
    let (colours, has_alpha) = match colour {
        ColorType::L8 | ColorType::L16 => (1, false),
        ColorType::La8 | ColorType::La16 => (1, true),
        ColorType::Rgb8 | ColorType::Rgb16 => (3, false),
        ColorType::Rgba8 | ColorType::Rgba16 => (3, true),
        other => {
            let detail = format!("its pixels are of an unexpected type, {other:?}");
            return Err(ReadErrorKind::Damaged { format, detail });
        }
    };
    let width = width as usize;
    let length = decoder.total_bytes() as usize;
    let samples = if colour.bytes_per_pixel() / colour.channel_count() == 2 {
        let mut codes = vec![0u16; length / 2];
        let bytes = bytemuck::cast_slice_mut(&mut codes);
        decoder.read_image(bytes).map_err(|e| damaged(format, e))?;
        Samples::U16(without_alpha(codes, colours, has_alpha, width, options.alpha)?)
    } else {
        let mut codes = vec![0u8; length];
        decoder.read_image(&mut codes).map_err(|e| damaged(format, e))?;
        Samples::U8(without_alpha(codes, colours, has_alpha, width, options.alpha)?)
    };
    let channels = if colours == 1 { Channels::Gray } else { Channels::Rgb };
    let frame = Frame::new(width, height as usize, channels, samples)
        .map_err(|e| ReadErrorKind::Damaged { format, detail: e.to_string() })?;
    Ok(Decoded::without_guides(frame, Vec::new(), options))
}

/// A code of 8 or 16 bits.
trait Code: Copy + Into<u32> + TryFrom<u32> {
    const MAX: u32;
}

impl Code for u8 {
    const MAX: u32 = 255;
}

impl Code for u16 {
    const MAX: u32 = 65535;
}

fn without_alpha<T: Code>(
    mut codes: Vec<T>,
    colours: usize,
    has_alpha: bool,
    width: usize,
    policy: AlphaPolicy,
) -> Result<Vec<T>, ReadErrorKind> {
    if !has_alpha {
        return Ok(codes);
    }
    let stride = colours + 1;
    let pixels = codes.len() / stride;
    if policy == AlphaPolicy::Error {
        let alpha = codes.chunks_exact(stride).map(|p| p[colours].into());
        require_opaque(alpha.map(|a: u32| a as f32 / T::MAX as f32), width)?;
    }
    for i in 0..pixels {
        let alpha: u32 = codes[i * stride + colours].into();
        for c in 0..colours {
            let mut code = codes[i * stride + c];
            if policy == AlphaPolicy::OverBlack {
                let value: u32 = code.into();
                let over = (u64::from(value) * u64::from(alpha) + u64::from(T::MAX) / 2)
                    / u64::from(T::MAX);
                // A product of two shares is a share: it always fits.
                code = T::try_from(over as u32).unwrap_or(code);
            }
            codes[i * colours + c] = code;
        }
    }
    codes.truncate(pixels * colours);
    Ok(codes)
}

const PNG_CHUNKS_FROM: u64 = 8;

fn read_u32(file: &mut impl Read) -> std::io::Result<u32> {
    let mut bytes = [0; 4];
    file.read_exact(&mut bytes)?;
    Ok(u32::from_be_bytes(bytes))
}

/// Width and height from the header chunk, which always comes first.
fn png_size(file: &mut (impl Read + Seek)) -> Result<(u64, u64), ReadErrorKind> {
    const LENGTH_AND_NAME: u64 = 8;
    file.seek(SeekFrom::Start(PNG_CHUNKS_FROM + LENGTH_AND_NAME))?;
    let mut size = || read_u32(file).map(u64::from);
    match (size(), size()) {
        (Ok(width), Ok(height)) => Ok((width, height)),
        (Err(e), _) | (_, Err(e)) => {
            Err(ReadErrorKind::Damaged { format: "PNG", detail: format!("no header: {e}") })
        }
    }
}

/// The colour chunks that would change the picture if they were applied. gAMA beside an sRGB
/// chunk says the same as that, and so does a cICP of sRGB.
fn png_colour_chunks(file: &mut (impl Read + Seek)) -> Result<Vec<&'static str>, ReadErrorKind> {
    const SRGB_CICP: [u8; 4] = [1, 13, 0, 1];
    let (mut found, mut srgb) = (Vec::new(), false);
    file.seek(SeekFrom::Start(PNG_CHUNKS_FROM))?;
    loop {
        let mut name = [0; 4];
        let Ok(length) = read_u32(file) else { break };
        if file.read_exact(&mut name).is_err() {
            break;
        }
        match &name {
            b"IDAT" | b"IEND" => break,
            b"sRGB" => srgb = true,
            b"gAMA" => found.push("gAMA"),
            b"iCCP" => found.push("iCCP"),
            b"cICP" => {
                let mut code = [0; 4];
                if file.read_exact(&mut code).is_err() || code != SRGB_CICP {
                    found.push("cICP");
                }
                file.seek_relative(-4)?;
            }
            _ => {}
        }
        // Relative, so that a reader's buffer stays what it is; over data and checksum.
        file.seek_relative(i64::from(length) + 4)?;
    }
    found.retain(|name| !(srgb && *name == "gAMA"));
    Ok(found)
}

/// Whether the picture's own end marker is there. The decoder fills what is missing with gray
/// and says nothing; a thumbnail's end marker, in front of the scan, does not count.
fn jpeg_is_whole(bytes: &[u8]) -> bool {
    const START_OF_SCAN: u8 = 0xda;
    const END_OF_IMAGE: [u8; 2] = [0xff, 0xd9];
    let mut at = 2;
    while let Some(&[0xff, marker, high, low]) = bytes.get(at..at + 4) {
        if marker == START_OF_SCAN {
            return bytes[at..].windows(2).any(|pair| pair == END_OF_IMAGE);
        }
        if marker == 0xff {
            at += 1; // a fill byte
        } else {
            at += 2 + usize::from(u16::from_be_bytes([high, low]));
        }
    }
    false
}
