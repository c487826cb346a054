//! A picture as its file holds it, before any transfer function.

use std::ops::Range;

use half::f16;
use multiversion::multiversion;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::blocks::BLOCK_ROWS;
use crate::mask::Mask;

/// The colour channels of a frame: one of gray, or three with Rec.709 primaries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channels {
    /// One channel.
    Gray,
    /// Red, green, blue.
    Rgb,
}

impl Channels {
    /// The number of channels, 1 or 3.
    pub fn count(self) -> usize {
        match self {
            Channels::Gray => 1,
            Channels::Rgb => 3,
        }
    }

    /// The name of channel `index` in error messages.
    pub fn name(self, index: usize) -> &'static str {
        match self {
            Channels::Gray => "Y",
            Channels::Rgb => ["R", "G", "B"][index],
        }
    }
}

/// The samples of a frame, in the type and order in which the decoder leaves them.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// Codes 0..=255, channels interleaved.
    U8(Vec<u8>),
    /// Codes 0..=65535, channels interleaved.
    U16(Vec<u16>),
    /// Half floats, one plane after the other.
    F16(Vec<f16>),
    /// Floats, one plane after the other.
    F32(Vec<f32>),
}

impl Samples {
    /// Size of one sample in bytes.
    fn size(&self) -> usize {
        match self {
            Samples::U8(_) => 1,
            Samples::U16(_) | Samples::F16(_) => 2,
            Samples::F32(_) => 4,
        }
    }

    fn len(&self) -> usize {
        match self {
            Samples::U8(s) => s.len(),
            Samples::U16(s) => s.len(),
            Samples::F16(s) => s.len(),
            Samples::F32(s) => s.len(),
        }
    }

    /// Whether the samples are codes rather than floating-point values.
    pub fn is_integer(&self) -> bool {
        matches!(self, Samples::U8(_) | Samples::U16(_))
    }
}

/// A rectangle in pixels of the file's own frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Crop {
    /// Left edge.
    pub x: usize,
    /// Top edge.
    pub y: usize,
    /// Width, at least 1.
    pub width: usize,
    /// Height, at least 1.
    pub height: usize,
}

impl Crop {
    /// The same rectangle in the coordinates of the whole frame; `self` is given relative to the
    /// corner of `visible`.
    pub(crate) fn within(self, visible: Crop) -> Result<Crop, CropError> {
        let fits = |from: usize, length: usize, size: usize| {
            length > 0 && from.checked_add(length).is_some_and(|end| end <= size)
        };
        let (width, height) = (visible.width, visible.height);
        if !fits(self.x, self.width, width) || !fits(self.y, self.height, height) {
            return Err(CropError { crop: self, width, height });
        }
        Ok(Crop { x: visible.x + self.x, y: visible.y + self.y, ..self })
    }
}

/// The crop reaches beyond the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "the crop {},{},{},{} reaches beyond the frame of {width}x{height}",
    crop.x, crop.y, crop.width, crop.height
)]
pub struct CropError {
    /// The rectangle asked for.
    pub crop: Crop,
    /// Width of the frame.
    pub width: usize,
    /// Height of the frame.
    pub height: usize,
}

/// Samples that do not make a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum FrameError {
    /// The frame has no pixels.
    #[error("a frame of {width}x{height} has no pixels")]
    Empty {
        /// Declared width.
        width: usize,
        /// Declared height.
        height: usize,
    },
    /// The number of samples does not match the size.
    #[error("{found} samples for a frame that needs {expected}")]
    SampleCount {
        /// Samples given.
        found: usize,
        /// Number of samples for this width, height and number of channels.
        expected: usize,
    },
}

/// A NaN or an infinity in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadPixel {
    /// Channel name: `R`, `G`, `B` or `Y`.
    pub channel: &'static str,
    /// Column.
    pub x: usize,
    /// Row.
    pub y: usize,
    /// The value: NaN or an infinity.
    pub value: f32,
    /// Number of pixels of the frame with at least one such value.
    pub pixels: u64,
}

/// A decoded picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    width: usize,
    height: usize,
    channels: Channels,
    samples: Samples,
    /// Whether the samples are encoded for display rather than linear light.
    encoded: bool,
    /// The visible part, within `width` x `height`.
    crop: Crop,
}

