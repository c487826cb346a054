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

/// A palette PNG: one index a pixel, 8 bits, with the colours' alpha where it is given.
pub fn palette(
    width: usize,
    height: usize,
    indices: &[u8],
    colours: &[[u8; 3]],
    alpha: &[u8],
) -> Vec<u8> {
    const PALETTE: u8 = 3;
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = Vec::new();
    header.extend((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    header.extend([8, PALETTE, 0, 0, 0]);
    bytes.extend(chunk(*b"IHDR", &header));
    bytes.extend(chunk(*b"PLTE", colours.as_flattened()));
    if !alpha.is_empty() {
        bytes.extend(chunk(*b"tRNS", alpha));
    }
    // Every row unfiltered; all rows in stored blocks of deflate (RFC 1951, 3.2.4).
    let rows: Vec<u8> = indices.chunks_exact(width).flat_map(|row| [&[0], row].concat()).collect();
    let mut data = vec![0x78, 0x01];
    let blocks = rows.chunks(usize::from(u16::MAX));
    let last = blocks.len() - 1;
    for (i, block) in blocks.enumerate() {
        let length = block.len() as u16;
        data.push(u8::from(i == last));
        data.extend(length.to_le_bytes());
        data.extend((!length).to_le_bytes());
        data.extend(block);
    }
    data.extend(adler32(&rows).to_be_bytes());
    bytes.extend(chunk(*b"IDAT", &data));
    bytes.extend(chunk(*b"IEND", &[]));
    bytes
}

/// The checksum of zlib (RFC 1950, 9).
fn adler32(bytes: &[u8]) -> u32 {
    const MODULUS: u32 = 65521;
    let (a, b) = bytes.iter().fold((1, 0), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % MODULUS;
        (a, (a + b) % MODULUS)
    });
    b << 16 | a
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
