//! A picture of equal cells, for embedding into an SVG or a PDF.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use crate::canvas::colour::Colour;
use crate::canvas::colour_map;
use crate::error::PlotError;

/// The smallest number of PNG pixels per pixel of the figure. If a viewer interpolates between
/// pixels, it then blurs half a pixel of the figure and not half a cell.
const SHARPNESS: f64 = 2.0;

/// Cells row by row from the upper left. Each cell is a level of the colour map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Bitmap {
    pub(crate) columns: usize,
    pub(crate) levels: Vec<u8>,
}

impl Bitmap {
    /// The picture as a data URI of a PNG, for an area of this width and height. Every cell has the
    /// same number of pixels.
    pub(crate) fn data_uri(&self, (width_px, height_px): (f64, f64)) -> Result<String, PlotError> {
        let encoded = self.png(width_px, height_px);
        let png = encoded.map_err(|error| PlotError::Encode(Box::new(error)))?;
        Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
    }

    /// Width, height and levels of the picture for an area of this width and height.
    pub(crate) fn enlarged(&self, (width_px, height_px): (f64, f64)) -> (usize, usize, Vec<u8>) {
        let columns = self.columns.max(1);
        let rows = self.levels.len() / columns;
        let times =
            |px: f64, cells: usize| (px * SHARPNESS / cells as f64).ceil().max(1.0) as usize;
        let (across, down) = (times(width_px, columns), times(height_px, rows.max(1)));
        let mut pixels = Vec::with_capacity(self.levels.len() * across * down);
        for row in self.levels.chunks_exact(columns) {
            let line: Vec<u8> =
                row.iter().flat_map(|level| std::iter::repeat_n(*level, across)).collect();
            (0..down).for_each(|_| pixels.extend_from_slice(&line));
        }
        (columns * across, rows * down, pixels)
    }

    fn png(&self, width_px: f64, height_px: f64) -> Result<Vec<u8>, png::EncodingError> {
        let (columns, rows, pixels) = self.enlarged((width_px, height_px));
        let mut png = Vec::new();
        let mut encoder = Encoder::new(&mut png, columns as u32, rows as u32);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Eight);
        let palette = colour_map::palette().into_iter();
        encoder.set_palette(palette.flat_map(|Colour(r, g, b)| [r, g, b]).collect::<Vec<u8>>());
        encoder.set_compression(Compression::Balanced);
        // Most rows are equal to the row above.
        encoder.set_filter(Filter::Up);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&pixels)?;
        writer.finish()?;
        Ok(png)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_is_whole_and_in_its_place() {
        let bitmap = Bitmap { columns: 3, levels: vec![0, 60, 120, 180, 254, 255] };
        let png = bitmap.png(10.0, 10.0).unwrap();
        let picture = resvg::tiny_skia::Pixmap::decode_png(&png).unwrap();
        assert_eq!((picture.width(), picture.height()), (21, 20));
        let palette = colour_map::palette();
        for (x, y) in (0..21).flat_map(|x| (0..20).map(move |y| (x, y))) {
            let pixel = picture.pixel(x, y).unwrap();
            let level = bitmap.levels[(y / 10 * 3 + x / 7) as usize];
            let found = Colour(pixel.red(), pixel.green(), pixel.blue());
            assert_eq!(found, palette[usize::from(level)], "{x} {y}");
        }
    }

    #[test]
    fn is_compact() {
        let levels = (0..200 * 200).map(|i| usize::midpoint(i % 200, i / 200) as u8).collect();
        let uri = Bitmap { columns: 200, levels }.data_uri((350.0, 350.0)).unwrap();
        assert!(uri.starts_with("data:image/png;base64,iVBOR"));
        assert!(uri.len() < 12_000, "{}", uri.len());
    }
}