impl Frame {
    /// Makes a frame of samples. Integer samples are taken as encoded, floats as linear light.
    ///
    /// # Errors
    /// When there are no pixels, or not `width * height * channels` samples.
    pub fn new(
        width: usize,
        height: usize,
        channels: Channels,
        samples: Samples,
    ) -> Result<Self, FrameError> {
        if width == 0 || height == 0 {
            return Err(FrameError::Empty { width, height });
        }
        let expected = width.checked_mul(height).and_then(|n| n.checked_mul(channels.count()));
        if Some(samples.len()) != expected {
            let expected = expected.unwrap_or(usize::MAX);
            return Err(FrameError::SampleCount { found: samples.len(), expected });
        }
        let crop = Crop { x: 0, y: 0, width, height };
        let encoded = samples.is_integer();
        Ok(Self { width, height, channels, samples, encoded, crop })
    }

    /// Marks the samples as encoded for display, even if they are floats. Such floats come from
    /// calculations with the codes of an 8- or 16-bit file, and rounding them would lose precision.
    #[must_use]
    pub fn encoded(self) -> Self {
        Self { encoded: true, ..self }
    }

    /// Whether the samples are encoded for display; the user's choice of transfer function
    /// overrides it.
    pub fn is_encoded(&self) -> bool {
        self.encoded
    }

    /// The same frame with only a rectangle of it visible. No sample is copied.
    ///
    /// # Errors
    /// When the rectangle is empty or reaches beyond the frame.
    pub fn cropped(mut self, crop: Crop) -> Result<Self, CropError> {
        self.crop = crop.within(self.crop)?;
        Ok(self)
    }

    /// A rectangle of the visible part as a frame of its own. Only its samples are copied.
    ///
    /// # Errors
    /// When the rectangle is empty or reaches beyond the frame.
    pub fn part(&self, crop: Crop) -> Result<Self, CropError> {
        let Crop { x, y, width, height } = crop.within(self.crop)?;
        let count = self.channels.count();
        let row = |y: usize| y * self.width + x..y * self.width + x + width;
        let rows = || (y..y + height).map(row);
        let interleaved = || rows().map(|row| row.start * count..row.end * count);
        let planes = || {
            let plane = |c: usize| c * self.plane_len();
            let of_plane = move |c| rows().map(move |row| plane(c) + row.start..plane(c) + row.end);
            (0..count).flat_map(of_plane)
        };
        let samples = match &self.samples {
            Samples::U8(s) => Samples::U8(copied(s, interleaved())),
            Samples::U16(s) => Samples::U16(copied(s, interleaved())),
            Samples::F16(s) => Samples::F16(copied(s, planes())),
            Samples::F32(s) => Samples::F32(copied(s, planes())),
        };
        let crop = Crop { x: 0, y: 0, width, height };
        Ok(Self { width, height, samples, crop, ..*self })
    }

    /// Width of the visible part in pixels.
    pub fn width(&self) -> usize {
        self.crop.width
    }

    /// Height of the visible part in pixels.
    pub fn height(&self) -> usize {
        self.crop.height
    }

    /// The visible part, in pixels of the file's own frame.
    pub fn crop(&self) -> Crop {
        self.crop
    }

    /// Width and height of the file's own frame, before any crop.
    pub fn file_size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Gray or colour.
    pub fn channels(&self) -> Channels {
        self.channels
    }

    /// All samples, including those outside the visible part.
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The memory of the samples, in bytes.
    pub fn bytes(&self) -> usize {
        self.samples.len() * self.samples.size()
    }

    /// Index where the visible part of row `y` starts, among the samples of one plane or among
    /// interleaved pixels.
    pub(crate) fn row_start(&self, y: usize) -> usize {
        (self.crop.y + y) * self.width + self.crop.x
    }

    /// The number of samples of one whole plane.
    pub(crate) fn plane_len(&self) -> usize {
        self.width * self.height
    }

    /// The sample of one channel at a visible pixel, as a number: the code, or the float itself.
    pub fn sample(&self, channel: usize, x: usize, y: usize) -> f32 {
        let pixel = self.row_start(y) + x;
        let interleaved = pixel * self.channels.count() + channel;
        let planar = channel * self.plane_len() + pixel;
        match &self.samples {
            Samples::U8(s) => f32::from(s[interleaved]),
            Samples::U16(s) => f32::from(s[interleaved]),
            Samples::F16(s) => s[planar].to_f32(),
            Samples::F32(s) => s[planar],
        }
    }

