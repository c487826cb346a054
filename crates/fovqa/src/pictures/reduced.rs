//! Pictures as the page of a run shows them: reduced in linear light, and compressed without loss.

use std::io;
use std::sync::LazyLock;

use fast_image_resize::images::Image;
use fast_image_resize::{FilterType, PixelType, ResizeAlg, ResizeOptions, Resizer};
use fovqa_frame::transfer::srgb;
use fovqa_frame::{Channels, Frame, Samples};
use image_webp::{ColorType, WebPDecoder, WebPEncoder};

/// Linear light of each 8-bit code, in 1/65535. Integers, because a sum of integers does not depend on
/// its order: the picture is the same on every machine.
static LINEAR: LazyLock<[u16; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| (srgb::decode(code as f64 / 255.0) * 65535.0).round() as u16)
});

/// The 8-bit code of each amount of linear light.
static CODES: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let code = |light: u32| (srgb::encode(f64::from(light) / 65535.0) * 255.0).round() as u8;
    (0..=65535).map(code).collect()
});

/// A reduced picture of 8-bit codes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Small {
    /// Width and height in pixels.
    pub(crate) size: [usize; 2],
    pub(crate) channels: Channels,
    /// The codes, interleaved.
    pub(crate) codes: Vec<u8>,
}

impl Small {
    /// The picture as lossless WebP.
    ///
    /// # Errors
    /// If it is too large for the format.
    pub(crate) fn webp(&self) -> io::Result<Vec<u8>> {
        let color = match self.channels {
            Channels::Gray => ColorType::L8,
            Channels::Rgb => ColorType::Rgb8,
        };
        let [width, height] = self.size.map(|side| side as u32);
        let mut file = Vec::new();
        let encoder = WebPEncoder::new(&mut file);
        encoder.encode(&self.codes, width, height, color).map_err(io::Error::other)?;
        Ok(file)
    }

    /// Reads what [`Small::webp`] has written.
    ///
    /// # Errors
    /// If it is damaged, or has more than `most` pixels on a side.
    pub(crate) fn read(file: &[u8], most: usize) -> io::Result<Self> {
        let mut decoder = WebPDecoder::new(io::Cursor::new(file)).map_err(io::Error::other)?;
        let (width, height) = decoder.dimensions();
        let size = [width as usize, height as usize];
        let bytes =
            decoder.output_buffer_size().filter(|_| size.into_iter().all(|side| side <= most));
        let mut codes = vec![0; bytes.ok_or_else(|| io::Error::other("it is too large"))?];
        decoder.read_image(&mut codes).map_err(io::Error::other)?;
        // The format has no gray: every picture comes back with three channels or four.
        if decoder.has_alpha() {
            let opaque = codes.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec());
            codes = opaque.collect();
        }
        Ok(Self { size, channels: Channels::Rgb, codes })
    }
}

/// A picture of 8-bit codes as lossless WebP whose longer side has at most `size` pixels.
///
/// # Errors
/// If the frame does not hold 8-bit codes, or is too large for the format.
pub(super) fn reduced(frame: &Frame, size: usize) -> io::Result<Vec<u8>> {
    small(frame, size)?.webp()
}

/// A picture of 8-bit codes whose longer side has at most `size` pixels.
///
/// # Errors
/// If the frame does not hold 8-bit codes.
pub(crate) fn small(frame: &Frame, size: usize) -> io::Result<Small> {
    let Samples::U8(codes) = frame.samples() else {
        return Err(io::Error::other("a picture holds codes of 8 bits"));
    };
    let pixels = match frame.channels() {
        Channels::Gray => PixelType::U16,
        Channels::Rgb => PixelType::U16x3,
    };
    let from = [frame.width(), frame.height()];
    if codes.len() != from[0] * from[1] * frame.channels().count() {
        return Err(io::Error::other("a picture is not cropped"));
    }
    let to = smaller(from, size);
    let codes = if from == to { codes.to_vec() } else { resized(codes, (from, to), pixels)? };
    Ok(Small { size: to, channels: frame.channels(), codes })
}

/// Width and height with a longer side of at most `size`.
fn smaller([width, height]: [usize; 2], size: usize) -> [usize; 2] {
    let longer = width.max(height);
    if longer <= size {
        return [width, height];
    }
    [width, height].map(|side| ((side * size + longer / 2) / longer).max(1))
}

fn resized(
    codes: &[u8],
    (from, to): ([usize; 2], [usize; 2]),
    pixels: PixelType,
) -> io::Result<Vec<u8>> {
    let linear = codes.iter().flat_map(|code| LINEAR[usize::from(*code)].to_ne_bytes()).collect();
    let [from, to] = [from, to].map(|[w, h]| (w as u32, h as u32));
    let source = Image::from_vec_u8(from.0, from.1, linear, pixels).map_err(io::Error::other)?;
    let mut small = Image::new(to.0, to.1, pixels);
    // Hamming neither rings nor shifts edges, which would look like an error of the method.
    let options = ResizeOptions::new().resize_alg(ResizeAlg::Convolution(FilterType::Hamming));
    Resizer::new().resize(&source, &mut small, &options).map_err(io::Error::other)?;
    let light = small.buffer().chunks_exact(2).map(|pair| u16::from_ne_bytes([pair[0], pair[1]]));
    Ok(light.map(|light| CODES[usize::from(light)]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: usize, height: usize, code: impl Fn(usize, usize) -> u8) -> Frame {
        let codes = (0..width * height).flat_map(|i| [code(i % width, i / width); 3]).collect();
        Frame::new(width, height, Channels::Rgb, Samples::U8(codes)).unwrap()
    }

    fn decoded(file: &[u8]) -> (usize, usize, Vec<u8>) {
        let mut decoder = image_webp::WebPDecoder::new(io::Cursor::new(file)).unwrap();
        let (width, height) = decoder.dimensions();
        let mut codes = vec![0; decoder.output_buffer_size().unwrap()];
        decoder.read_image(&mut codes).unwrap();
        (width as usize, height as usize, codes)
    }

    #[test]
    fn light_is_averaged_and_not_codes() {
        // Black and white lines of one pixel: half the light, which is code 188 and not 128.
        let lines = frame(400, 300, |_, y| if y % 2 == 0 { 0 } else { 255 });
        let (width, height, codes) = decoded(&reduced(&lines, 100).unwrap());
        assert_eq!((width, height), (100, 75));
        let middle = codes[(37 * width + 50) * 3];
        assert!(middle.abs_diff(188) <= 2, "{middle}");
    }

    #[test]
    fn a_small_picture_keeps_its_pixels() {
        let ramp = frame(40, 20, |x, y| (x * 6 + y) as u8);
        let (width, height, codes) = decoded(&reduced(&ramp, 512).unwrap());
        assert_eq!((width, height), (40, 20));
        let Samples::U8(original) = ramp.samples() else { unreachable!() };
        assert_eq!(codes, **original);
    }

    #[test]
    fn the_longer_side_has_the_size() {
        assert_eq!(smaller([1440, 1600], 512), [461, 512]);
        assert_eq!(smaller([11520, 6480], 512), [512, 288]);
        assert_eq!(smaller([9000, 1], 512), [512, 1]);
    }
}
