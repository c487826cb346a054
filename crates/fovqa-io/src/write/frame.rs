//! A frame as a file.

use fovqa_frame::{Frame, Samples};

use super::error::EncodeError;
use super::format::FrameFormat;
use super::{exr_frame, jpeg_frame, png_frame};

/// Encodes the visible part of a frame as a file. Samples are written as they are: codes of 8 or 16
/// bits as PNG, codes of 8 bits as JPEG, linear light in half floats or floats as OpenEXR.
///
/// # Errors
/// If the format cannot hold the samples or the size of the frame.
pub fn encode_frame(frame: &Frame, format: FrameFormat) -> Result<Vec<u8>, EncodeError> {
    let refused = || EncodeError::Samples { format, samples: samples_of(frame) };
    let detail = match (format, frame.samples()) {
        (FrameFormat::Png, Samples::U8(codes)) => png_frame::codes8(frame, codes),
        (FrameFormat::Png, Samples::U16(codes)) => png_frame::codes16(frame, codes),
        (FrameFormat::Jpeg, Samples::U8(codes)) => {
            let (width, height) = (frame.width(), frame.height());
            let size = || EncodeError::Size { format, width, height };
            let short = |side: usize| u16::try_from(side).map_err(|_| size());
            jpeg_frame::codes8(frame, [short(width)?, short(height)?], codes)
        }
        (FrameFormat::Exr, Samples::F16(values)) if !frame.is_encoded() => {
            exr_frame::halves(frame, values)
        }
        (FrameFormat::Exr, Samples::F32(values)) if !frame.is_encoded() => {
            exr_frame::floats(frame, values)
        }
        (FrameFormat::Png | FrameFormat::Jpeg | FrameFormat::Exr, _) => return Err(refused()),
    };
    detail.map_err(|detail| EncodeError::Encoder { format, detail })
}

/// What a frame holds, in words.
fn samples_of(frame: &Frame) -> &'static str {
    match (frame.samples(), frame.is_encoded()) {
        (Samples::U8(_), _) => "codes of 8 bits",
        (Samples::U16(_), _) => "codes of 16 bits",
        (Samples::F16(_) | Samples::F32(_), false) => "linear light in floats",
        (Samples::F16(_) | Samples::F32(_), true) => "encoded values in floats",
    }
}

#[cfg(test)]
mod tests {
    use fovqa_frame::{Channels, Crop};
    use half::f16;

    use super::*;
    use crate::{ReadOptions, read_frame};

    const CHANNELS: [Channels; 2] = [Channels::Gray, Channels::Rgb];

