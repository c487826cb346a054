//! Maps of values and of colours as files.

use std::io::{self, Cursor};

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use half::f16;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// Encodes interleaved codes as an 8-bit RGB PNG.
///
/// # Errors
/// When the number of codes is not `3 * width * height`.
pub fn png_rgb8(width: usize, height: usize, codes: &[u8]) -> io::Result<Vec<u8>> {
    let mut file = Vec::new();
    if codes.len() != 3 * width * height {
        return Err(io::Error::other("not three codes per pixel"));
    }
    PngEncoder::new(&mut file)
        .write_image(codes, width as u32, height as u32, ExtendedColorType::Rgb8)
        .map_err(io::Error::other)?;
    Ok(file)
}

/// Encodes values, row by row, as an OpenEXR file with one channel `Y`.
///
/// # Errors
/// When there are not `width * height` values.
pub fn exr_gray(width: usize, height: usize, values: &[f32]) -> io::Result<Vec<u8>> {
    exr_of((width, height), FlatSamples::F32(values.to_vec()))
}

/// Encodes values as [`exr_gray`] does, rounded to half floats.
///
/// # Errors
/// When there are not `width * height` values.
pub fn exr_gray_half(width: usize, height: usize, values: &[f32]) -> io::Result<Vec<u8>> {
    let values = values.iter().map(|value| f16::from_f32(*value)).collect();
    exr_of((width, height), FlatSamples::F16(values))
}

fn exr_of((width, height): (usize, usize), values: FlatSamples) -> io::Result<Vec<u8>> {
    if values.len() != width * height {
        return Err(io::Error::other("not one value per pixel"));
    }
    let channels = AnyChannels::sort(std::iter::once(AnyChannel::new("Y", values)).collect());
    let encoding = Encoding::SMALL_FAST_LOSSLESS;
    let layer = Layer::new((width, height), LayerAttributes::default(), encoding, channels);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(io::Error::other)?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, read_frame};
    use fovqa_frame::{Channels, Samples};

    #[test]
    fn written_pictures_are_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let read = |name: &str, bytes: Vec<u8>| {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            read_frame(&path, &ReadOptions::default()).unwrap().frame
        };
        let codes: Vec<u8> = (0..5 * 3 * 3).map(|code| code * 5).collect();
        let frame = read("a.png", png_rgb8(5, 3, &codes).unwrap());
        assert_eq!(frame.samples(), &Samples::U8(codes.into()));
        let values: Vec<f32> = (0..15).map(|v| v as f32 / 7.0).collect();
        let frame = read("a.exr", exr_gray_half(5, 3, &values).unwrap());
        let halves = values.iter().map(|value| f16::from_f32(*value)).collect();
        assert_eq!((frame.channels(), frame.samples()), (Channels::Gray, &Samples::F16(halves)));
        let frame = read("a.exr", exr_gray(5, 3, &values).unwrap());
        assert_eq!(frame.samples(), &Samples::F32(values.into()));
        assert!(png_rgb8(5, 3, &[0; 4]).is_err() && exr_gray(2, 2, &[]).is_err());
    }
}
