//! A picture of colours, such as a region of a frame, for embedding into an SVG or a PDF.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};

use crate::error::PlotError;

/// The smallest number of embedded pixels per pixel of the figure. If a viewer interpolates between
/// pixels, it then blurs a fraction of a pixel of the picture.
const SHARPNESS: f64 = 2.0;

/// Pixels row by row from the upper left.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Photo {
    /// Width in pixels.
    pub width: usize,
    /// Red, green and blue of each pixel, in sRGB. The height follows from their number; pixels
    /// beyond the last complete row are ignored.
    pub rgb: Vec<[u8; 3]>,
}

impl Photo {
    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.rgb.len().checked_div(self.width).unwrap_or(0)
    }

    /// Width, height and samples of the picture for an area of this width. Every pixel becomes a
    /// square of several.
    pub(crate) fn enlarged(&self, width_px: f64) -> (usize, usize, Vec<u8>) {
        let times = (width_px * SHARPNESS / self.width.max(1) as f64).ceil().max(1.0) as usize;
        let mut samples = Vec::with_capacity(self.rgb.len() * times * times * 3);
        for row in self.rgb.chunks_exact(self.width.max(1)) {
            let line: Vec<u8> =
                row.iter().flat_map(|pixel| std::iter::repeat_n(*pixel, times)).flatten().collect();
            (0..times).for_each(|_| samples.extend_from_slice(&line));
        }
        (self.width * times, self.height() * times, samples)
    }

    /// The picture as a data URI of a PNG, for an area of this width.
    pub(crate) fn data_uri(&self, width_px: f64) -> Result<String, PlotError> {
        let encoded = self.png(width_px);
        let png = encoded.map_err(|error| PlotError::Encode(Box::new(error)))?;
        Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
    }

    fn png(&self, width_px: f64) -> Result<Vec<u8>, EncodingError> {
        let (width, height, samples) = self.enlarged(width_px);
        let mut png = Vec::new();
        let mut encoder = Encoder::new(&mut png, width as u32, height as u32);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&samples)?;
        writer.finish()?;
        Ok(png)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_is_a_square() {
        let rgb = vec![[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12]];
        let photo = Photo { width: 2, rgb };
        let (width, height, samples) = photo.enlarged(3.0);
        assert_eq!((photo.height(), width, height), (2, 6, 6));
        let at = |x: usize, y: usize| &samples[3 * (y * width + x)..3 * (y * width + x) + 3];
        assert_eq!(
            (at(0, 0), at(2, 2), at(3, 0), at(5, 5)),
            (&[1, 2, 3][..], &[1, 2, 3][..], &[4, 5, 6][..], &[10, 11, 12][..])
        );
        let pixmap = resvg::tiny_skia::Pixmap::decode_png(&photo.png(3.0).unwrap()).unwrap();
        assert_eq!(pixmap.pixel(0, 5).unwrap().green(), 8);
        assert_eq!(Photo::default().height(), 0);
    }
}
