//! Bits of entropy-coded data, the highest first.

use super::error::{Result, damaged};
use super::huffman::Huffman;
use crate::error::ReadErrorKind;

/// Reads bits of the data between two markers.
///
/// Behind the end come zeros. What was decoded counts only after [`Bits::check`].
#[derive(Debug)]
pub(super) struct Bits<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The next bits, from the highest on.
    window: u64,
    /// How many of them there are.
    count: u32,
    /// How many of them, the last ones, are not of the data.
    beyond: u32,
}

impl<'a> Bits<'a> {
    /// Of data without stuffed zeros.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, window: 0, count: 0, beyond: 0 }
    }

    /// Makes sure of at least 56 bits: more than a code (16) and its value (15) take.
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
                // What a refill of eight bytes has put there already are the same bits.
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

    /// Up to 16 bits as a number.
    #[inline(always)]
    fn take(&mut self, count: u32) -> u32 {
        // In two steps: a shift by all 64 bits is none.
        let value = (self.window >> 1 >> (63 - count)) as u32;
        self.consume(count);
        value
    }

    /// The next code of a table and, behind it, as many bits as `size` says of it, 16 at most.
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
            Ok(()) => damaged("its data holds a Huffman code that is not in the table"),
        }
    }

    /// The value of `size` bits, up to 15, right behind a symbol: negative where the first bit is 0
    /// (T.81, F.2.2.1).
    #[inline(always)]
    pub(super) fn value(&mut self, size: u8) -> i32 {
        let size = u32::from(size);
        let bits = self.take(size) as i32;
        // The largest bit is 0 for values below 0, which are then 2^size - 1 less.
        let below = (bits >> size.saturating_sub(1)) - 1;
        let span = (1 << size) - 1;
        bits - (below & span)
    }

    /// Up to 15 bits right behind a symbol, as they are.
    #[inline(always)]
    pub(super) fn raw(&mut self, count: u8) -> u32 {
        self.take(u32::from(count))
    }

    /// One bit, anywhere.
    #[inline(always)]
    pub(super) fn bit(&mut self) -> bool {
        if self.count == 0 {
            self.refill();
        }
        self.take(1) == 1
    }

    /// # Errors
    /// When more bits were taken than there are.
    #[inline(always)]
    pub(super) fn check(&self) -> Result<()> {
        if self.count < self.beyond { Err(too_short()) } else { Ok(()) }
    }

    /// # Errors
    /// When more bits were taken than there are, or a whole byte is left over. What fills the last
    /// byte up is no matter.
    pub(super) fn finish(self) -> Result<()> {
        self.check()?;
        let left = (self.bytes.len() - self.at) * 8 + (self.count - self.beyond) as usize;
        if left >= 8 {
            let bytes = left / 8;
            return Err(damaged(format!(
                "{bytes} extraneous bytes of entropy-coded data stand in front of a marker"
            )));
        }
        Ok(())
    }
}

#[cold]
fn too_short() -> ReadErrorKind {
    damaged("its entropy-coded data ends too early, in front of a marker")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One bit: 0 for the symbol 3.
    fn table() -> Huffman {
        let mut counts = [0; 16];
        counts[0] = 1;
        Huffman::new(&counts, &[3]).unwrap()
    }

    #[test]
    fn values_have_a_sign() {
        // Symbol, 3 bits, four times: 7, 4, -4, -7; 16 bits.
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