    fn is_finite(&self, channel: usize, x: usize, y: usize) -> bool {
        self.sample(channel, x, y).is_finite()
    }

    /// Whether row `y` of `channel` may hold a NaN or an infinity. This is a quick check of the
    /// bits.
    fn row_has_bad(&self, channel: usize, y: usize) -> bool {
        const F16_EXPONENT: u16 = 0x7c00;
        const F32_EXPONENT: u32 = 0x7f80_0000;
        let start = channel * self.plane_len() + self.row_start(y);
        let row = start..start + self.width();
        match &self.samples {
            Samples::U8(_) | Samples::U16(_) => false,
            // A fold instead of `any`: the loop vectorises only without an early exit.
            Samples::F16(s) => s[row]
                .iter()
                .fold(false, |bad, v| bad | (v.to_bits() & F16_EXPONENT == F16_EXPONENT)),
            Samples::F32(s) => s[row]
                .iter()
                .fold(false, |bad, v| bad | (v.to_bits() & F32_EXPONENT == F32_EXPONENT)),
        }
    }

    /// The first pixel, in reading order, that holds a NaN or an infinity, with the number of such
    /// pixels.
    pub fn bad_pixel(&self) -> Option<BadPixel> {
        if self.samples.is_integer() {
            return None;
        }
        let channels = 0..self.channels.count();
        let bad_row = |y: usize| channels.clone().any(|c| self.row_has_bad(c, y));
        let rows: Vec<usize> = (0..self.height()).into_par_iter().filter(|&y| bad_row(y)).collect();
        let mut first = None;
        let mut pixels = 0;
        for y in rows {
            for x in 0..self.width() {
                let Some(channel) = channels.clone().find(|&c| !self.is_finite(c, x, y)) else {
                    continue;
                };
                pixels += 1;
                first.get_or_insert((channel, x, y));
            }
        }
        first.map(|(channel, x, y)| BadPixel {
            channel: self.channels.name(channel),
            x,
            y,
            value: self.sample(channel, x, y),
            pixels,
        })
    }

    /// The pixels whose channels are all finite.
    pub fn finite_mask(&self) -> Mask {
        let (width, height) = (self.width(), self.height());
        let mut valid = vec![true; width * height];
        for y in 0..height {
            for c in 0..self.channels.count() {
                if self.row_has_bad(c, y) {
                    for (x, valid) in valid[y * width..(y + 1) * width].iter_mut().enumerate() {
                        *valid &= self.is_finite(c, x, y);
                    }
                }
            }
        }
        Mask::new(width, height, valid).unwrap_or_else(|| unreachable!("one flag per pixel"))
    }

    /// The smallest and the largest finite sample of the visible part.
    pub fn range(&self) -> (f32, f32) {
        let rows = (0..self.height()).into_par_iter().with_min_len(BLOCK_ROWS);
        let of_row = |y: usize| {
            let channels = (0..self.channels.count()).map(|c| self.row_range(c, y));
            channels.fold(NO_RANGE, wider)
        };
        rows.map(of_row).reduce(|| NO_RANGE, wider)
    }

    fn row_range(&self, channel: usize, y: usize) -> (f32, f32) {
        let start = channel * self.plane_len() + self.row_start(y);
        if let Samples::F32(s) = &self.samples {
            return range_of(&s[start..start + self.width()]);
        }
        let values = (0..self.width()).map(|x| self.sample(channel, x, y));
        values.filter(|v| v.is_finite()).fold(NO_RANGE, |range, v| wider(range, (v, v)))
    }
}

/// The range of an empty set of values.
const NO_RANGE: (f32, f32) = (f32::INFINITY, f32::NEG_INFINITY);

fn wider(a: (f32, f32), b: (f32, f32)) -> (f32, f32) {
    (a.0.min(b.0), a.1.max(b.1))
}

