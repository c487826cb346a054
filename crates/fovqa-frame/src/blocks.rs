//! Row blocks, the only unit of parallel work.
//!
//! Their height is fixed, so that partial sums, added in block order, are the same for any number
//! of threads.

use std::ops::Range;

use rayon::prelude::*;

/// Rows of one block. Even, so that a 2x2 mean never straddles two blocks.
pub const BLOCK_ROWS: usize = 64;

/// Calls `work` in parallel with each block of rows of a plane that is `width` values wide, and with the values
/// of these rows. Returns the results in the order of the rows.
pub fn map_plane_blocks<T: Send>(
    plane: &mut [f32],
    width: usize,
    work: impl Fn(Range<usize>, &mut [f32]) -> T + Sync + Send,
) -> Vec<T> {
    plane
        .par_chunks_mut(BLOCK_ROWS * width)
        .enumerate()
        .map(|(block, values)| {
            let first = block * BLOCK_ROWS;
            work(first..first + values.len() / width, values)
        })
        .collect()
}

/// Calls `work` in parallel with each block of rows of a picture that is `height` rows high, and
/// returns the results in the order of the rows.
pub fn map_row_blocks<T: Send>(
    height: usize,
    work: impl Fn(Range<usize>) -> T + Sync + Send,
) -> Vec<T> {
    (0..height.div_ceil(BLOCK_ROWS))
        .into_par_iter()
        .map(|block| work(block * BLOCK_ROWS..((block + 1) * BLOCK_ROWS).min(height)))
        .collect()
}
