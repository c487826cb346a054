//! Sums over all pixels of a frame, the same for any number of threads.

use fovqa_frame::map_row_blocks;

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
