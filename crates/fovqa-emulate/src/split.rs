//! Coordinates as whole numbers and what is left of them, as fast as two additions.

/// In floats from 2^23 on all are whole, so that adding this rounds to whole numbers, which are then its
/// lower bits.
const WHOLE: f32 = 1.5 * (1u32 << 23) as f32;
const LOWER: u32 = (1 << 22) - 1;

/// A coordinate from 0 to below 2^22 as a whole number and the rest, from 0 to 1. At a whole number it
/// may be the one before it and 1: between two neighbours that is the same place.
#[inline(always)]
pub(crate) fn split(coordinate: f32) -> (u32, f32) {
    let whole = (coordinate - 0.5) + WHOLE;
    (whole.to_bits() & LOWER, coordinate - (whole - WHOLE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_make_the_coordinate() {
        for start in [0.0f32, 1.0, 2.0, 31.0, 1023.0, 65_534.0, 4_000_000.0] {
            for i in 0..4000 {
                let coordinate = start + i as f32 / 1000.0;
                let (whole, rest) = split(coordinate);
                assert!((0.0..=1.0).contains(&rest), "{coordinate}: {rest}");
                let off = f64::from(whole) + f64::from(rest) - f64::from(coordinate);
                assert!(off == 0.0, "{coordinate}: {off:e}");
            }
        }
    }
}
