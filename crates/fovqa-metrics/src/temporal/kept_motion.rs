//! The motion of a frame, kept for the frames after it.

use fovqa_frame::{BLOCK_ROWS, Motion};
use rayon::prelude::*;

use super::kept_plane::KeptPlane;

/// Backward motion, which can be read at any pixel. Its memory is reused for every frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeptMotion {
    /// Samples across and down, in the units of the file.
    axes: [KeptPlane; 2],
    scale: [f64; 2],
}

impl KeptMotion {
    /// Copies the motion of a frame.
    pub fn take(&mut self, motion: &Motion) {
        let (width, height) = (motion.width(), motion.height());
        let [x, y] = self.axes.each_mut().map(|axis| axis.resized(width, height).values_mut());
        let blocks = x.par_chunks_mut(BLOCK_ROWS * width).zip(y.par_chunks_mut(BLOCK_ROWS * width));
        blocks.enumerate().for_each(|(block, (x, y))| {
            let rows = x.chunks_exact_mut(width).zip(y.chunks_exact_mut(width));
            for (row, (x, y)) in (block * BLOCK_ROWS..).zip(rows) {
                motion.fill_row(row, 0..width, x, y);
            }
        });
        self.scale = motion.scale();
    }

    /// The samples of an axis: 0 for across, 1 for down.
    #[inline(always)]
    pub(crate) fn axis(&self, axis: usize) -> &[f32] {
        self.axes[axis].values()
    }

    /// Pixels of motion per unit of the samples, across and down.
    pub(crate) fn scale(&self) -> [f64; 2] {
        self.scale
    }
}
