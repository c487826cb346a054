//! Text of an SVG as outlines of the bundled font, so that it looks the same in every program and
//! needs no installed font. An attribute has the words, for screen readers and searches.

use std::collections::BTreeMap;
use std::fmt::Write;

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use crate::canvas::drawing::{Anchor, Text};
use crate::canvas::setting::{SetLine, escaped};
use crate::canvas::text::{FAMILIES, FONT, UNITS_PER_EM};

/// The outlines that a document uses, each once.
#[derive(Debug, Default)]
pub(crate) struct Outlines(BTreeMap<u16, String>);

impl Outlines {
    /// Writes a line of text, with `units` of the document per pixel. A line with characters that
    /// the bundled font lacks is left to the fonts of the viewer.
    pub(crate) fn write(&mut self, body: &mut String, (text, line): (&Text, &SetLine), units: f64) {
        let (x, y) = ((text.at.0 * units).round(), (text.at.1 * units).round());
        let colour = text.colour.hex();
        let turn = if text.upwards { " rotate(-90)" } else { "" };
        let words = escaped(&text.line);
        if !line.is_complete() {
            let anchor = match text.anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let _ = writeln!(
                body,
                "<text transform=\"translate({x} {y}){turn}\" text-anchor=\"{anchor}\" \
                 font-family=\"{FAMILIES}\" font-size=\"{}\" fill=\"{colour}\">{words}</text>",
                text.size_px * units
            );
            return;
        }
        let scale = text.size_px * units / UNITS_PER_EM;
        let _ = write!(
            body,
            "<g role=\"img\" aria-label=\"{words}\" fill=\"{colour}\" \
             transform=\"translate({x} {y}){turn} scale({scale:.5} -{scale:.5})\">"
        );
        for glyph in &line.glyphs {
            let outline = self.0.entry(glyph.id).or_insert_with(|| outline(glyph.id));
            if outline.is_empty() {
                continue;
            }
            let at = |em: f64| (em * UNITS_PER_EM).round();
            let _ = write!(body, "<use xlink:href=\"#g{}\" x=\"{}\"", glyph.id, at(glyph.x_em));
            if glyph.y_em != 0.0 {
                let _ = write!(body, " y=\"{}\"", at(glyph.y_em));
            }
            body.push_str("/>");
        }
        body.push_str("</g>\n");
    }

    /// The definitions of all outlines that were used.
    pub(crate) fn definitions(&self) -> String {
        let mut text = String::new();
        for (id, outline) in self.0.iter().filter(|(_, outline)| !outline.is_empty()) {
            let _ = writeln!(text, "<path id=\"g{id}\" d=\"{outline}\"/>");
        }
        if text.is_empty() { text } else { format!("<defs>\n{text}</defs>\n") }
    }
}

/// The outline of a glyph in units of the font, y upwards; empty for a space.
fn outline(id: u16) -> String {
    let mut pen = Pen(String::new());
    if let Ok(face) = FontRef::new(FONT)
        && let Some(glyph) = face.outline_glyphs().get(GlyphId::from(id))
    {
        let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
        // A glyph that cannot be drawn has no outline, like a space.
        let _ = glyph.draw(settings, &mut pen);
    }
    pen.0
}

/// Writes an outline as the data of a path.
struct Pen(String);

impl Pen {
    fn add(&mut self, command: char, points: &[f32]) {
        self.0.push(command);
        for (i, value) in points.iter().enumerate() {
            let apart = if i > 0 { " " } else { "" };
            let _ = write!(self.0, "{apart}{value}");
        }
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.add('M', &[x, y]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add('L', &[x, y]);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.add('Q', &[cx, cy, x, y]);
    }

    fn curve_to(&mut self, cx: f32, cy: f32, dx: f32, dy: f32, x: f32, y: f32) {
        self.add('C', &[cx, cy, dx, dy, x, y]);
    }

    fn close(&mut self) {
        self.0.push('Z');
    }
}
