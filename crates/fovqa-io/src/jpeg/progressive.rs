//! Blocks of progressive scans (ITU-T T.81, G.1.2).

use super::bits::Bits;
use super::error::{Result, damaged};
use super::huffman::Huffman;
use super::quantisation::ZIGZAG;
use super::sequential::{Coefficients, beyond_block, impossible};

/// The coefficients that a scan codes, in zigzag order, and the lowest bit that it codes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Band {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) low: u8,
}

/// Decodes a block of the first scan of coefficients other than the mean. `run` counts the blocks
/// that have no further coefficients.
pub(super) fn first(
    bits: &mut Bits<'_>,
    table: &Huffman,
    band: Band,
    run: &mut u32,
    block: &mut Coefficients,
) -> Result<()> {
    if *run > 0 {
        *run -= 1;
        return Ok(());
    }
    let mut k = band.from;
    while k <= band.to {
        let symbol = bits.symbol(table)?;
        let (zeros, size) = (symbol >> 4, symbol & 15);
        if size == 0 {
            if zeros < 15 {
                *run = blocks_of_run(bits, zeros) - 1;
                break;
            }
            k += 16;
            if k > band.to + 1 {
                return Err(beyond_block());
            }
            continue;
        }
        k += usize::from(zeros);
        if k > band.to {
            return Err(beyond_block());
        }
        let value = bits.value(size) << band.low;
        // The limit leaves room for the bits of later scans.
        if value.abs() >= 1 << 14 {
            return Err(impossible());
        }
        block[usize::from(ZIGZAG[k])] = value as i16;
        k += 1;
    }
    bits.check()
}

/// The number of blocks in a run, including this one.
fn blocks_of_run(bits: &mut Bits<'_>, size: u8) -> u32 {
    (1 << size) + bits.raw(size)
}

/// Decodes a block of a later scan: one more bit of the coefficients that are not 0, and new
/// coefficients of one bit.
pub(super) fn refine(
    bits: &mut Bits<'_>,
    table: &Huffman,
    band: Band,
    run: &mut u32,
    block: &mut Coefficients,
) -> Result<()> {
    let one = 1i16 << band.low;
    let mut k = band.from;
    while *run == 0 && k <= band.to {
        let symbol = bits.symbol(table)?;
        let (mut zeros, size) = (symbol >> 4, symbol & 15);
        let new = match size {
            0 if zeros < 15 => {
                *run = blocks_of_run(bits, zeros);
                break;
            }
            0 => 0,
            1 => bits.value(1) as i16 * one,
            _ => return Err(damaged("its data contains a new coefficient of more than one bit")),
        };
        // Skips the coefficients that are known already, and as many zeros as the run says.
        loop {
            if k > band.to {
                return Err(beyond_block());
            }
            let coefficient = &mut block[usize::from(ZIGZAG[k])];
            if *coefficient != 0 {
                refine_one(bits, one, coefficient);
            } else if zeros == 0 {
                *coefficient = new;
                break;
            } else {
                zeros -= 1;
            }
            k += 1;
        }
        k += 1;
    }
    if *run > 0 {
        for place in &ZIGZAG[k..=band.to] {
            let coefficient = &mut block[usize::from(*place)];
            if *coefficient != 0 {
                refine_one(bits, one, coefficient);
            }
        }
        *run -= 1;
    }
    bits.check()
}

#[inline(always)]
fn refine_one(bits: &mut Bits<'_>, one: i16, coefficient: &mut i16) {
    if bits.bit() && *coefficient & one == 0 {
        *coefficient += if *coefficient < 0 { -one } else { one };
    }
}
