//! Quantisation tables (ITU-T T.81, B.2.4.1) and the order of coefficients in a file.

use super::error::{Result, damaged};

/// The number of coefficients of a block.
pub(super) const COEFFICIENTS: usize = 64;

/// The quantisation step of each coefficient, row by row.
pub(super) type Steps = [u16; COEFFICIENTS];

/// The position in a block, row by row, of each coefficient in the zigzag order of a file (figure
/// A.6).
pub(super) const ZIGZAG: [u8; COEFFICIENTS] = zigzag();

const fn zigzag() -> [u8; COEFFICIENTS] {
    let mut order = [0; COEFFICIENTS];
    let (mut x, mut y, mut i) = (0usize, 0usize, 0);
    while i < COEFFICIENTS {
        order[i] = (y * 8 + x) as u8;
        // The order runs upwards on even diagonals and downwards on odd ones, and moves along the
        // edges to the next diagonal.
        if (x + y).is_multiple_of(2) {
            if x == 7 {
                y += 1;
            } else if y == 0 {
                x += 1;
            } else {
                (x, y) = (x + 1, y - 1);
            }
        } else if y == 7 {
            x += 1;
        } else if x == 0 {
            y += 1;
        } else {
            (x, y) = (x - 1, y + 1);
        }
        i += 1;
    }
    order
}

/// Reads all tables of a segment.
pub(super) fn parse(mut data: &[u8], tables: &mut [Option<Steps>; 4]) -> Result<()> {
    let wrong = |what: &str| damaged(format!("a quantisation table {what}"));
    while let [head, rest @ ..] = data {
        let (wide, number) = (head >> 4, usize::from(head & 15));
        if wide > 1 || number > 3 {
            return Err(wrong("has a wrong number or precision"));
        }
        let width = 1 + usize::from(wide);
        let Some((values, rest)) = rest.split_at_checked(width * COEFFICIENTS) else {
            return Err(wrong("is cut short"));
        };
        let mut steps = [0; COEFFICIENTS];
        for (value, place) in values.chunks_exact(width).zip(ZIGZAG) {
            let step = value.iter().fold(0, |sum, byte| sum << 8 | u16::from(*byte));
            if step == 0 {
                return Err(wrong("has a step of 0"));
            }
            steps[usize::from(place)] = step;
        }
        tables[number] = Some(steps);
        data = rest;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_that_of_figure_a_6() {
        assert_eq!(ZIGZAG[..10], [0, 1, 8, 16, 9, 2, 3, 10, 17, 24]);
        assert_eq!(ZIGZAG[28..36], [7, 14, 21, 28, 35, 42, 49, 56]);
        assert_eq!(ZIGZAG[54..], [39, 46, 53, 60, 61, 54, 47, 55, 62, 63]);
    }

    #[test]
    fn steps_of_one_and_two_bytes() {
        let mut tables = [None; 4];
        let mut data = vec![0x01];
        data.extend(1..=64);
        data.push(0x12);
        data.extend((1..=64u16).flat_map(|step| (step * 1000).to_be_bytes()));
        parse(&data, &mut tables).unwrap();
        let (narrow, wide) = (tables[1].unwrap(), tables[2].unwrap());
        assert_eq!((narrow[8], narrow[63], wide[8], wide[63]), (3, 64, 3000, 64_000));
        assert!(parse(&data[..64], &mut tables).is_err(), "cut short");
        data[5] = 0;
        assert!(parse(&data, &mut tables).is_err(), "a step of 0");
    }
}
