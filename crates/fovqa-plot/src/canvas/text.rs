//! How wide a text is when it is set in the bundled font.

use std::sync::OnceLock;

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

/// DejaVu Sans: free, and with glyphs for most alphabets, superscripts and ∞.
pub(crate) const FONT: &[u8] = include_bytes!("../../fonts/DejaVuSans.ttf");

/// The name of [`FONT`].
pub(crate) const FAMILY: &str = "DejaVu Sans";

/// What a viewer without [`FAMILY`] takes: Verdana has nearly the same widths.
pub(crate) const FAMILIES: &str = "DejaVu Sans, Verdana, sans-serif";

/// Size of a figure's and an axis' title in pixels.
pub(crate) const TITLE_PX: f64 = 13.0;

/// Size of tick labels, group names and the legend in pixels.
pub(crate) const TICK_PX: f64 = 12.0;

/// Size of values beside their marks in pixels: the smallest text there is.
pub(crate) const VALUE_PX: f64 = 11.0;

/// From a line of text to the next, in sizes of the font.
pub(crate) const LINE_PITCH: f64 = 1.25;

/// Height of a capital letter above the baseline, in sizes of the font.
pub(crate) const CAPITAL: f64 = 0.73;

/// Depth of a letter below the baseline, in sizes of the font.
pub(crate) const DESCENT: f64 = 0.24;

/// Width of a character the font lacks, in sizes of the font: as wide as an ideograph.
const FOREIGN_EM: f64 = 1.0;

/// The width of a text of a size, both in pixels. Kerning is left out, which only makes narrower.
pub(crate) fn width_px(text: &str, size_px: f64) -> f64 {
    text.chars().map(advance_em).sum::<f64>() * size_px
}

/// How far a character moves the pen, in sizes of the font.
pub(crate) fn advance_em(character: char) -> f64 {
    static FACE: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    let Some(face) = FACE.get_or_init(|| FontRef::new(FONT).ok()) else { return FOREIGN_EM };
    // A size of 1 px: advances come in sizes of the font.
    let metrics = face.glyph_metrics(Size::new(1.0), LocationRef::default());
    let glyph = face.charmap().map(character);
    glyph.and_then(|glyph| metrics.advance_width(glyph)).map_or(FOREIGN_EM, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_with_the_bundled_font() {
        // Advances of DejaVu Sans in its 2048 units: space 651, 0 1303, i 569, m 1995.
        for (text, units) in [(" ", 651.0), ("0", 1303.0), ("im", 2564.0), ("", 0.0)] {
            assert!((width_px(text, 2048.0) - units).abs() < 0.01, "{text:?}");
        }
        assert!((width_px("漢", 12.0) - 12.0).abs() < 1e-9, "not in the font: a whole em");
        assert!(width_px("e\u{301}", 12.0) <= width_px("e", 12.0) + 1e-9, "an accent on top");
    }

    #[test]
    fn the_font_has_what_labels_need() {
        let face = FontRef::new(FONT).unwrap();
        for character in "0123456789.−×⁻⁰¹²³⁴⁵⁶⁷⁸⁹∞…°µ²".chars() {
            assert!(face.charmap().map(character).is_some(), "{character}");
        }
    }
}
