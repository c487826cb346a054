//! Converts a share of a range to a colour of viridis. Its lightness rises evenly, so that it reads
//! the same in gray print and for readers with any colour vision.
//!
//! It is the map of Stéfan van der Walt and Nathaniel Smith for matplotlib (2015, CC0), stored as
//! sixteen of its colours at equal distances with linear interpolation, which is visually identical
//! to the original. The map contains no gray, so that a missing value cannot be mistaken for a
//! value.

use crate::canvas::colour::Colour;

/// The colour of a missing value.
pub(crate) const NO_VALUE: Colour = Colour(221, 221, 221);

/// The colour of a missing value in a map: its red, green and blue codes.
pub const MAP_NO_VALUE: [u8; 3] = [NO_VALUE.0, NO_VALUE.1, NO_VALUE.2];

/// The colours of maps, at equal steps from that of the lowest share of the scale to that of the
/// highest: red, green and blue codes.
pub fn map_palette() -> [[u8; 3]; 256] {
    std::array::from_fn(|level| {
        let Colour(r, g, b) = colour(level as f64 / 255.0);
        [r, g, b]
    })
}

/// The number of colour steps in a picture: one byte holds them and [`NO_VALUE`].
pub(crate) const LEVELS: u8 = 255;

/// The index of [`NO_VALUE`] in the palette.
pub(crate) const NO_LEVEL: u8 = LEVELS;

const ANCHORS: [Colour; 16] = [
    Colour(0x44, 0x01, 0x54),
    Colour(0x48, 0x1a, 0x6c),
    Colour(0x47, 0x2f, 0x7d),
    Colour(0x41, 0x44, 0x87),
    Colour(0x39, 0x56, 0x8c),
    Colour(0x31, 0x68, 0x8e),
    Colour(0x2a, 0x78, 0x8e),
    Colour(0x23, 0x88, 0x8e),
    Colour(0x1f, 0x98, 0x8b),
    Colour(0x22, 0xa8, 0x84),
    Colour(0x35, 0xb7, 0x79),
    Colour(0x54, 0xc5, 0x68),
    Colour(0x7a, 0xd1, 0x51),
    Colour(0xa5, 0xdb, 0x36),
    Colour(0xd2, 0xe2, 0x1b),
    Colour(0xfd, 0xe7, 0x25),
];

/// The colours of all levels, starting with that of the lowest value, followed by the colour of
/// [`NO_LEVEL`].
pub(crate) fn palette() -> Vec<Colour> {
    let last = f64::from(LEVELS - 1);
    (0..LEVELS).map(|level| colour(f64::from(level) / last)).chain([NO_VALUE]).collect()
}

/// The level of a share of the range. Shares beyond the ends have the levels of the ends.
pub(crate) fn level(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * f64::from(LEVELS - 1)).round() as u8
}

fn colour(share: f64) -> Colour {
    let along = share * (ANCHORS.len() - 1) as f64;
    let at = (along.floor() as usize).min(ANCHORS.len() - 2);
    let mix = |a: u8, b: u8| {
        let part = along - at as f64;
        (f64::from(a) * (1.0 - part) + f64::from(b) * part).round() as u8
    };
    let (Colour(r0, g0, b0), Colour(r1, g1, b1)) = (ANCHORS[at], ANCHORS[at + 1]);
    Colour(mix(r0, r1), mix(g0, g1), mix(b0, b1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lightness L* of CIELAB.
    fn lightness(Colour(r, g, b): Colour) -> f64 {
        let linear = |c: u8| match f64::from(c) / 255.0 {
            c if c <= 0.04045 => c / 12.92,
            c => ((c + 0.055) / 1.055).powf(2.4),
        };
        let y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        116.0 * y.cbrt() - 16.0
    }

    #[test]
    fn gets_lighter_evenly() {
        let tenth = |i: u32| lightness(colour(f64::from(i) / 10.0));
        for i in 0..10 {
            let step = tenth(i + 1) - tenth(i);
            assert!((5.0..=10.0).contains(&step), "{step} from {i}");
        }
        let palette = palette();
        let levels = &palette[..usize::from(LEVELS)];
        for pair in levels.windows(3) {
            assert!(lightness(pair[2]) > lightness(pair[0]), "{pair:?}");
        }
    }

    #[test]
    fn maps_have_the_same_colours_in_finer_steps() {
        let palette = map_palette();
        let ends = [ANCHORS[0], ANCHORS[15]].map(|Colour(r, g, b)| [r, g, b]);
        assert_eq!([palette[0], palette[255]], ends);
        let light = |[r, g, b]: [u8; 3]| lightness(Colour(r, g, b));
        assert!(palette.windows(3).all(|three| light(three[2]) > light(three[0])));
        assert!(!palette.contains(&MAP_NO_VALUE));
    }

    #[test]
    fn levels_reach_from_end_to_end() {
        let palette = palette();
        assert_eq!((palette.len(), palette[usize::from(NO_LEVEL)]), (256, NO_VALUE));
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0, 9.0, f64::NEG_INFINITY].map(level),
            [0, 0, 127, 254, 254, 0]
        );
        assert_eq!((palette[0], palette[254]), (ANCHORS[0], ANCHORS[15]));
        let near = |c: Colour| NO_VALUE.0.abs_diff(c.0).max(NO_VALUE.2.abs_diff(c.2));
        assert!(palette[..255].iter().all(|c| near(*c) > 60), "no value looks like none");
    }
}
