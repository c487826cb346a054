//! PNG files, whole and broken.

use std::path::Path;

use image::ExtendedColorType;

/// Writes interleaved 8-bit codes of 1 (gray), 2 (gray, alpha), 3 (RGB) or 4 (RGBA) channels; the
/// ending of the path tells PNG from JPEG.
///
/// # Panics
/// When the codes do not fit the size, or the file cannot be written.
pub fn write8(path: &Path, width: usize, height: usize, codes: &[u8]) {
    let colour = match codes.len() / (width * height) {
        1 => ExtendedColorType::L8,
        2 => ExtendedColorType::La8,
        3 => ExtendedColorType::Rgb8,
        _ => ExtendedColorType::Rgba8,
    };
    image::save_buffer(path, codes, width as u32, height as u32, colour).expect("a writable path");
}

/// Writes interleaved 16-bit codes of 1 (gray) or 3 (RGB) channels.
///
/// # Panics
/// When the codes do not fit the size, or the file cannot be written.
pub fn write16(path: &Path, width: usize, height: usize, codes: &[u16]) {
    let colour = match codes.len() / (width * height) {
        1 => ExtendedColorType::L16,
        _ => ExtendedColorType::Rgb16,
    };
    let bytes: Vec<u8> = codes.iter().flat_map(|code| code.to_ne_bytes()).collect();
    image::save_buffer(path, &bytes, width as u32, height as u32, colour).expect("a writable path");
}

/// A PNG whose header declares a size and whose picture is missing.
pub fn header_only(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = Vec::new();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([8, 2, 0, 0, 0]);
    bytes.extend(chunk(*b"IHDR", &header));
    bytes
}

/// The file with a chunk put in behind its header.
pub fn with_chunk(png: &[u8], name: [u8; 4], data: &[u8]) -> Vec<u8> {
    const HEADER_END: usize = 8 + 12 + 13;
    let mut bytes = png[..HEADER_END].to_vec();
    bytes.extend(chunk(name, data));
    bytes.extend(&png[HEADER_END..]);
    bytes
}

/// A chunk: length, name, data, checksum.
pub fn chunk(name: [u8; 4], data: &[u8]) -> Vec<u8> {
    let mut bytes = (data.len() as u32).to_be_bytes().to_vec();
    bytes.extend(name);
    bytes.extend(data);
    bytes.extend(crc32(&bytes[4..]).to_be_bytes());
    bytes
}

/// The checksum of PNG (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
        }
    }
    !crc
}
