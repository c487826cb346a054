//! Pictures of a loss: this build, the last good one, their difference, and what is around the place.

use std::io;

use fovqa_frame::{Channels, Crop, Frame, Samples};
use fovqa_io::{FrameFormat, encode_frame};
use fovqa_vision::Seen;

use crate::pictures::{Small, small};

/// Longer side of the pictures in pixels.
const SIDE: usize = 384;
/// Side of each picture of the place in pixels.
const CROP_SIDE: usize = 224;
/// What is shown around a place, in degrees.
const CROP_DEG: f64 = 10.0;
/// By how much differences are brightened.
pub(super) const BRIGHTER: u8 = 4;
/// Colour of the ring around the place, and of what separates pictures.
const RING: [u8; 3] = [255, 0, 200];
const GAP: [u8; 3] = [255, 255, 255];
const GAP_PX: usize = 6;

/// A picture in three channels of 8 bits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Canvas {
    width: usize,
    height: usize,
    codes: Vec<u8>,
}

impl Canvas {
    fn of(small: &Small) -> Self {
        let codes = match small.channels {
            Channels::Rgb => small.codes.clone(),
            Channels::Gray => small.codes.iter().flat_map(|code| [*code; 3]).collect(),
        };
        Self { width: small.size[0], height: small.size[1], codes }
    }

    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let at = (y * self.width + x) * 3;
        [self.codes[at], self.codes[at + 1], self.codes[at + 2]]
    }

    fn paint(&mut self, x: usize, y: usize, color: [u8; 3]) {
        let at = (y * self.width + x) * 3;
        self.codes[at..at + 3].copy_from_slice(&color);
    }

    /// A part of the picture, enlarged or reduced to a square by its nearest pixels. `center` and `side`
    /// are shares of the picture's width and height.
    fn square(&self, center: [f64; 2], side: [f64; 2]) -> Self {
        let size = [self.width, self.height];
        let pixel = |axis: usize, index: usize| {
            let share = (index as f64 + 0.5) / CROP_SIDE as f64 - 0.5;
            let at = (center[axis] + share * side[axis]) * size[axis] as f64;
            (at.max(0.0) as usize).min(size[axis] - 1)
        };
        let positions = (0..CROP_SIDE * CROP_SIDE).map(|i| (i % CROP_SIDE, i / CROP_SIDE));
        let codes = positions.flat_map(|(x, y)| self.at(pixel(0, x), pixel(1, y))).collect();
        Self { width: CROP_SIDE, height: CROP_SIDE, codes }
    }

    /// Pictures of the same height side by side.
    fn beside(pictures: &[Self]) -> Self {
        let height = pictures.iter().map(|picture| picture.height).max().unwrap_or(1);
        let gaps = GAP_PX * pictures.len().saturating_sub(1);
        let width = pictures.iter().map(|picture| picture.width).sum::<usize>() + gaps;
        let mut all = Self { width, height, codes: GAP.repeat(width * height) };
        let mut left = 0;
        for picture in pictures {
            for y in 0..picture.height {
                for x in 0..picture.width {
                    all.paint(left + x, y, picture.at(x, y));
                }
            }
            left += picture.width + GAP_PX;
        }
        all
    }

    /// How much two pictures of one size differ: the largest difference of a channel, brightened.
    fn difference(&self, other: &Self) -> Option<Self> {
        if (self.width, self.height) != (other.width, other.height) {
            return None;
        }
        let pairs = self.codes.chunks_exact(3).zip(other.codes.chunks_exact(3));
        let codes = pairs.flat_map(|(a, b)| {
            let most = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            [most.saturating_mul(BRIGHTER); 3]
        });
        Some(Self { codes: codes.collect(), ..*self })
    }

    /// Draws a ring around a place, given as shares of width and height.
    fn ring(&mut self, place: [f64; 2]) {
        let [x, y] = [place[0] * self.width as f64, place[1] * self.height as f64];
        let radius = (self.width.max(self.height) as f64 / 20.0).max(6.0);
        for row in 0..self.height {
            for column in 0..self.width {
                let [dx, dy] = [column as f64 + 0.5 - x, row as f64 + 0.5 - y];
                if ((dx * dx + dy * dy).sqrt() - radius).abs() <= 1.0 {
                    self.paint(column, row, RING);
                }
            }
        }
    }

    fn png(self) -> io::Result<Vec<u8>> {
        let frame =
            Frame::new(self.width, self.height, Channels::Rgb, Samples::U8(self.codes.into()));
        encode_frame(&frame.map_err(io::Error::other)?, FrameFormat::Png).map_err(io::Error::other)
    }
}

/// The pictures of a loss.
pub(super) struct Sheets<'a> {
    pub(super) reference: &'a Frame,
    pub(super) test: &'a Frame,
    pub(super) good: Option<&'a Small>,
    pub(super) seen: Option<&'a Seen>,
    /// The place in pixels.
    pub(super) place: Option<[f64; 2]>,
}

