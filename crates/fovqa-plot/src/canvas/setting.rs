//! Sets lines of text in the bundled font: which glyph stands where. SVG, PDF and PNG use the same
//! positions, so that a text has the same place and width in all of them.

use std::sync::{Arc, OnceLock};

use resvg::usvg::fontdb::Database;
use resvg::usvg::{Node, Options, Text, Tree};

use crate::canvas::drawing::Anchor;
use crate::canvas::text::{FAMILY, FONT};

/// The font size at which lines are set. Positions are proportional to the size.
const SET_PX: f64 = 1000.0;

/// One glyph of a line. Positions are in units of the font size, from the anchor of the line, x to
/// the right and y upwards.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Glyph {
    /// Its index in the bundled font; 0 stands for a character that the font lacks.
    pub(crate) id: u16,
    pub(crate) x_em: f64,
    pub(crate) y_em: f64,
    /// The characters that it stands for; empty if another glyph stands for them already.
    pub(crate) text: String,
}

/// A line of text as glyphs, from left to right.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SetLine {
    pub(crate) glyphs: Vec<Glyph>,
}

impl SetLine {
    /// Sets a line of text. Kerning, accents and scripts that are written from right to left are
    /// as in the PNG.
    pub(crate) fn new(line: &str, anchor: Anchor) -> Self {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><text xml:space=\"preserve\" \
             font-family=\"{FAMILY}\" font-size=\"{SET_PX}\" text-anchor=\"{anchor}\">{}</text></svg>",
            escaped(line)
        );
        let options =
            Options { font_family: FAMILY.to_owned(), fontdb: fonts(), ..Options::default() };
        let tree = Tree::from_str(&svg, &options);
        let nodes = tree.as_ref().map(|tree| tree.root().children()).unwrap_or_default();
        let mut glyphs: Vec<Glyph> = texts(nodes)
            .into_iter()
            .flat_map(Text::layouted)
            .flat_map(|span| &span.positioned_glyphs)
            .map(|glyph| {
                let at = glyph.outline_transform();
                Glyph {
                    id: u16::try_from(glyph.id.0).unwrap_or(0),
                    x_em: f64::from(at.tx) / SET_PX,
                    y_em: -f64::from(at.ty) / SET_PX,
                    text: glyph.text.clone(),
                }
            })
            .collect();
        glyphs.sort_by(|a, b| a.x_em.total_cmp(&b.x_em));
        Self { glyphs }
    }

    /// Whether the bundled font has all its characters.
    pub(crate) fn is_complete(&self) -> bool {
        self.glyphs.iter().all(|glyph| glyph.id != 0)
    }
}

/// The text elements among nodes and in their groups.
fn texts(nodes: &[Node]) -> Vec<&Text> {
    let mut found = Vec::new();
    for node in nodes {
        match node {
            Node::Group(group) => found.extend(texts(group.children())),
            Node::Text(text) => found.push(&**text),
            Node::Path(_) | Node::Image(_) => {}
        }
    }
    found
}

/// The bundled font alone, without the fonts of the system.
pub(crate) fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = Database::new();
        fonts.load_font_data(FONT.to_vec());
        Arc::new(fonts)
    });
    Arc::clone(fonts)
}

/// Escapes text for use in an element or an attribute of an SVG.
pub(crate) fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '"' => plain.push_str("&quot;"),
            '\'' => plain.push_str("&apos;"),
            c => plain.push(c),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::text::width_px;

    #[test]
    fn glyphs_stand_where_their_widths_say() {
        // DejaVu Sans has no kerning between these.
        let line = SetLine::new("im 0", Anchor::Start);
        let want = [("i", "", 0.0), ("m", "i", 0.0), (" ", "im", 0.0), ("0", "im ", 0.0)];
        assert_eq!(line.glyphs.len(), want.len());
        for (glyph, (text, before, y_em)) in line.glyphs.iter().zip(want) {
            assert_eq!((glyph.text.as_str(), glyph.y_em), (text, y_em));
            assert!((glyph.x_em - width_px(before, 1.0)).abs() < 1e-3, "{glyph:?}");
        }
        assert!(line.is_complete());
    }

    #[test]
    fn lines_begin_before_their_anchor() {
        let width = width_px("00", 1.0);
        for (anchor, left) in [(Anchor::Middle, -width / 2.0), (Anchor::End, -width)] {
            let first = SetLine::new("00", anchor).glyphs[0].x_em;
            assert!((first - left).abs() < 1e-3, "{anchor:?}: {first}");
        }
    }

    #[test]
    fn what_the_font_lacks_is_noticed() {
        for (line, complete) in
            [("RMFR & <x>", true), ("", true), ("עברית", true), ("注視", false), ("a注", false)]
        {
            assert_eq!(SetLine::new(line, Anchor::Start).is_complete(), complete, "{line}");
        }
    }

    #[test]
    fn letters_from_right_to_left_are_turned() {
        let line = SetLine::new("אב", Anchor::Start);
        let texts: Vec<&str> = line.glyphs.iter().map(|glyph| glyph.text.as_str()).collect();
        assert_eq!(texts, ["ב", "א"]);
    }
}
