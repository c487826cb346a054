//! The width of text, as it is printed in Computer Modern at 10 pt. Only an estimate is needed: it
//! decides which columns stand side by side, and where a name is wrapped.

/// The height of a line in points.
pub(super) const LINE: f64 = 12.0;

/// An inch in points.
pub(super) const INCH: f64 = 72.27;

/// Widths of the characters from ' ' to '~' in hundredths of a point.
#[rustfmt::skip]
const WIDTHS: [u16; 95] = [
    333, 278, 500, 833, 500, 833, 778, 278, 389, 389, 500, 778, 278, 333, 278, 500,
    500, 500, 500, 500, 500, 500, 500, 500, 500, 500, 278, 278, 778, 778, 778, 472,
    778, 750, 708, 722, 764, 681, 653, 785, 750, 361, 514, 778, 625, 917, 750, 778,
    681, 778, 736, 556, 722, 750, 750, 1028, 750, 750, 611, 278, 500, 278, 500, 500,
    278, 500, 556, 444, 556, 444, 306, 500, 556, 278, 306, 528, 278, 833, 556, 500,
    556, 528, 392, 394, 389, 556, 528, 722, 528, 528, 444, 500, 278, 500, 500,
];

/// The width of a plain text in points, before it is escaped.
pub(super) fn width(text: &str) -> f64 {
    let of = |c: char| match u32::from(c).checked_sub(0x20).and_then(|at| WIDTHS.get(at as usize)) {
        Some(width) => f64::from(*width),
        None if matches!(c, '\u{202f}' | '\u{2009}') => 167.0,
        // Latin letters with accents are at most this wide; characters of East Asia are 10 pt.
        None if u32::from(c) < 0x250 => 750.0,
        None => 1000.0,
    };
    text.chars().map(of).sum::<f64>() / 100.0
}

/// How many lines a text needs in a column of this width.
pub(super) fn lines(text: &str, column: f64) -> usize {
    let mut lines = 1;
    let mut used = 0.0;
    for word in text.split(' ') {
        let word = width(word);
        if used > 0.0 && used + 3.33 + word > column {
            lines += 1;
            used = 0.0;
        }
        // A long word is broken, but not at any place.
        let word = if word > column { 1.2 * word } else { word };
        lines += (word / column) as usize;
        used += 3.33 + word % column;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        assert!((width("RMFR") - (7.36 + 9.17 + 6.53 + 7.36)).abs() < 1e-9);
        assert!((width("24.70") - 22.78).abs() < 1e-9);
        assert!((width("a~") - 10.0).abs() < 1e-9, "the last character of the table");
    }

    #[test]
    fn long_texts_need_several_lines() {
        assert_eq!(lines("RMFR", 100.0), 1);
        assert_eq!(lines("RMFR with TAA and more", 75.0), 2);
        assert_eq!(lines(&"W".repeat(20), 60.0), 5);
    }
}
