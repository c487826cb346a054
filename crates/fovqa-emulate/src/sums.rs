//! Sums over the pixels of a frame, the same for any number of threads.

use fovqa_frame::{Mask, map_row_blocks};

use crate::offsets::Offsets;
use crate::radial::Radial;

/// The sum of a function of the distance from the gaze over all pixel centres.
pub(crate) fn sum_over_pixels(of: &Radial, offsets: &Offsets) -> f64 {
    let block = |rows: std::ops::Range<usize>| -> f64 {
        rows.flat_map(|y| offsets.squares(y, 0..offsets.width()))
            .map(|square| f64::from(of.at(square)))
            .sum()
    };
    map_row_blocks(offsets.height(), block).into_iter().sum()
}

/// The sum over the pixels of a mask alone.
pub(crate) fn sum_over_mask(of: &Radial, offsets: &Offsets, mask: &Mask) -> f64 {
    let block = |rows: std::ops::Range<usize>| -> f64 {
        let row = |y: usize| offsets.squares(y, 0..offsets.width()).zip(mask.row(y));
        rows.flat_map(row)
            .filter(|(_, is_on)| **is_on)
            .map(|(square, _)| f64::from(of.at(square)))
            .sum()
    };
    map_row_blocks(offsets.height(), block).into_iter().sum()
}

/// How many positions, in pixels, are on a pixel of a mask.
pub(crate) fn count_on(mask: &Mask, positions: impl IntoIterator<Item = [f64; 2]>) -> usize {
    let [width, height] = [mask.width() as f64, mask.height() as f64];
    let is_on = |&[x, y]: &[f64; 2]| {
        let is_inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
        is_inside && mask.row(y as usize)[x as usize]
    };
    positions.into_iter().filter(is_on).count()
}
