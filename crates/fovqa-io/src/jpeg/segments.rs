//! The markers of a JPEG file and their segments (ITU-T T.81, B.1.1).

use super::error::{Result, damaged};

/// Codes of markers, without the byte 0xFF in front.
pub(super) mod marker {
    pub(in crate::jpeg) const TEM: u8 = 0x01;
    pub(in crate::jpeg) const SOF0: u8 = 0xc0;
    pub(in crate::jpeg) const SOF1: u8 = 0xc1;
    pub(in crate::jpeg) const SOF2: u8 = 0xc2;
    pub(in crate::jpeg) const SOF3: u8 = 0xc3;
    pub(in crate::jpeg) const DHT: u8 = 0xc4;
    pub(in crate::jpeg) const JPG: u8 = 0xc8;
    pub(in crate::jpeg) const DAC: u8 = 0xcc;
    pub(in crate::jpeg) const SOF15: u8 = 0xcf;
    pub(in crate::jpeg) const RST0: u8 = 0xd0;
    pub(in crate::jpeg) const RST7: u8 = 0xd7;
    pub(in crate::jpeg) const SOI: u8 = 0xd8;
    pub(in crate::jpeg) const EOI: u8 = 0xd9;
    pub(in crate::jpeg) const SOS: u8 = 0xda;
    pub(in crate::jpeg) const DQT: u8 = 0xdb;
    pub(in crate::jpeg) const DNL: u8 = 0xdc;
    pub(in crate::jpeg) const DRI: u8 = 0xdd;
    pub(in crate::jpeg) const DHP: u8 = 0xde;
    pub(in crate::jpeg) const EXP: u8 = 0xdf;
    pub(in crate::jpeg) const APP0: u8 = 0xe0;
    pub(in crate::jpeg) const APP1: u8 = 0xe1;
    pub(in crate::jpeg) const APP2: u8 = 0xe2;
    pub(in crate::jpeg) const APP14: u8 = 0xee;
    pub(in crate::jpeg) const APP15: u8 = 0xef;
    pub(in crate::jpeg) const SOF55: u8 = 0xf7;
    pub(in crate::jpeg) const COM: u8 = 0xfe;
}

/// A marker and its parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment<'a> {
    pub(super) marker: u8,
    /// The parameters without the two bytes of the length.
    pub(super) data: &'a [u8],
}

/// Reads a file from marker to marker.
#[derive(Debug, Clone)]
pub(super) struct Segments<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Segments<'a> {
    /// Starts at the first byte of a file.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The bytes after the last segment.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Skips entropy-coded data.
    pub(super) fn skip(&mut self, bytes: usize) {
        self.at += bytes;
    }

    /// Reads the next marker with its parameters.
    ///
    /// # Errors
    /// When the file ends before the end of the segment, or the next bytes are not a marker.
    pub(super) fn next(&mut self) -> Result<Segment<'a>> {
        let marker = self.next_marker()?;
        if matches!(marker, marker::TEM | marker::RST0..=marker::EOI) {
            return Ok(Segment { marker, data: &[] });
        }
        let cut = || damaged("it ends within its headers; the end-of-image marker is missing");
        let &[high, low, ..] = self.rest() else { return Err(cut()) };
        let length = usize::from(u16::from_be_bytes([high, low]));
        if length < 2 {
            return Err(damaged(format!("the segment 0xFF{marker:02X} has a length of {length}")));
        }
        let data = self.rest().get(2..length).ok_or_else(cut)?;
        self.at += length;
        Ok(Segment { marker, data })
    }

    fn next_marker(&mut self) -> Result<u8> {
        let rest = self.rest();
        if rest.first().is_some_and(|byte| *byte != 0xff) {
            let bytes = rest.iter().position(|byte| *byte == 0xff).unwrap_or(rest.len());
            return Err(damaged(format!("{bytes} extraneous bytes precede a marker")));
        }
        // A marker's code may follow any number of fill bytes.
        let Some(fill) = rest.iter().position(|byte| *byte != 0xff) else {
            return Err(damaged("its end-of-image marker is missing"));
        };
        let code = rest[fill];
        if code == 0 {
            return Err(damaged("entropy-coded data is where a marker should be"));
        }
        self.at += fill + 1;
        Ok(code)
    }
}

/// The big-endian 16-bit number at a position of a segment.
pub(super) fn u16_at(data: &[u8], at: usize) -> Option<u16> {
    let bytes = data.get(at..at + 2)?;
    Some(u16::from_be_bytes([bytes[0], bytes[1]]))
}
