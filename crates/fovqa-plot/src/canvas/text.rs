//! The width of text in the bundled font.

use std::sync::OnceLock;

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

/// DejaVu Sans, which is free and has glyphs for most alphabets, superscripts and ∞.
pub(crate) const FONT: &[u8] = include_bytes!("../../fonts/DejaVuSans.ttf");

/// The name of [`FONT`].
pub(crate) const FAMILY: &str = "DejaVu Sans";

/// Units of [`FONT`] per font size.
pub(crate) const UNITS_PER_EM: f64 = 2048.0;

/// The font families for characters that [`FONT`] lacks. Verdana has nearly the same widths.
pub(crate) const FAMILIES: &str = "DejaVu Sans, Verdana, sans-serif";

/// Size of titles of figures and axes, in pixels.
pub(crate) const TITLE_PX: f64 = 13.0;

/// Size of tick labels, group names and legend, in pixels.
pub(crate) const TICK_PX: f64 = 12.0;

/// Size of values beside their marks, in pixels. This is the smallest text.
pub(crate) const VALUE_PX: f64 = 11.0;

/// Distance between two lines of text, in units of the font size.
pub(crate) const LINE_PITCH: f64 = 1.25;

/// Height of a capital letter above the baseline, in units of the font size.
pub(crate) const CAPITAL: f64 = 0.73;

/// Depth of a letter below the baseline, in units of the font size.
pub(crate) const DESCENT: f64 = 0.24;

/// Width of a character that the font lacks, in units of the font size: that of an ideograph.
const FOREIGN_EM: f64 = 1.0;

/// The width of a text in pixels, at a size in pixels. Kerning is ignored; it would only make the
/// text narrower.
pub(crate) fn width_px(text: &str, size_px: f64) -> f64 {
    text.chars().map(advance_em).sum::<f64>() * size_px
}

/// The advance width of a character, in units of the font size.
pub(crate) fn advance_em(character: char) -> f64 {
    static FACE: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    let Some(face) = FACE.get_or_init(|| FontRef::new(FONT).ok()) else { return FOREIGN_EM };
    // With a size of 1 px, advance widths are in units of the font size.
    let metrics = face.glyph_metrics(Size::new(1.0), LocationRef::default());
    let glyph = face.charmap().map(character);
    glyph.and_then(|glyph| metrics.advance_width(glyph)).map_or(FOREIGN_EM, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_with_the_bundled_font() {
        // Advance widths of DejaVu Sans in its 2048 units: space 651, 0 1303, i 569, m 1995.
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
