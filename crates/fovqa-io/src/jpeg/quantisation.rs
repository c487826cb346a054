//! Quantisation tables (ITU-T T.81, B.2.4.1) and the order of coefficients in a file.

use super::{Result, damaged};

/// Coefficients of a block.
pub(super) const COEFFICIENTS: usize = 64;

/// The step of each coefficient, row by row.
pub(super) type Steps = [u16; COEFFICIENTS];

/// Where in a block, row by row, the coefficients stand that a file stores in zigzag order
/// (figure A.6).
pub(super) const ZIGZAG: [u8; COEFFICIENTS] = zigzag();

const fn zigzag() -> [u8; COEFFICIENTS] {
    let mut order = [0; COEFFICIENTS];
    let (mut x, mut y, mut i) = (0usize, 0usize, 0);
    while i < COEFFICIENTS {
        order[i] = (y * 8 + x) as u8;
        // On diagonals of an even number upwards, on the others downwards; along the edges to the
        // next diagonal.
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
                return Err(wrong("holds a step of 0"));
            }
            steps[usize::from(place)] = step;
        }
        tables[number] = Some(steps);
        data = rest;
    }
    Ok(())
}
