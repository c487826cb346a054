//! A picture as its file holds it, before any transfer function.

use std::ops::Range;

use half::f16;
use multiversion::multiversion;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::blocks::BLOCK_ROWS;
use crate::buffer::Buffer;
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
    U8(Buffer<u8>),
    /// Codes 0..=65535, channels interleaved.
    U16(Buffer<u16>),
    /// Half floats, one plane after the other, unless the frame says that they are
    /// [interleaved](Frame::interleaved).
    F16(Buffer<f16>),
    /// Floats, in the order of half floats.
    F32(Buffer<f32>),
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
    /// Whether the channels of a pixel are side by side. Otherwise, each channel is a plane.
    interleaved: bool,
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
        let is_integer = samples.is_integer();
        let (encoded, interleaved) = (is_integer, is_integer);
        Ok(Self { width, height, channels, samples, encoded, interleaved, crop })
    }

    /// Marks the samples as interleaved, even if they are floats: the channels of a pixel are side by
    /// side, as in the arrays of most programs.
    #[must_use]
    pub fn interleaved(self) -> Self {
        Self { interleaved: true, ..self }
    }

    /// Whether the channels of a pixel are side by side. Otherwise, each channel is a plane.
    pub fn is_interleaved(&self) -> bool {
        self.interleaved
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
        let ranges: Vec<Range<usize>> = if self.interleaved {
            rows().map(|row| row.start * count..row.end * count).collect()
        } else {
            let plane = |c: usize| c * self.plane_len();
            let of_plane = |c| rows().map(move |row| plane(c) + row.start..plane(c) + row.end);
            (0..count).flat_map(of_plane).collect()
        };
        let samples = match &self.samples {
            Samples::U8(s) => Samples::U8(copied(s, ranges)),
            Samples::U16(s) => Samples::U16(copied(s, ranges)),
            Samples::F16(s) => Samples::F16(copied(s, ranges)),
            Samples::F32(s) => Samples::F32(copied(s, ranges)),
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

    /// Index of a sample of a pixel, whose index counts the rows of the whole file.
    #[inline]
    pub(crate) fn index(&self, channel: usize, pixel: usize) -> usize {
        if self.interleaved {
            pixel * self.channels.count() + channel
        } else {
            channel * self.plane_len() + pixel
        }
    }

    /// Where the samples of some pixels of a row are, of which the first has the index `first`: in one
    /// piece, or in one for each channel.
    pub(crate) fn pieces(&self, first: usize, pixels: usize) -> impl Iterator<Item = Range<usize>> {
        let count = self.channels.count();
        let (pieces, length) = if self.interleaved { (1, pixels * count) } else { (count, pixels) };
        let start = move |piece: usize| self.index(piece, first);
        (0..pieces).map(move |piece| start(piece)..start(piece) + length)
    }

    /// The sample of one channel at a visible pixel, as a number: the code, or the float itself.
    pub fn sample(&self, channel: usize, x: usize, y: usize) -> f32 {
        let index = self.index(channel, self.row_start(y) + x);
        match &self.samples {
            Samples::U8(s) => f32::from(s[index]),
            Samples::U16(s) => f32::from(s[index]),
            Samples::F16(s) => s[index].to_f32(),
            Samples::F32(s) => s[index],
        }
    }

    fn is_finite(&self, channel: usize, x: usize, y: usize) -> bool {
        self.sample(channel, x, y).is_finite()
    }

    /// Whether row `y` may hold a NaN or an infinity. This is a quick check of the bits.
    fn row_has_bad(&self, y: usize) -> bool {
        const F16_EXPONENT: u16 = 0x7c00;
        const F32_EXPONENT: u32 = 0x7f80_0000;
        let mut pieces = self.pieces(self.row_start(y), self.width());
        match &self.samples {
            Samples::U8(_) | Samples::U16(_) => false,
            // A fold instead of `any`: the loop vectorises only without an early exit.
            Samples::F16(s) => pieces.any(|piece| {
                let values = s[piece].iter();
                values.fold(false, |bad, v| bad | (v.to_bits() & F16_EXPONENT == F16_EXPONENT))
            }),
            Samples::F32(s) => pieces.any(|piece| {
                let values = s[piece].iter();
                values.fold(false, |bad, v| bad | (v.to_bits() & F32_EXPONENT == F32_EXPONENT))
            }),
        }
    }

    /// The first pixel, in reading order, that holds a NaN or an infinity, with the number of such
    /// pixels.
    pub fn bad_pixel(&self) -> Option<BadPixel> {
        if self.samples.is_integer() {
            return None;
        }
        let channels = 0..self.channels.count();
        let rows = (0..self.height()).into_par_iter().filter(|&y| self.row_has_bad(y));
        let rows: Vec<usize> = rows.collect();
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
        for y in (0..height).filter(|&y| self.row_has_bad(y)) {
            for (x, valid) in valid[y * width..(y + 1) * width].iter_mut().enumerate() {
                *valid = (0..self.channels.count()).all(|c| self.is_finite(c, x, y));
            }
        }
        Mask::new(width, height, valid).unwrap_or_else(|| unreachable!("one flag per pixel"))
    }

    /// The smallest and the largest finite sample of the visible part.
    pub fn range(&self) -> (f32, f32) {
        let rows = (0..self.height()).into_par_iter().with_min_len(BLOCK_ROWS);
        rows.map(|y| self.row_range(y)).reduce(|| NO_RANGE, wider)
    }

    fn row_range(&self, y: usize) -> (f32, f32) {
        if let Samples::F32(s) = &self.samples {
            let pieces = self.pieces(self.row_start(y), self.width());
            return pieces.map(|piece| range_of(&s[piece])).fold(NO_RANGE, wider);
        }
        let channels = 0..self.channels.count();
        let values = channels.flat_map(|c| (0..self.width()).map(move |x| self.sample(c, x, y)));
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
fn copied<T: Copy>(samples: &[T], ranges: Vec<Range<usize>>) -> Buffer<T> {
    ranges.into_iter().flat_map(|range| samples[range].iter().copied()).collect()
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
            let frame = Frame::new(37, 1, Channels::Rgb, Samples::F32(values.into())).unwrap();
            assert_eq!(frame.range(), (-2.0, 3.0), "{at}");
        }
        let values = vec![f16::from_f32(-1.0), f16::NAN, f16::from_f32(0.25), f16::from_f32(4.0)];
        let frame = Frame::new(4, 1, Channels::Gray, Samples::F16(values.into())).unwrap();
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
        let frame = Frame::new(5, 4, Channels::Rgb, Samples::F32(values.into())).unwrap();
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
        for samples in [Samples::U8(codes.into()), Samples::F32(floats.into())] {
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

    /// Floats whose channels are side by side are the same picture as floats in planes.
    #[test]
    fn floats_side_by_side_are_read_like_planes() {
        const PIXELS: usize = 7 * 5;
        let mut values: Vec<f32> = (0..3 * PIXELS).map(|i| (i as f32 * 0.37).sin()).collect();
        values[PIXELS + 23] = f32::NAN; // G at (2, 3)
        let side_by_side = (0..3 * PIXELS).map(|i| values[i % 3 * PIXELS + i / 3]).collect();
        let frame = |values| Frame::new(7, 5, Channels::Rgb, Samples::F32(values)).unwrap();
        let crop = Crop { x: 1, y: 1, width: 5, height: 4 };
        let planes = frame(values.into()).cropped(crop).unwrap();
        let pixels = frame(side_by_side).interleaved().cropped(crop).unwrap();
        assert_eq!(planes.bad_pixel().unwrap().pixels, 1);
        let cut = Crop { x: 1, y: 1, width: 3, height: 3 };
        let alike = |a: &Frame, b: &Frame| {
            assert_eq!(a.range(), b.range());
            assert_eq!(a.finite_mask(), b.finite_mask());
            let place = |frame: &Frame| frame.bad_pixel().map(|bad| (bad.channel, bad.x, bad.y));
            assert_eq!(place(a), place(b));
            for (c, i) in (0..3).flat_map(|c| (0..a.width() * a.height()).map(move |i| (c, i))) {
                let [a, b] = [a, b].map(|f| f.sample(c, i % f.width(), i / f.width()).to_bits());
                assert_eq!(a, b);
            }
        };
        alike(&planes, &pixels);
        alike(&planes.part(cut).unwrap(), &pixels.part(cut).unwrap());
        alike(&crate::half_floats(&planes), &crate::half_floats(&pixels));
    }

    #[test]
    fn refuses_a_crop_beyond_the_frame() {
        let frame = Frame::new(5, 4, Channels::Gray, Samples::U8(vec![0; 20].into())).unwrap();
        assert!(frame.clone().cropped(Crop { x: 1, y: 0, width: 5, height: 4 }).is_err());
        assert!(frame.clone().cropped(Crop { x: 0, y: 0, width: 0, height: 4 }).is_err());
        assert!(frame.cropped(Crop { x: usize::MAX, y: 0, width: 5, height: 4 }).is_err());
    }
}
