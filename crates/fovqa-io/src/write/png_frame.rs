//! Codes as PNG.

use fovqa_frame::{Channels, Frame};
use png::{BitDepth, ColorType, Compression, Encoder};

use super::visible::interleaved;

/// A PNG file with 8 bits per sample.
pub(super) fn codes8(frame: &Frame, codes: &[u8]) -> Result<Vec<u8>, String> {
    encode(frame, BitDepth::Eight, &interleaved(frame, codes))
}

/// A PNG file with 16 bits per sample.
pub(super) fn codes16(frame: &Frame, codes: &[u16]) -> Result<Vec<u8>, String> {
    let bytes: Vec<u8> =
        interleaved(frame, codes).iter().flat_map(|code| code.to_be_bytes()).collect();
    encode(frame, BitDepth::Sixteen, &bytes)
}

fn encode(frame: &Frame, depth: BitDepth, bytes: &[u8]) -> Result<Vec<u8>, String> {
    let side = |side: usize| u32::try_from(side).map_err(|error| error.to_string());
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, side(frame.width())?, side(frame.height())?);
    encoder.set_color(match frame.channels() {
        Channels::Gray => ColorType::Grayscale,
        Channels::Rgb => ColorType::Rgb,
    });
    encoder.set_depth(depth);
    encoder.set_compression(Compression::Fast);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(bytes).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(file)
}