    fn read_back(frame: &Frame, format: FrameFormat) -> Frame {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("frame.{}", format.endings()[0]));
        std::fs::write(&path, encode_frame(frame, format).unwrap()).unwrap();
        read_frame(&path, &ReadOptions::default()).unwrap().frame
    }

    /// A frame of 13 x 7 whose samples all differ.
    fn frame(channels: Channels, samples: impl Fn(usize) -> Samples) -> Frame {
        Frame::new(13, 7, channels, samples(13 * 7 * channels.count())).unwrap()
    }

    #[test]
    fn codes_and_floats_come_back_to_the_bit() {
        for channels in CHANNELS {
            let eight = frame(channels, |n| Samples::U8((0..n).map(|i| (i * 7) as u8).collect()));
            assert_eq!(read_back(&eight, FrameFormat::Png), eight);
            let sixteen =
                frame(channels, |n| Samples::U16((0..n).map(|i| (i * 239) as u16).collect()));
            assert_eq!(read_back(&sixteen, FrameFormat::Png), sixteen);
            let value = |i: usize| i as f32 * 0.37 - 1.0;
            let floats = frame(channels, |n| Samples::F32((0..n).map(value).collect()));
            assert_eq!(read_back(&floats, FrameFormat::Exr), floats);
            let halves = frame(channels, |n| {
                Samples::F16((0..n).map(|i| f16::from_f32(value(i))).collect())
            });
            assert_eq!(read_back(&halves, FrameFormat::Exr), halves);
        }
    }

    #[test]
    fn only_the_visible_part_is_written() {
        let crop = Crop { x: 2, y: 1, width: 8, height: 5 };
        for channels in CHANNELS {
            let samples: [fn(usize) -> Samples; 4] = [
                |n| Samples::U8((0..n).map(|i| i as u8).collect()),
                |n| Samples::U16((0..n).map(|i| i as u16).collect()),
                |n| Samples::F16((0..n).map(|i| f16::from_f32(i as f32)).collect()),
                |n| Samples::F32((0..n).map(|i| i as f32).collect()),
            ];
            for samples in samples {
                let cut = frame(channels, samples).cropped(crop).unwrap();
                let format = if cut.is_encoded() { FrameFormat::Png } else { FrameFormat::Exr };
                let back = read_back(&cut, format);
                assert_eq!(back.file_size(), (8, 5));
                for (y, x) in (0..5).flat_map(|y| (0..8).map(move |x| (y, x))) {
                    for c in 0..channels.count() {
                        assert_eq!(back.sample(c, x, y).to_bits(), cut.sample(c, x, y).to_bits());
                    }
                }
            }
        }
    }

    /// Colours that differ from pixel to pixel: subsampled chroma would be far off.
    #[test]
    fn a_jpeg_stays_within_three_codes() {
        for channels in CHANNELS {
            let codes = |n| (0..n).map(|i| (i * 89 % 251) as u8).collect();
            let before = frame(channels, |n| Samples::U8(codes(n)));
            let after = read_back(&before, FrameFormat::Jpeg);
            assert_eq!(after.channels(), channels);
            let (Samples::U8(before), Samples::U8(after)) = (before.samples(), after.samples())
            else {
                panic!("a JPEG has codes of 8 bits")
            };
            let farthest = before.iter().zip(after).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(farthest <= Some(3), "{channels:?}: {farthest:?}");
        }
    }

    #[test]
    fn a_format_refuses_what_it_cannot_hold() {
        let codes8 = frame(Channels::Gray, |n| Samples::U8(vec![0; n].into()));
        let codes16 = frame(Channels::Gray, |n| Samples::U16(vec![0; n].into()));
        let linear = frame(Channels::Gray, |n| Samples::F32(vec![0.0; n].into()));
        let signal = linear.clone().encoded();
        let refused = [
            (&codes16, FrameFormat::Jpeg, "JPEG files cannot hold codes of 16 bits"),
            (&linear, FrameFormat::Jpeg, "JPEG files cannot hold linear light in floats"),
            (&linear, FrameFormat::Png, "PNG files cannot hold linear light in floats"),
            (&signal, FrameFormat::Png, "PNG files cannot hold encoded values in floats"),
            (&signal, FrameFormat::Exr, "OpenEXR files cannot hold encoded values in floats"),
            (&codes8, FrameFormat::Exr, "OpenEXR files cannot hold codes of 8 bits"),
        ];
        for (frame, format, message) in refused {
            let error = encode_frame(frame, format).unwrap_err();
            assert_eq!(error.to_string(), message);
            assert!(!error.help().is_empty());
        }
        let wide =
            Frame::new(70_000, 1, Channels::Gray, Samples::U8(vec![0; 70_000].into())).unwrap();
        let error = encode_frame(&wide, FrameFormat::Jpeg).unwrap_err();
        assert_eq!(error.to_string(), "JPEG files cannot hold a frame of 70000x1");
    }

    #[test]
    fn a_format_is_named_by_the_ending() {
        let of = |name: &str| FrameFormat::of_path(name.as_ref());
        assert_eq!(of("a/b.PNG").unwrap(), FrameFormat::Png);
        assert_eq!(of("b.0001.jpeg").unwrap(), FrameFormat::Jpeg);
        assert_eq!(of("b.jpg").unwrap(), FrameFormat::Jpeg);
        assert_eq!(of("b.exr").unwrap(), FrameFormat::Exr);
        assert!(matches!(of("b.y4m"), Err(EncodeError::Video { .. })));
        assert!(matches!(of("b.tiff"), Err(EncodeError::UnknownEnding { .. })));
        assert!(matches!(of("png"), Err(EncodeError::UnknownEnding { .. })));
    }
}
