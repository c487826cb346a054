//! The PNG chunks in front of the pixels that define the meaning of the colours.

use std::io::{Read, Seek, SeekFrom};

/// Length of the signature in bytes; chunks follow.
const SIGNATURE: u64 = 8;
/// The length in bytes of a chunk's length field, its name, and its checksum.
const LENGTH: usize = 4;
const CHECKSUM: i64 = 4;

/// The content of the chunks in front of the pixels.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Chunks {
    /// Names of the chunks that would change the image if they were applied.
    pub(super) colour: Vec<&'static str>,
    /// The size of the Exif data in bytes.
    pub(super) exif_bytes: u64,
}

/// The values of sRGB in units of 1/100,000 (PNG, 11.3.2.1 and 11.3.2.2): the gamma, and x and y of
/// white, red, green and blue.
const SRGB_GAMMA: u32 = 45_455;
const SRGB_CHROMATICITIES: [u32; 8] =
    [31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000];
/// Colour primaries, transfer function, matrix and range of sRGB (ITU-T H.273).
const SRGB_CODE_POINTS: [u8; 4] = [1, 13, 0, 1];

/// Whether a number equals that of sRGB, with a tolerance because programs round it differently.
fn is_near(value: u32, srgb: u32, tolerance: u32) -> bool {
    value.abs_diff(srgb) <= tolerance
}

fn is_srgb_gamma(data: &[u8]) -> bool {
    const TOLERANCE: u32 = 5;
    data.first_chunk()
        .is_some_and(|gamma| is_near(u32::from_be_bytes(*gamma), SRGB_GAMMA, TOLERANCE))
}

fn are_srgb_chromaticities(data: &[u8]) -> bool {
    const TOLERANCE: u32 = 100;
    let values = data.as_chunks::<4>().0.iter().map(|value| u32::from_be_bytes(*value));
    data.len() == 4 * SRGB_CHROMATICITIES.len()
        && values.zip(SRGB_CHROMATICITIES).all(|(value, srgb)| is_near(value, srgb, TOLERANCE))
}

impl Chunks {
    /// Reads up to the pixels. Truncated files are reported later, by the decoder.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub(super) fn read(file: &mut (impl Read + Seek)) -> std::io::Result<Self> {
        /// The largest chunk whose content is read, in bytes.
        const LARGEST: usize = 32;
        let mut found = Self::default();
        let mut is_srgb = false;
        file.seek(SeekFrom::Start(SIGNATURE))?;
        loop {
            let (mut length, mut name) = ([0; LENGTH], [0; 4]);
            if file.read_exact(&mut length).is_err() || file.read_exact(&mut name).is_err() {
                break;
            }
            let length = u32::from_be_bytes(length);
            let mut data = Vec::new();
            if matches!(&name, b"gAMA" | b"cHRM" | b"cICP") {
                file.by_ref().take(u64::from(length).min(LARGEST as u64)).read_to_end(&mut data)?;
            }
            match &name {
                b"IDAT" | b"IEND" => break,
                b"sRGB" => is_srgb = true,
                b"cICP" if data.starts_with(&SRGB_CODE_POINTS) => is_srgb = true,
                b"cICP" => found.colour.push("cICP"),
                b"iCCP" => found.colour.push("iCCP"),
                b"gAMA" if !is_srgb_gamma(&data) => found.colour.push("gAMA"),
                b"cHRM" if !are_srgb_chromaticities(&data) => found.colour.push("cHRM"),
                b"eXIf" => found.exif_bytes += u64::from(length),
                _ => {}
            }
            // The seek is relative, so that it does not discard the reader's buffer.
            file.seek_relative(i64::from(length) - data.len() as i64 + CHECKSUM)?;
        }
        // These two chunks count only if there is no sRGB chunk.
        found.colour.retain(|name| !(is_srgb && matches!(*name, "gAMA" | "cHRM")));
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use fovqa_testkit::png_files::{chunk, header_only};

    use super::*;

    fn found(chunks: &[([u8; 4], &[u8])]) -> Vec<&'static str> {
        let mut file = header_only(1, 1);
        for (name, data) in chunks {
            file.extend(chunk(*name, data));
        }
        file.extend(chunk(*b"IDAT", &[]));
        file.extend(chunk(*b"iCCP", &[]));
        Chunks::read(&mut Cursor::new(file)).unwrap().colour
    }

    fn chromaticities(values: [u32; 8]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_be_bytes()).collect()
    }

    #[test]
    fn srgb_in_other_words_is_srgb() {
        let gamma = SRGB_GAMMA.to_be_bytes();
        let other_gamma = 100_000u32.to_be_bytes();
        let own = chromaticities(SRGB_CHROMATICITIES);
        let rounded =
            chromaticities([31_269, 32_899, 63_999, 33_001, 30_000, 60_000, 15_000, 5_999]);
        // Display P3.
        let other = chromaticities([31_270, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6_000]);
        let none: [&str; 0] = [];
        assert_eq!(found(&[(*b"gAMA", &gamma)]), none);
        assert_eq!(found(&[(*b"gAMA", &gamma), (*b"cHRM", &own)]), none);
        assert_eq!(found(&[(*b"cHRM", &rounded), (*b"gAMA", &gamma)]), none);
        assert_eq!(found(&[(*b"cHRM", &other), (*b"gAMA", &gamma)]), ["cHRM"]);
        assert_eq!(found(&[(*b"gAMA", &other_gamma), (*b"cHRM", &own)]), ["gAMA"]);
        assert_eq!(found(&[(*b"gAMA", &other_gamma), (*b"cHRM", &other)]), ["gAMA", "cHRM"]);
        for srgb in [(*b"sRGB", &[0][..]), (*b"cICP", &SRGB_CODE_POINTS)] {
            assert_eq!(found(&[(*b"gAMA", &other_gamma), srgb, (*b"cHRM", &other)]), none);
        }
        assert_eq!(found(&[(*b"cICP", &[9, 16, 0, 1]), (*b"iCCP", &[0; 99])]), ["cICP", "iCCP"]);
        assert_eq!(found(&[(*b"mDCV", &[0; 24]), (*b"cLLI", &[0; 8])]), none);
    }
}
