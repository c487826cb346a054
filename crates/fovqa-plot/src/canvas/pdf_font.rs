//! The part of the bundled font that a PDF uses, embedded in it.

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Name, Pdf, Rect, Ref, Str};
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::{FontRef, GlyphId, MetadataProvider};
use subsetter::{GlyphRemapper, subset};

use crate::canvas::setting::Glyph;
use crate::canvas::text::FONT;
use crate::error::PlotError;

/// How hard the font is compressed, from 0 to 10.
const LEVEL: u8 = 8;
/// Sizes in a PDF are in thousandths of the font size.
const PER_EM: f32 = 1000.0;
/// The strength of upright strokes of DejaVu Sans, in thousandths of the font size.
const STEM_V: f32 = 90.0;
const IDENTITY: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The glyphs that a document uses.
pub(crate) struct Embedded {
    face: Option<FontRef<'static>>,
    codes: GlyphRemapper,
    /// The characters of each code.
    texts: BTreeMap<u16, String>,
}

impl Default for Embedded {
    fn default() -> Self {
        Self { face: FontRef::new(FONT).ok(), codes: GlyphRemapper::new(), texts: BTreeMap::new() }
    }
}

impl Embedded {
    pub(crate) fn is_empty(&self) -> bool {
        self.texts.is_empty()
    }

    /// Adds a glyph. Returns its code in the document and its advance width, in units of the font
    /// size.
    pub(crate) fn add(&mut self, glyph: &Glyph) -> (u16, f64) {
        let code = self.codes.remap(glyph.id);
        let known = self.texts.entry(code).or_default();
        if known.is_empty() && glyph.id != 0 {
            known.clone_from(&glyph.text);
        }
        (code, f64::from(self.advance_em(glyph.id)))
    }

    fn metrics(&self) -> Option<GlyphMetrics<'static>> {
        // With a size of 1, widths are in units of the font size.
        Some(self.face.as_ref()?.glyph_metrics(Size::new(1.0), LocationRef::default()))
    }

    fn advance_em(&self, id: u16) -> f32 {
        let width = |of: GlyphMetrics<'_>| of.advance_width(GlyphId::from(id));
        self.metrics().and_then(width).unwrap_or(1.0)
    }

    /// Writes the objects of the font.
    pub(crate) fn write(&self, pdf: &mut Pdf, font: Ref, next: &mut Ref) -> Result<(), PlotError> {
        let [descendant, descriptor, file, characters] = [(); 4].map(|()| next.bump());
        let part = subset(FONT, 0, &self.codes).map_err(|e| PlotError::Draw(Box::new(e)))?;
        let name = format!("{}+DejaVuSans", self.tag());
        let name = Name(name.as_bytes());

        pdf.type0_font(font)
            .base_font(name)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(descendant)
            .to_unicode(characters);
        let mut cid = pdf.cid_font(descendant);
        cid.subtype(CidFontType::Type2).base_font(name).system_info(IDENTITY);
        cid.font_descriptor(descriptor).default_width(0.0);
        cid.cid_to_gid_map_predefined(Name(b"Identity"));
        let ids: Vec<u16> = self.codes.remapped_gids().collect();
        let widths = ids.iter().map(|id| (self.advance_em(*id) * PER_EM).round());
        cid.widths().consecutive(0, widths);
        drop(cid);

        let metrics =
            self.face.as_ref().map(|face| face.metrics(Size::new(PER_EM), LocationRef::default()));
        let metrics = metrics.unwrap_or_default();
        let bounds = metrics.bounds.unwrap_or_default();
        pdf.font_descriptor(descriptor)
            .name(name)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(
                bounds.x_min.floor(),
                bounds.y_min.floor(),
                bounds.x_max.ceil(),
                bounds.y_max.ceil(),
            ))
            .italic_angle(0.0)
            .ascent(metrics.ascent.round())
            .descent(metrics.descent.round())
            .cap_height(metrics.cap_height.unwrap_or(metrics.ascent).round())
            .stem_v(STEM_V)
            .font_file2(file);
        let packed = compress_to_vec_zlib(&part, LEVEL);
        pdf.stream(file, &packed)
            .filter(Filter::FlateDecode)
            .pair(Name(b"Length1"), part.len() as i32);

        let mut map = UnicodeCmap::<u16>::new(Name(b"Custom"), IDENTITY);
        for (code, text) in self.texts.iter().filter(|(_, text)| !text.is_empty()) {
            map.pair_with_multiple(*code, text.chars());
        }
        let map = compress_to_vec_zlib(&map.finish(), LEVEL);
        pdf.stream(characters, &map).filter(Filter::FlateDecode);
        Ok(())
    }

    /// Six letters that are the same for the same glyphs, as the format demands of font subsets.
    fn tag(&self) -> String {
        let ids = self.codes.remapped_gids();
        let mut hash = ids.fold(5381_u64, |hash, id| {
            hash.wrapping_mul(33).wrapping_add(u64::from(id)) % 308_915_776 // 26^6
        });
        let letter = |_| {
            let letter = b'A' + (hash % 26) as u8;
            hash /= 26;
            char::from(letter)
        };
        (0..6).map(letter).collect()
    }
}
