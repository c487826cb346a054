//! The bits of entropy-coded data, from the highest bit of each byte on.

use super::error::{Result, damaged};
use super::huffman::Huffman;
use crate::error::ReadErrorKind;

/// Reads the bits of the data between two markers.
///
/// After the end of the data it returns zeros, so decoded values are valid only after
/// [`Bits::check`].
#[derive(Debug)]
pub(super) struct Bits<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The next bits, the first one highest.
    window: u64,
    /// The number of bits in the window.
    count: u32,
    /// How many of these bits, at the end of the window, are beyond the data.
    beyond: u32,
}

impl<'a> Bits<'a> {
    /// Reads data from which stuffed zeros have been removed.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, window: 0, count: 0, beyond: 0 }
    }

    /// Fills the window to at least 56 bits: more than a code (16) and its value (15) need.
    #[inline(always)]
    fn refill(&mut self) {
        if let Some(next) = self.bytes.get(self.at..self.at + 8) {
            let next = u64::from_be_bytes(next.try_into().unwrap_or_default());
            self.window |= next >> self.count;
            self.at += ((63 - self.count) / 8) as usize;
            self.count |= 0b11_1000;
        } else {
            self.refill_at_end();
        }
    }

    #[cold]
    fn refill_at_end(&mut self) {
        while self.count < 56 {
            if let Some(byte) = self.bytes.get(self.at) {
                // A refill of eight bytes may have set these bits already, to the same values.
                self.window |= u64::from(*byte) << (56 - self.count);
                self.at += 1;
            } else {
                self.beyond += 8;
            }
            self.count += 8;
        }
    }

    #[inline(always)]
    fn consume(&mut self, count: u32) {
        self.window <<= count;
        self.count -= count;
    }

    /// The next `count` bits, up to 16, as a number.
    #[inline(always)]
    fn take(&mut self, count: u32) -> u32 {
        // The shift is done in two steps, because a shift by all 64 bits is not possible.
        let value = (self.window >> 1 >> (63 - count)) as u32;
        self.consume(count);
        value
    }

    /// Reads the next symbol of a table. The window then also holds the bits of its value, for
    /// `value` or `raw`.
    #[inline(always)]
    pub(super) fn symbol(&mut self, table: &Huffman) -> Result<u8> {
        self.refill();
        let (symbol, length) = table.find((self.window >> 48) as u16);
        if length == 0 {
            return Err(self.bad_code());
        }
        self.consume(length);
        Ok(symbol)
    }

    #[cold]
    fn bad_code(&self) -> ReadErrorKind {
        match self.check() {
            Err(error) => error,
            Ok(()) => damaged("its data contains a Huffman code that is not in the table"),
        }
    }

    /// Reads the value of `size` bits, up to 15, directly after a symbol. It is negative if its
    /// first bit is 0 (T.81, F.2.2.1).
    #[inline(always)]
    pub(super) fn value(&mut self, size: u8) -> i32 {
        let size = u32::from(size);
        let bits = self.take(size) as i32;
        // The first bit is 0 for negative values, which are stored with 2^size - 1 added.
        let below = (bits >> size.saturating_sub(1)) - 1;
        let span = (1 << size) - 1;
        bits - (below & span)
    }

    /// Reads up to 15 bits directly after a symbol, as an unsigned number.
    #[inline(always)]
    pub(super) fn raw(&mut self, count: u8) -> u32 {
        self.take(u32::from(count))
    }

    /// Reads one bit at any position.
    #[inline(always)]
    pub(super) fn bit(&mut self) -> bool {
        if self.count == 0 {
            self.refill();
        }
        self.take(1) == 1
    }

    /// Checks that no bits beyond the data were read.
    ///
    /// # Errors
    /// When more bits were read than there are.
    #[inline(always)]
    pub(super) fn check(&self) -> Result<()> {
        if self.count < self.beyond { Err(too_short()) } else { Ok(()) }
    }

    /// Checks that the data ends here.
    ///
    /// # Errors
    /// When more bits were read than there are, or a whole byte is left over. The padding of the
    /// last byte is not checked.
    pub(super) fn finish(self) -> Result<()> {
        self.check()?;
        let left = (self.bytes.len() - self.at) * 8 + (self.count - self.beyond) as usize;
        if left >= 8 {
            let bytes = left / 8;
            return Err(damaged(format!(
                "{bytes} extraneous bytes of entropy-coded data precede a marker"
            )));
        }
        Ok(())
    }
}

#[cold]
fn too_short() -> ReadErrorKind {
    damaged("its entropy-coded data ends too early, before a marker")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table with the code 0 for the symbol 3.
    fn table() -> Huffman {
        let mut counts = [0; 16];
        counts[0] = 1;
        Huffman::new(&counts, &[3]).unwrap()
    }

    #[test]
    fn values_have_a_sign() {
        // Four times a symbol and 3 bits: 7, 4, -4, -7; 16 bits in all.
        let bytes = [0b0111_0100, 0b0011_0000];
        let mut bits = Bits::new(&bytes);
        for wanted in [7, 4, -4, -7] {
            let size = bits.symbol(&table()).unwrap();
            assert_eq!((size, bits.value(size)), (3, wanted));
            bits.check().unwrap();
        }
        bits.finish().unwrap();
    }

    #[test]
    fn takes_neither_more_nor_less_than_there_is() {
        let long: Vec<u8> = vec![0b0101_0101; 100];
        for length in 0..long.len() {
            let mut bits = Bits::new(&long[..length]);
            for _ in 0..2 * length {
                bits.symbol(&table()).unwrap();
                assert_eq!(bits.value(3), 5);
                bits.check().unwrap();
            }
            assert!(bits.bit() || bits.check().is_err(), "{length}");
            let mut bits = Bits::new(&long[..length]);
            for _ in 1..2 * length {
                bits.symbol(&table()).unwrap();
                bits.value(3);
            }
            bits.finish().unwrap();
            if length > 1 {
                let mut bits = Bits::new(&long[..length]);
                for _ in 2..2 * length {
                    bits.symbol(&table()).unwrap();
                    bits.value(3);
                }
                assert!(bits.finish().is_err(), "a byte is left");
            }
        }
    }

    #[test]
    fn a_code_that_does_not_exist() {
        assert!(Bits::new(&[0xff]).symbol(&table()).is_err());
    }
}
