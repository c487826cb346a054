//! Converts an SVG to PNG with resvg and only the bundled font, so that the bytes are the same on
//! every machine.

use png::{
    BitDepth, ColorType, Compression, Encoder, EncodingError, Filter, PixelDimensions, Unit,
};
use rayon::prelude::*;
use resvg::tiny_skia::{Color, Pixmap, PremultipliedColorU8, Transform};
use resvg::usvg::{ImageHrefResolver, ImageKind, Options, Tree};

use crate::canvas::setting::fonts;
use crate::canvas::text::FAMILY;
use crate::error::PlotError;
use crate::limits::MAX_SIDE_PX;

/// Pixels per inch of an SVG.
const SVG_DPI: f32 = 96.0;
const INCH_M: f64 = 0.0254;

/// Renders an SVG as PNG on white with this many pixels per inch, which the PNG records.
pub(crate) fn render(svg: &str, dpi: f32) -> Result<Vec<u8>, PlotError> {
    let tree = Tree::from_str(svg, &options()).map_err(|error| PlotError::Svg(Box::new(error)))?;
    let scale = dpi / SVG_DPI;
    let size = tree.size();
    let (width, height) = sides(dpi, (size.width() / SVG_DPI, size.height() / SVG_DPI))?;
    let pixmap = Pixmap::new(width as u32, height as u32);
    let mut pixmap = pixmap.ok_or(PlotError::Size { dpi, width, height })?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    encode(&pixmap, dpi).map_err(|error| PlotError::Encode(Box::new(error)))
}

/// The number of rows that are rendered together.
const BLOCK_ROWS: u32 = 256;

/// The number of rows above and below them that are rendered too, because the ends of lines that
/// are cut off at the border of a picture are not exact.
const BESIDE_ROWS: u32 = 16;

/// Renders an SVG without paper, as a picture of this width and height in pixels, and passes its
/// rows to `take`. The results, from the top, do not depend on the number of threads.
pub(crate) fn render_rows<T: Send>(
    svg: &str,
    (width, height): (u32, u32),
    take: impl Fn(&[PremultipliedColorU8]) -> T + Sync,
) -> Result<Vec<T>, PlotError> {
    let tree = Tree::from_str(svg, &options()).map_err(|error| PlotError::Svg(Box::new(error)))?;
    let size = tree.size();
    let scale = (width as f32 / size.width(), height as f32 / size.height());
    let block = |first: u32| {
        let rows = BLOCK_ROWS.min(height - first);
        let pixmap = Pixmap::new(width, rows + 2 * BESIDE_ROWS);
        let mut pixmap = pixmap.ok_or_else(|| PlotError::Size {
            dpi: SVG_DPI,
            width: width as f32,
            height: rows as f32,
        })?;
        let down = BESIDE_ROWS as f32 - first as f32;
        let place = Transform::from_row(scale.0, 0.0, 0.0, scale.1, 0.0, down);
        resvg::render(&tree, place, &mut pixmap.as_mut());
        let all = pixmap.pixels().chunks_exact(width as usize);
        Ok(all.skip(BESIDE_ROWS as usize).take(rows as usize).map(&take).collect::<Vec<T>>())
    };
    let firsts: Vec<u32> = (0..height).step_by(BLOCK_ROWS as usize).collect();
    let blocks: Result<Vec<Vec<T>>, PlotError> = firsts.into_par_iter().map(block).collect();
    Ok(blocks?.into_iter().flatten().collect())
}

/// The sides in pixels of a picture of a size in inches.
pub(crate) fn sides(dpi: f32, (width_in, height_in): (f32, f32)) -> Result<(f32, f32), PlotError> {
    // Half a hundredth of a pixel is not a pixel more: sizes in inches are rounded.
    let side = |inches: f32| (inches * SVG_DPI * (dpi / SVG_DPI) - 0.005).ceil();
    let (width, height) = (side(width_in), side(height_in));
    let sides = 1.0..=MAX_SIDE_PX;
    if sides.contains(&width) && sides.contains(&height) {
        Ok((width, height))
    } else {
        Err(PlotError::Size { dpi, width, height })
    }
}

/// Encodes an opaque picture without its alpha.
fn encode(pixmap: &Pixmap, dpi: f32) -> Result<Vec<u8>, EncodingError> {
    let mut png = Vec::new();
    let mut encoder = Encoder::new(&mut png, pixmap.width(), pixmap.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    // Flat areas compress better without a filter than with any.
    encoder.set_filter(Filter::NoFilter);
    let per_metre = (f64::from(dpi) / INCH_M).round() as u32;
    let resolution = PixelDimensions { xppu: per_metre, yppu: per_metre, unit: Unit::Meter };
    encoder.set_pixel_dims(Some(resolution));
    let mut writer = encoder.write_header()?;
    let colours = pixmap.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]);
    writer.write_image_data(&colours.collect::<Vec<u8>>())?;
    writer.finish()?;
    Ok(png)
}

/// Options with the bundled font and with embedded pictures only: neither system fonts nor files
/// that an SVG may name.
fn options() -> Options<'static> {
    Options {
        font_family: FAMILY.to_owned(),
        fontdb: fonts(),
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

    fn pixels(svg: &str, dpi: f32) -> Pixmap {
        Pixmap::decode_png(&render(svg, dpi).unwrap()).unwrap()
    }

    #[test]
    fn has_its_size_and_is_white_with_text_in_ink() {
        let picture = pixels(SVG, 192.0);
        assert_eq!((picture.width(), picture.height()), (80, 60));
        assert!(picture.pixels().iter().all(|p| p.alpha() == 255));
        assert_eq!(picture.pixel(0, 0).unwrap().red(), 255);
        let dark = |svg| pixels(svg, 192.0).pixels().iter().filter(|p| p.red() < 100).count();
        assert!(dark(SVG) > 100, "the bundled font");
        let shorter: &str = &SVG.replace("Hm∞", "Hm");
        assert!(dark(shorter) + 20 < dark(SVG), "∞ has ink");
    }

    #[test]
    fn records_its_resolution() {
        let svg = SVG.replace("\"40\"", "\"0.5in\"").replace("\"30\"", "\"0.3333in\"");
        let bytes = render(&svg, 300.0).unwrap();
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let info = reader.info();
        assert_eq!((info.width, info.height), (150, 100));
        let dimensions = info.pixel_dims.unwrap();
        assert_eq!(
            (dimensions.xppu, dimensions.yppu, dimensions.unit),
            (11811, 11811, Unit::Meter)
        );
    }

    #[test]
    fn refuses_resolutions_that_make_no_picture() {
        assert!(matches!(render("<svg", 96.0), Err(PlotError::Svg(_))));
        for dpi in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
            assert!(matches!(render(SVG, dpi), Err(PlotError::Size { .. })), "{dpi}");
        }
        assert!(render(SVG, 3.0).is_ok_and(|png| !png.is_empty()));
    }
}
