//! Masks: which pixels count, from a lens mask or because their values are finite.

use crate::frame::{Frame, Samples};

/// One flag per pixel, row by row: `true` where the pixel counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    width: usize,
    height: usize,
    valid: Vec<bool>,
}

impl Mask {
    /// A mask from one flag per pixel. `None` unless there are `width * height` flags.
    pub fn new(width: usize, height: usize, valid: Vec<bool>) -> Option<Self> {
        (Some(valid.len()) == width.checked_mul(height)).then_some(Self { width, height, valid })
    }

    /// The mask that a picture is: a pixel counts if it is brighter than half in every channel.
    pub fn of(picture: &Frame) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let half = match picture.samples() {
            Samples::U8(_) => 127.5,
            Samples::U16(_) => 32767.5,
            Samples::F16(_) | Samples::F32(_) => 0.5,
        };
        let channels = picture.channels().count();
        let counts = |x, y| (0..channels).all(|c| picture.sample(c, x, y) > half);
        let valid = (0..width * height).map(|i| counts(i % width, i / width)).collect();
        Self { width, height, valid }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The flags of row `y`.
    pub fn row(&self, y: usize) -> &[bool] {
        &self.valid[y * self.width..(y + 1) * self.width]
    }

    /// The number of pixels that do not count.
    pub fn left_out(&self) -> u64 {
        self.valid.iter().filter(|&&valid| !valid).count() as u64
    }

    /// Keeps only the pixels that count in both masks.
    ///
    /// # Panics
    /// When the masks differ in size.
    pub fn intersect(&mut self, other: &Mask) {
        assert_eq!((self.width, self.height), (other.width, other.height), "masks of one size");
        for (mine, theirs) in self.valid.iter_mut().zip(&other.valid) {
            *mine &= theirs;
        }
    }

    /// The part of the mask inside a rectangle, which must lie within it.
    #[must_use]
    pub fn cropped(&self, x: usize, y: usize, width: usize, height: usize) -> Mask {
        let valid = (y..y + height).flat_map(|row| &self.row(row)[x..x + width]).copied().collect();
        Mask { width, height, valid }
    }

    /// The mask of 2x2 blocks: a block counts if all of its pixels count. An odd last column or row
    /// is dropped.
    #[must_use]
    pub fn halved(&self) -> Mask {
        let (width, height) = (self.width / 2, self.height / 2);
        let rows = (0..height).flat_map(|y| {
            let (top, bottom) = (self.row(2 * y), self.row(2 * y + 1));
            let pairs = top.chunks_exact(2).zip(bottom.chunks_exact(2));
            pairs.map(|(a, b)| a[0] && a[1] && b[0] && b[1])
        });
        Mask { width, height, valid: rows.collect() }
    }

    /// The mask of window centres: a pixel counts if all pixels of the window around it count,
    /// which has `2 radius + 1` pixels on a side. Windows that do not fit into the picture do not
    /// count.
    #[must_use]
    pub fn eroded(&self, radius: usize) -> Mask {
        let (w, h, side) = (self.width, self.height, 2 * radius + 1);
        let mut valid = vec![false; w * h];
        // For each column, the number of consecutive valid pixels that end in the current row.
        let mut run = vec![0usize; w];
        for y in 0..h {
            for (run, &valid) in run.iter_mut().zip(self.row(y)) {
                *run = if valid { *run + 1 } else { 0 };
            }
            if y + 1 < side {
                continue;
            }
            let mut across = 0;
            for x in 0..w {
                across = if run[x] >= side { across + 1 } else { 0 };
                if across >= side {
                    valid[(y - radius) * w + x - radius] = true;
                }
            }
        }
        Mask { width: w, height: h, valid }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bad_pixel_takes_out_its_block() {
        let mut valid = vec![true; 7 * 5];
        valid[3 * 7 + 4] = false;
        let half = Mask::new(7, 5, valid).unwrap().halved();
        assert_eq!((half.width(), half.height(), half.left_out()), (3, 2, 1));
        assert!(!half.row(1)[2]);
    }

    #[test]
    fn one_bad_pixel_takes_out_every_window_that_holds_it() {
        let mut valid = vec![true; 9 * 8];
        valid[3 * 9 + 4] = false;
        let mask = Mask::new(9, 8, valid).unwrap();
        let eroded = mask.eroded(1);
        for y in 0..8 {
            for x in 0..9 {
                let fits = (1..8).contains(&x) && (1..7).contains(&y);
                let clean = !((3..=5).contains(&x) && (2..=4).contains(&y));
                assert_eq!(eroded.row(y)[x], fits && clean, "({x}, {y})");
            }
        }
    }
}
