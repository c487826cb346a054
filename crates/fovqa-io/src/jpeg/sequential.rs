//! Blocks of sequential scans (ITU-T T.81, F.2.2).

use super::bits::Bits;
use super::error::{Result, damaged};
use super::huffman::Huffman;
use super::quantisation::{COEFFICIENTS, ZIGZAG};
use crate::error::ReadErrorKind;

/// The coefficients of a block, row by row, before the multiplication by their steps.
pub(super) type Coefficients = [i16; COEFFICIENTS];

/// Decodes the next mean from its difference to the one before. Its lowest bit is bit `low`.
#[inline(always)]
pub(super) fn mean(bits: &mut Bits<'_>, table: &Huffman, before: &mut i32, low: u8) -> Result<i16> {
    let size = bits.symbol(table)?;
    *before += bits.value(size);
    if before.abs() >= 1 << 15 {
        return Err(impossible());
    }
    i16::try_from(*before << low).map_err(|_| impossible())
}

/// Decodes a block into coefficients that are all 0.
#[inline(always)]
pub(super) fn block(
    bits: &mut Bits<'_>,
    dc: &Huffman,
    ac: &Huffman,
    before: &mut i32,
    out: &mut Coefficients,
) -> Result<()> {
    /// The symbol for sixteen zeros without a value.
    const ZEROS: u8 = 0xf0;
    const END: u8 = 0;
    out[0] = mean(bits, dc, before, 0)?;
    let mut k = 1;
    while k < COEFFICIENTS {
        let symbol = bits.symbol(ac)?;
        let (zeros, size) = (usize::from(symbol >> 4), symbol & 15);
        if size == 0 {
            match symbol {
                END => break,
                ZEROS if k + 16 <= COEFFICIENTS => k += 16,
                _ => return Err(beyond_block()),
            }
            continue;
        }
        k += zeros;
        let place = *ZIGZAG.get(k).ok_or_else(beyond_block)?;
        out[usize::from(place)] = bits.value(size) as i16;
        k += 1;
    }
    bits.check()
}

#[cold]
pub(super) fn beyond_block() -> ReadErrorKind {
    damaged("its data contains a run of coefficients beyond the end of a block")
}

#[cold]
pub(super) fn impossible() -> ReadErrorKind {
    damaged("its data contains a coefficient that no image of 8-bit samples has")
}
