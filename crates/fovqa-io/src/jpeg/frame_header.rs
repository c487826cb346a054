//! The frame header (ITU-T T.81, B.2.2): size, components and their sampling.

use super::error::{Result, damaged, not_read};
use super::kind::JpegKind;
use super::segments::{marker, u16_at};

/// The side of a block in samples.
pub(super) const BLOCK: usize = 8;

/// The coding of coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coding {
    /// All coefficients of a block at once: baseline and extended sequential.
    Sequential,
    /// Coefficients in several scans.
    Progressive,
}

/// One component: gray, a colour, luma or chroma, or an ink.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Component {
    pub(super) id: u8,
    /// Horizontal and vertical sampling factor, 1 to 4.
    pub(super) factors: (usize, usize),
    /// The number of its quantisation table, 0 to 3.
    pub(super) quantisation: usize,
    /// The number of samples across and down.
    pub(super) size: (usize, usize),
    /// The number of blocks, across and down, that hold at least one of these samples.
    pub(super) blocks: (usize, usize),
}

/// The content of the frame header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FrameHeader {
    pub(super) coding: Coding,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) components: Vec<Component>,
    /// The largest sampling factors.
    pub(super) largest: (usize, usize),
}

/// Whether a marker starts a frame of any kind.
pub(super) fn starts_frame(marker: u8) -> bool {
    match marker {
        marker::DHT | marker::JPG | marker::DAC => false,
        marker::DHP | marker::EXP | marker::SOF55 => true,
        _ => (marker::SOF0..=marker::SOF15).contains(&marker),
    }
}

/// The coding that a marker stands for.
fn coding(marker: u8) -> Result<Coding> {
    let kind = match marker {
        marker::SOF0 | marker::SOF1 => return Ok(Coding::Sequential),
        marker::SOF2 => return Ok(Coding::Progressive),
        marker::SOF3 => JpegKind::Lossless,
        marker::SOF55 => JpegKind::JpegLs,
        // SOF9 to SOF11. The kinds from SOF13 on are differential too.
        0xc9..=0xcb => JpegKind::Arithmetic,
        _ => JpegKind::Hierarchical,
    };
    Err(not_read(kind))
}

impl FrameHeader {
    /// Reads the header. Its height may be 0 and then follows after the first scan.
    ///
    /// # Errors
    /// When its kind is not supported, or it contradicts itself.
    pub(super) fn parse(marker: u8, data: &[u8]) -> Result<Self> {
        let coding = coding(marker)?;
        let short = || damaged("its frame header has a wrong length");
        let (&[bits, ..], Some(height), Some(width)) = (data, u16_at(data, 1), u16_at(data, 3))
        else {
            return Err(short());
        };
        let count = usize::from(*data.get(5).ok_or_else(short)?);
        if data.len() != 6 + 3 * count {
            return Err(short());
        }
        if bits != 8 {
            return Err(not_read(JpegKind::Precision { bits }));
        }
        if width == 0 {
            return Err(damaged("its frame header declares a width of 0"));
        }
        if !matches!(count, 1 | 3 | 4) {
            return Err(not_read(JpegKind::Components { count }));
        }
        let mut components = Vec::with_capacity(count);
        for bytes in data[6..].as_chunks::<3>().0 {
            let factors = (usize::from(bytes[1] >> 4), usize::from(bytes[1] & 15));
            let quantisation = usize::from(bytes[2]);
            let valid = 1..=4;
            if !valid.contains(&factors.0) || !valid.contains(&factors.1) || quantisation > 3 {
                return Err(damaged(format!(
                    "its frame header gives component {} the sampling {}x{} and quantisation table {quantisation}",
                    bytes[0], factors.0, factors.1
                )));
            }
            let (size, blocks) = ((0, 0), (0, 0));
            components.push(Component { id: bytes[0], factors, quantisation, size, blocks });
        }
        let largest = components.iter().fold((1, 1), |(h, v), component| {
            (h.max(component.factors.0), v.max(component.factors.1))
        });
        for Component { factors, .. } in &components {
            if !largest.0.is_multiple_of(factors.0) || !largest.1.is_multiple_of(factors.1) {
                return Err(not_read(JpegKind::Sampling { factors: *factors, largest }));
            }
        }
        let (width, height) = (usize::from(width), usize::from(height));
        let mut header = Self { coding, width, height: 0, components, largest };
        header.set_height(height);
        Ok(header)
    }

    /// Sets the height once it is known, which for some files is only after the first scan.
    pub(super) fn set_height(&mut self, height: usize) {
        self.height = height;
        let (max_h, max_v) = self.largest;
        for component in &mut self.components {
            let (h, v) = component.factors;
            component.size = ((self.width * h).div_ceil(max_h), (height * v).div_ceil(max_v));
            component.blocks = (component.size.0.div_ceil(BLOCK), component.size.1.div_ceil(BLOCK));
        }
    }

    /// The number of units of an interleaved scan across and down.
    pub(super) fn units(&self) -> (usize, usize) {
        let (max_h, max_v) = self.largest;
        (self.width.div_ceil(BLOCK * max_h), self.height.div_ceil(BLOCK * max_v))
    }

    /// Refuses a size that cannot fit into this number of bytes, before memory is allocated. Each
    /// block takes at least one bit in a progressive file (for its mean), and two in a sequential
    /// one.
    pub(super) fn check_length(&self, bytes: usize) -> Result<()> {
        let blocks: usize = self.components.iter().map(|c| c.blocks.0 * c.blocks.1).sum();
        let bits_per_block = match self.coding {
            Coding::Sequential => 2,
            Coding::Progressive => 1,
        };
        if blocks.saturating_mul(bits_per_block) > bytes.saturating_mul(8) {
            let Self { width, height, .. } = self;
            return Err(damaged(format!(
                "it is too short for the {width}x{height} pixels that it declares"
            )));
        }
        Ok(())
    }
}
