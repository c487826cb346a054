//! A drawing at its size in print, and the files made of it.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use resvg::tiny_skia::PremultipliedColorU8;

use crate::canvas::drawing::{Drawing, Mark};
use crate::canvas::setting::SetLine;
use crate::canvas::{pdf, png, svg};
use crate::error::PlotError;

/// Points per inch.
pub(crate) const PT_PER_IN: f64 = 72.0;

/// Points per pixel of a drawing whose pixels are those of an SVG.
pub(crate) const PT_PER_PX: f64 = 0.75;

/// A figure that was laid out for a size in print.
#[derive(Debug, Clone, PartialEq)]
pub struct Printed {
    pub(crate) drawing: Drawing,
    /// Points in print per pixel of the drawing.
    pub(crate) pt_per_px: f64,
    /// Its lines of text in the order of the drawing, which take the most time to set.
    lines: OnceLock<Vec<SetLine>>,
}

impl Printed {
    pub(crate) fn new(drawing: Drawing, pt_per_px: f64) -> Self {
        Self { drawing, pt_per_px, lines: OnceLock::new() }
    }

    fn lines(&self) -> &[SetLine] {
        self.lines.get_or_init(|| {
            let set = |mark: &Mark| match mark {
                Mark::Text(text) => Some(SetLine::new(&text.line, text.anchor)),
                Mark::Line(..)
                | Mark::Area(..)
                | Mark::Disc(..)
                | Mark::Picture(..)
                | Mark::Photo(..) => None,
            };
            self.drawing.marks.iter().filter_map(set).collect()
        })
    }

    /// Its width and height in inches.
    pub fn size_in(&self) -> (f64, f64) {
        let inches = |px: f64| px * self.pt_per_px / PT_PER_IN;
        (inches(self.drawing.width_px), inches(self.drawing.height_px))
    }

    /// The characters in it that the bundled font lacks. In PDF and PNG they are
    /// boxes; an SVG leaves them to the fonts of the viewer.
    pub fn missing_characters(&self) -> BTreeSet<char> {
        let glyphs = self.lines().iter().flat_map(|line| &line.glyphs);
        glyphs.filter(|glyph| glyph.id == 0).flat_map(|glyph| glyph.text.chars()).collect()
    }

    /// Checks that a PNG with this many pixels per inch is not too large.
    ///
    /// # Errors
    /// When it would have no pixels or a side above 16384.
    pub fn check_png(&self, dpi: f32) -> Result<(), PlotError> {
        let (width, height) = self.size_in();
        png::sides(dpi, (width as f32, height as f32)).map(|_| ())
    }

    /// Its width in the pixels of a screen, at which its smallest text has 11 pixels.
    pub fn screen_width_px(&self) -> f64 {
        self.drawing.width_px
    }

    /// The figure as an SVG document, which is the same on any machine. Text is drawn as outlines
    /// of the bundled font, so that it needs no installed font; its words are in the attribute
    /// `aria-label`.
    ///
    /// # Errors
    /// When a picture in it cannot be encoded.
    pub fn svg(&self) -> Result<String, PlotError> {
        svg::write(&self.drawing, self.lines(), self.pt_per_px)
    }

    /// The figure without paper as a picture with this width and height in pixels: its rows, as
    /// `take` returns them.
    pub(crate) fn rows<T: Send>(
        &self,
        size: (u32, u32),
        take: impl Fn(&[PremultipliedColorU8]) -> T + Sync,
    ) -> Result<Vec<T>, PlotError> {
        let svg = svg::write_on(None, &self.drawing, self.lines(), self.pt_per_px)?;
        png::render_rows(&svg, size, take)
    }

    /// The figure as a PDF of one page, with text as text in the bundled font, of which the part
    /// that is used is embedded. `title` is for the properties of the document.
    ///
    /// # Errors
    /// When the font cannot be embedded.
    pub fn pdf(&self, title: &str) -> Result<Vec<u8>, PlotError> {
        pdf::write(&self.drawing, self.lines(), (self.pt_per_px, title))
    }

    /// The figure as a PNG with this many pixels per inch, which it records.
    ///
    /// # Errors
    /// When the picture would have no pixels or a side above 16384.
    pub fn png(&self, dpi: f32) -> Result<Vec<u8>, PlotError> {
        png::render(&self.svg()?, dpi)
    }
}