/// A picture: the name of its file, what it shows, and its bytes.
pub(super) type Sheet = (&'static str, String, Vec<u8>);

impl Sheets<'_> {
    /// All pictures as PNG.
    pub(super) fn all(&self) -> io::Result<Vec<Sheet>> {
        let size = [self.test.width(), self.test.height()].map(|side| side as f64);
        let place = self.place.map(|[x, y]| [x / size[0], y / size[1]]);
        let shown =
            |frame: &Frame, side: usize| Ok::<_, io::Error>(Canvas::of(&small(frame, side)?));
        let mut this = shown(self.test, SIDE)?;
        if let Some(place) = place {
            this.ring(place);
        }
        let mut sheets = vec![("this-build", "this build".to_owned(), this.png()?)];
        let (name, shown_as, other, now) = if let Some(good) = self.good {
            let now = shown(self.test, good.size[0].max(good.size[1]))?;
            ("last-good", "the last good build", Canvas::of(good), now)
        } else {
            let [reference, now] = [shown(self.reference, SIDE)?, shown(self.test, SIDE)?];
            ("reference", "the reference", reference, now)
        };
        let difference = now.difference(&other);
        sheets.push((name, shown_as.to_owned(), reduced(other)?.png()?));
        if let Some(difference) = difference {
            let what = format!("their difference, {BRIGHTER} times as bright");
            sheets.push(("difference", what, reduced(difference)?.png()?));
        }
        if let Some(place) = place {
            sheets.push(self.crop(place, size)?);
        }
        Ok(sheets)
    }

    /// What is around a place in the reference, in the last good build and in this one.
    fn crop(&self, place: [f64; 2], size: [f64; 2]) -> io::Result<Sheet> {
        let side = match self.seen {
            Some(seen) => {
                let focal = seen.eccentricity.view().focal_px;
                focal[0].min(focal[1]) * libm::tan(CROP_DEG.to_radians())
            }
            None => size[0].min(size[1]) / 6.0,
        };
        let side = side.clamp(16.0_f64.min(size[0].min(size[1])), size[0].min(size[1]));
        let shares = [side / size[0], side / size[1]];
        // What is around a place at the border is inside the frame.
        let center = [0, 1].map(|axis| {
            place[axis]
                .clamp(shares[axis] / 2.0, (1.0 - shares[axis] / 2.0).max(shares[axis] / 2.0))
        });
        let part = |frame: &Frame| {
            let corner =
                [0, 1].map(|axis| ((center[axis] - shares[axis] / 2.0) * size[axis]) as usize);
            let [width, height] = [frame.width(), frame.height()];
            let side = (side as usize).max(1);
            let x = corner[0].min(width.saturating_sub(side));
            let y = corner[1].min(height.saturating_sub(side));
            let crop = Crop { x, y, width: side.min(width), height: side.min(height) };
            let part = frame.part(crop).map_err(io::Error::other)?;
            let part = Canvas::of(&small(&part, CROP_SIDE)?);
            Ok::<_, io::Error>(part.square([0.5; 2], [1.0; 2]))
        };
        let mut parts = vec![part(self.reference)?];
        if let Some(good) = self.good {
            parts.push(Canvas::of(good).square(center, shares));
        }
        parts.push(part(self.test)?);
        let what = if self.good.is_some() {
            "around the place: the reference, the last good build (reduced) and this build"
        } else {
            "around the place: the reference and this build"
        };
        Ok(("crop", what.to_owned(), Canvas::beside(&parts).png()?))
    }
}

/// A picture that is not larger than the others.
fn reduced(canvas: Canvas) -> io::Result<Canvas> {
    let frame =
        Frame::new(canvas.width, canvas.height, Channels::Rgb, Samples::U8(canvas.codes.into()));
    Ok(Canvas::of(&small(&frame.map_err(io::Error::other)?, SIDE)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(code: impl Fn(usize, usize) -> u8) -> Frame {
        let codes = (0..120 * 80).flat_map(|i| [code(i % 120, i / 120); 3]).collect();
        Frame::new(120, 80, Channels::Rgb, Samples::U8(codes)).unwrap()
    }

    #[test]
    fn a_difference_shows_what_differs_and_the_crop_what_is_around_it() {
        let reference = frame(|_, _| 100);
        let test = frame(|x, y| if x / 8 == 10 && y / 8 == 5 { 130 } else { 100 });
        let [a, b] = [&reference, &test].map(|frame| Canvas::of(&small(frame, 384).unwrap()));
        let difference = b.difference(&a).unwrap();
        assert_eq!((difference.at(84, 44), difference.at(10, 10)), ([120; 3], [0; 3]));
        let square = b.square([84.0 / 120.0, 44.0 / 80.0], [16.0 / 120.0, 16.0 / 80.0]);
        assert_eq!(square.at(CROP_SIDE / 2, CROP_SIDE / 2), [130; 3]);
        assert_eq!(square.at(2, 2), [100; 3]);
        let sheets = Sheets {
            reference: &reference,
            test: &test,
            good: None,
            seen: None,
            place: Some([119.0, 79.0]),
        };
        let names: Vec<&str> = sheets.all().unwrap().iter().map(|(name, ..)| *name).collect();
        assert_eq!(names, ["this-build", "reference", "difference", "crop"]);
        let good = small(&reference, 60).unwrap();
        let all = Sheets { good: Some(&good), ..sheets }.all().unwrap();
        let names: Vec<&str> = all.iter().map(|(name, ..)| *name).collect();
        assert_eq!(names, ["this-build", "last-good", "difference", "crop"]);
    }
}
