//! Converts an SVG to PNG with resvg and only the bundled font, so that the bytes are the same on
//! every machine.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, ImageKind, Options, Tree, fontdb::Database};

use crate::canvas::text::{FAMILY, FONT};
use crate::error::PlotError;
use crate::limits::MAX_SIDE_PX;

/// Renders an SVG as PNG on white, with `scale` pixels per SVG pixel.
///
/// # Errors
/// When the text is not SVG, or the picture would have no pixels or a side above 16384.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, PlotError> {
    let tree = Tree::from_str(svg, &options()).map_err(|error| PlotError::Svg(Box::new(error)))?;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let (width, height) = (width.ceil(), height.ceil());
    let sides = 1.0..=MAX_SIDE_PX;
    let pixmap = (sides.contains(&width) && sides.contains(&height))
        .then(|| Pixmap::new(width as u32, height as u32))
        .flatten();
    let mut pixmap = pixmap.ok_or(PlotError::Size { scale, width, height })?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| PlotError::Encode(Box::new(error)))
}

/// Options with the bundled font and with embedded pictures only: neither system fonts nor files
/// that an SVG may name.
fn options() -> Options<'static> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = Database::new();
        fonts.load_font_data(FONT.to_vec());
        Arc::new(fonts)
    });
    Options {
        font_family: FAMILY.to_owned(),
        fontdb: Arc::clone(fonts),
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|mime, data, _| {
                (mime == "image/png").then_some(ImageKind::PNG(data))
            }),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg width=\"40\" height=\"30\" xmlns=\"http://www.w3.org/2000/svg\">\
        <text x=\"2\" y=\"20\" font-family=\"DejaVu Sans, Verdana\" font-size=\"12\">Hm∞</text></svg>";

    fn pixels(svg: &str, scale: f32) -> Pixmap {
        Pixmap::decode_png(&png(svg, scale).unwrap()).unwrap()
    }

    #[test]
    fn has_its_size_and_is_white_with_text_in_ink() {
        let picture = pixels(SVG, 2.0);
        assert_eq!((picture.width(), picture.height()), (80, 60));
        assert!(picture.pixels().iter().all(|p| p.alpha() == 255));
        assert_eq!(picture.pixel(0, 0).unwrap().red(), 255);
        let dark = |svg| pixels(svg, 2.0).pixels().iter().filter(|p| p.red() < 100).count();
        assert!(dark(SVG) > 100, "the bundled font");
        let shorter: &str = &SVG.replace("Hm∞", "Hm");
        assert!(dark(shorter) + 20 < dark(SVG), "∞ has ink");
    }

    #[test]
    fn refuses_scales_that_make_no_picture() {
        assert!(matches!(png("<svg", 1.0), Err(PlotError::Svg(_))));
        for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
            assert!(matches!(png(SVG, scale), Err(PlotError::Size { .. })), "{scale}");
        }
        assert!(png(SVG, 0.01).is_ok_and(|png| !png.is_empty()));
    }
}