/// The range of the finite values. It works on several lanes at once, because a loop over single
/// values would not vectorise.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn range_of(values: &[f32]) -> (f32, f32) {
    const LANES: usize = 16;
    let (mut least, mut greatest) = ([NO_RANGE.0; LANES], [NO_RANGE.1; LANES]);
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for ((least, greatest), value) in least.iter_mut().zip(&mut greatest).zip(chunk) {
            let (low, high) = if value.is_finite() { (*value, *value) } else { NO_RANGE };
            *least = if low < *least { low } else { *least };
            *greatest = if high > *greatest { high } else { *greatest };
        }
    }
    let lanes = least.into_iter().zip(greatest);
    let rest = rest.iter().filter(|value| value.is_finite()).map(|value| (*value, *value));
    lanes.chain(rest).fold(NO_RANGE, wider)
}

/// Copies ranges of samples, one after the other.
fn copied<T: Copy>(samples: &[T], ranges: impl Iterator<Item = Range<usize>>) -> Vec<T> {
    ranges.flat_map(|range| samples[range].iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every position in a row counts, and values that are not finite are ignored.
    #[test]
    fn the_range_covers_visible_finite_samples() {
        for at in 0..3 * 37 {
            let mut values = vec![0.5f32; 3 * 37];
            values[at] = -2.0;
            values[(at + 1) % 111] = f32::NAN;
            values[(at + 2) % 111] = f32::INFINITY;
            values[(at + 3) % 111] = 3.0;
            let frame = Frame::new(37, 1, Channels::Rgb, Samples::F32(values)).unwrap();
            assert_eq!(frame.range(), (-2.0, 3.0), "{at}");
        }
        let values = vec![f16::from_f32(-1.0), f16::NAN, f16::from_f32(0.25), f16::from_f32(4.0)];
        let frame = Frame::new(4, 1, Channels::Gray, Samples::F16(values)).unwrap();
        assert_eq!(frame.range(), (-1.0, 4.0));
        let cut = frame.cropped(Crop { x: 1, y: 0, width: 2, height: 1 }).unwrap();
        assert_eq!(cut.range(), (0.25, 0.25));
    }

    #[test]
    fn says_where_the_first_nan_is_and_how_many() {
        let mut values = vec![0.5f32; 3 * 20];
        values[20 + 7] = f32::NAN; // G at (2, 1) of a 5x4 frame
        values[40 + 7] = f32::INFINITY; // B, the same pixel
        values[19] = f32::NEG_INFINITY; // R at (4, 3)
        let frame = Frame::new(5, 4, Channels::Rgb, Samples::F32(values)).unwrap();
        let bad = frame.bad_pixel().unwrap();
        assert_eq!((bad.channel, bad.x, bad.y, bad.pixels), ("G", 2, 1, 2));
        assert_eq!(frame.finite_mask().left_out(), 2);
        let cut = frame.cropped(Crop { x: 0, y: 2, width: 4, height: 2 }).unwrap();
        assert!(cut.bad_pixel().is_none());
    }

    #[test]
    fn a_part_is_a_copy_of_what_a_crop_shows() {
        let codes: Vec<u8> = (0..90).collect();
        let floats: Vec<f32> = codes.iter().copied().map(f32::from).collect();
        for samples in [Samples::U8(codes), Samples::F32(floats)] {
            let frame = Frame::new(6, 5, Channels::Rgb, samples).unwrap().encoded();
            let frame = frame.cropped(Crop { x: 1, y: 1, width: 5, height: 4 }).unwrap();
            let crop = Crop { x: 2, y: 1, width: 3, height: 2 };
            let (part, cut) = (frame.part(crop).unwrap(), frame.clone().cropped(crop).unwrap());
            assert_eq!((part.width(), part.height(), part.samples().len()), (3, 2, 18));
            assert!(part.is_encoded());
            for (c, (x, y)) in (0..3).flat_map(|c| (0..6).map(move |i| (c, (i % 3, i / 3)))) {
                assert!((part.sample(c, x, y) - cut.sample(c, x, y)).abs() < f32::EPSILON);
            }
            assert!(frame.part(Crop { x: 3, ..crop }).is_err());
        }
    }

    #[test]
    fn refuses_a_crop_beyond_the_frame() {
        let frame = Frame::new(5, 4, Channels::Gray, Samples::U8(vec![0; 20])).unwrap();
        assert!(frame.clone().cropped(Crop { x: 1, y: 0, width: 5, height: 4 }).is_err());
        assert!(frame.clone().cropped(Crop { x: 0, y: 0, width: 0, height: 4 }).is_err());
        assert!(frame.cropped(Crop { x: usize::MAX, y: 0, width: 5, height: 4 }).is_err());
    }
}
