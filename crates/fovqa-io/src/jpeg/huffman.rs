//! Huffman tables (ITU-T T.81, B.2.4.2 and annex C).

use super::error::{Result, damaged};
use crate::error::ReadErrorKind;

/// Codes of up to this number of bits are found with one look-up.
const LOOKUP_BITS: u32 = 9;
/// The length of the longest code.
const LONGEST: usize = 16;

/// One table, prepared for decoding.
#[derive(Debug, Clone)]
pub(super) struct Huffman {
    /// Indexed by the first bits of the data: the symbol in the low byte, and above it the length
    /// of its code; 0 for longer codes.
    lookup: Box<[u16; 1 << LOOKUP_BITS]>,
    /// For each length, the first longer code, padded to 16 bits.
    ends: [u32; LONGEST + 1],
    /// For each length, the number that, added to a code, gives the index of its symbol.
    offsets: [i32; LONGEST + 1],
    symbols: Vec<u8>,
}

/// The tables that a file has defined so far.
#[derive(Debug, Default)]
pub(super) struct Tables {
    /// Tables for means.
    pub(super) dc: [Option<Huffman>; 4],
    /// Tables for all other coefficients.
    pub(super) ac: [Option<Huffman>; 4],
}

impl Huffman {
    /// Makes a table from the number of codes of each length and their symbols in order.
    ///
    /// # Errors
    /// When there are more codes than their lengths allow.
    pub(super) fn new(counts: &[u8; LONGEST], symbols: &[u8]) -> Result<Self> {
        let mut table = Self {
            lookup: Box::new([0; 1 << LOOKUP_BITS]),
            ends: [0; LONGEST + 1],
            offsets: [0; LONGEST + 1],
            symbols: symbols.to_vec(),
        };
        let (mut code, mut place) = (0u32, 0usize);
        for (length, count) in (1..).zip(counts) {
            let count = usize::from(*count);
            table.offsets[length] = place as i32 - code as i32;
            for symbol in &symbols[place..place + count] {
                if length <= LOOKUP_BITS as usize {
                    let room = LOOKUP_BITS as usize - length;
                    let from = (code as usize) << room;
                    let entry = (length as u16) << 8 | u16::from(*symbol);
                    table.lookup.get_mut(from..from + (1 << room)).ok_or_else(wrong)?.fill(entry);
                }
                code += 1;
            }
            // The code that consists only of ones is reserved, so that no data looks like the
            // padding of a byte.
            if count > 0 && code >= 1 << length {
                return Err(wrong());
            }
            place += count;
            table.ends[length] = code << (LONGEST - length);
            code <<= 1;
        }
        Ok(table)
    }

    /// The symbol at the start of these 16 bits, and the length of its code, which is 0 if there is
    /// none.
    #[inline(always)]
    pub(super) fn find(&self, bits: u16) -> (u8, u32) {
        let entry = self.lookup[usize::from(bits >> (16 - LOOKUP_BITS))];
        if entry != 0 { (entry as u8, u32::from(entry >> 8)) } else { self.find_long(bits) }
    }

    fn find_long(&self, bits: u16) -> (u8, u32) {
        for length in LOOKUP_BITS as usize + 1..=LONGEST {
            if u32::from(bits) < self.ends[length] {
                let code = i32::from(bits >> (LONGEST - length));
                let place = (code + self.offsets[length]) as usize;
                return match self.symbols.get(place) {
                    Some(symbol) => (*symbol, length as u32),
                    None => (0, 0),
                };
            }
        }
        (0, 0)
    }

    /// Whether every symbol is a possible number of bits, which is required in a table for means.
    fn has_only_sizes(&self) -> bool {
        self.symbols.iter().all(|size| *size <= 15)
    }
}

fn wrong() -> ReadErrorKind {
    damaged("a Huffman table has more codes than fit its lengths")
}

