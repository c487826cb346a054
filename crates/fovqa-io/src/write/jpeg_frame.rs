//! Codes as JPEG, at the best quality and with a chroma sample for each pixel (4:4:4).

use fovqa_frame::{Channels, Frame};
use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;

use super::visible::interleaved;

/// Quality from 1 to 100: all quantisation steps are 1.
const QUALITY: u8 = 100;

/// A JPEG file.
pub(super) fn codes8(frame: &Frame, size: [u16; 2], codes: &[u8]) -> Result<Vec<u8>, String> {
    let colour = match frame.channels() {
        Channels::Gray => ExtendedColorType::L8,
        Channels::Rgb => ExtendedColorType::Rgb8,
    };
    let [width, height] = size.map(u32::from);
    let mut file = Vec::new();
    // This encoder does not subsample chroma.
    let mut encoder = JpegEncoder::new_with_quality(&mut file, QUALITY);
    encoder
        .encode(&interleaved(frame, codes), width, height, colour)
        .map_err(|error| error.to_string())?;
    Ok(file)
}
