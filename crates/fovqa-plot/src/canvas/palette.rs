//! The colours of series.

use crate::canvas::colour::Colour;

/// The largest number of colours of a palette.
const MOST: usize = 12;

/// The colours of series, in their order. After the last one they repeat, with other dashes,
/// markers and hatches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Palette {
    colours: [Colour; MOST],
    count: usize,
}

impl Palette {
    /// The colours of Okabe and Ito ("Color Universal Design", 2008), which people with any common
    /// colour blindness can distinguish. The order is our own: the first four are far apart in hue
    /// and in lightness. Yellow is left out, because it is too light for a line on white paper.
    pub const OKABE_ITO: Self = Self::of([
        Colour(0x00, 0x72, 0xb2), // blue
        Colour(0xd5, 0x5e, 0x00), // vermillion
        Colour(0x00, 0x9e, 0x73), // bluish green
        Colour(0xcc, 0x79, 0xa7), // reddish purple
        Colour(0xe6, 0x9f, 0x00), // orange
        Colour(0x56, 0xb4, 0xe9), // sky blue
        Colour(0x00, 0x00, 0x00), // black
    ]);

    /// The "bright" colours of Paul Tol ("Colour Schemes", 2021), without gray.
    pub const TOL_BRIGHT: Self = Self::of([
        Colour(0x44, 0x77, 0xaa), // blue
        Colour(0xee, 0x66, 0x77), // red
        Colour(0x22, 0x88, 0x33), // green
        Colour(0xcc, 0xbb, 0x44), // yellow
        Colour(0x66, 0xcc, 0xee), // cyan
        Colour(0xaa, 0x33, 0x77), // purple
    ]);

    /// Grays, for print without colour. Dashes, markers and hatches tell series apart.
    pub const GRAY: Self = Self::of([
        Colour(0x00, 0x00, 0x00),
        Colour(0x70, 0x70, 0x70),
        Colour(0x38, 0x38, 0x38),
        Colour(0x98, 0x98, 0x98),
    ]);

    /// A palette of given colours (red, green and blue in sRGB); `None` without colours or with
    /// more than 12.
    pub fn new(colours: &[[u8; 3]]) -> Option<Self> {
        let mut palette = Self { colours: [Colour(0, 0, 0); MOST], count: colours.len() };
        if colours.is_empty() || colours.len() > MOST {
            return None;
        }
        for (to, [r, g, b]) in palette.colours.iter_mut().zip(colours) {
            *to = Colour(*r, *g, *b);
        }
        Some(palette)
    }

    const fn of<const N: usize>(given: [Colour; N]) -> Self {
        let mut colours = [Colour(0, 0, 0); MOST];
        let mut i = 0;
        while i < N {
            colours[i] = given[i];
            i += 1;
        }
        Self { colours, count: N }
    }

    /// The colour of a series, and how often the colours have been used before it.
    pub(crate) fn colour(self, index: usize) -> (Colour, usize) {
        (self.colours[index % self.count], index / self.count)
    }

    /// The position of a series' colour in the palette.
    pub(crate) fn position(self, index: usize) -> usize {
        index % self.count
    }
}

impl Default for Palette {
    fn default() -> Self {
        Self::OKABE_ITO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_is_seen_on_white() {
        for (palette, count, least) in
            [(Palette::OKABE_ITO, 7, 2.0), (Palette::TOL_BRIGHT, 6, 1.7), (Palette::GRAY, 4, 2.0)]
        {
            assert_eq!(palette.count, count);
            for Colour(r, g, b) in &palette.colours[..count] {
                let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
                let y = 0.2126 * linear(*r) + 0.7152 * linear(*g) + 0.0722 * linear(*b);
                // The contrast is defined as in WCAG; yellow would have 1.3.
                assert!(1.05 / (y + 0.05) > least, "{r} {g} {b}");
            }
        }
    }

    #[test]
    fn a_palette_has_one_to_twelve_colours() {
        assert_eq!(Palette::new(&[]), None);
        assert_eq!(Palette::new(&[[0; 3]; 13]), None);
        let two = Palette::new(&[[1, 2, 3], [4, 5, 6]]).unwrap();
        assert_eq!(two.colour(3), (Colour(4, 5, 6), 1));
    }
}