impl Tables {
    /// Reads all tables of a segment.
    pub(super) fn parse(&mut self, mut data: &[u8]) -> Result<()> {
        let cut = || damaged("a Huffman table is cut short");
        while let [head, rest @ ..] = data {
            let (class, number) = (head >> 4, usize::from(head & 15));
            if class > 1 || number > 3 {
                return Err(damaged("a Huffman table has a wrong number or class"));
            }
            let (counts, rest) = rest.split_first_chunk::<LONGEST>().ok_or_else(cut)?;
            let total = counts.iter().map(|count| usize::from(*count)).sum();
            let (symbols, rest) = rest.split_at_checked(total).ok_or_else(cut)?;
            if total > 256 {
                return Err(wrong());
            }
            let table = Huffman::new(counts, symbols)?;
            if class == 0 {
                self.dc[number] = Some(table);
            } else {
                self.ac[number] = Some(table);
            }
            data = rest;
        }
        Ok(())
    }

    /// The table for means with this number.
    pub(super) fn means(&self, number: usize) -> Result<&Huffman> {
        let table = found(&self.dc, number)?;
        if !table.has_only_sizes() {
            return Err(damaged("a Huffman table for DC coefficients has symbols above 15"));
        }
        Ok(table)
    }

    /// The table for all other coefficients with this number.
    pub(super) fn others(&self, number: usize) -> Result<&Huffman> {
        found(&self.ac, number)
    }
}

fn found(tables: &[Option<Huffman>; 4], number: usize) -> Result<&Huffman> {
    let table = tables.get(number).and_then(Option::as_ref);
    table.ok_or_else(|| damaged(format!("a scan uses Huffman table {number}, which is missing")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(of_length: &[(usize, u8)]) -> [u8; LONGEST] {
        let mut counts = [0; LONGEST];
        for (length, count) in of_length {
            counts[length - 1] = *count;
        }
        counts
    }

    #[test]
    fn codes_short_and_long() {
        // The codes 0, 10, then 110 and nine more bits: 12 bits in all.
        let table = Huffman::new(&counts(&[(1, 1), (2, 1), (12, 3)]), &[5, 6, 7, 8, 9]).unwrap();
        assert_eq!(table.find(0b0111_1111_1111_1111), (5, 1));
        assert_eq!(table.find(0b1011_1111_1111_1111), (6, 2));
        assert_eq!(table.find(0b1100_0000_0000_0000), (7, 12));
        assert_eq!(table.find(0b1100_0000_0010_1111), (9, 12));
        assert_eq!(table.find(0b1100_0000_0011_0000), (0, 0), "no code");
        assert_eq!(table.find(0xffff), (0, 0), "no code");
    }

    #[test]
    fn tables_that_cannot_be() {
        assert!(Huffman::new(&counts(&[(1, 2)]), &[1, 2]).is_err(), "ones alone are reserved");
        assert!(Huffman::new(&counts(&[(1, 1), (2, 2)]), &[1, 2, 3]).is_err());
        assert!(Huffman::new(&counts(&[(1, 3)]), &[1, 2, 3]).is_err(), "too many");
        let mut tables = Tables::default();
        let mut data = [&[0x00][..], &counts(&[(1, 1)]), &[16]].concat();
        tables.parse(&data).unwrap();
        assert!(tables.means(0).is_err(), "a mean's difference of 16 bits");
        data[0] = 0x20;
        assert!(tables.parse(&data).is_err(), "neither class");
        assert!(tables.means(1).is_err() && tables.others(0).is_err(), "not there");
    }

    #[test]
    fn the_standard_tables_are_full() {
        let mut tables = Tables::default();
        super::super::standard_huffman::fill_in(&mut tables).unwrap();
        // T.81, tables K.3 and K.5.
        assert_eq!(tables.means(0).unwrap().find(0b1111_1111_0000_0000), (11, 9));
        assert_eq!(tables.others(0).unwrap().find(0b1010_1111_1111_1111), (0, 4));
        assert_eq!(tables.others(0).unwrap().find(0xfffe), (0xfa, 16));
        assert_eq!(tables.others(1).unwrap().find(0b0011_1111_1111_1111), (0, 2));
    }
}
