//! The depth of a whole frame, kept for the next one.

use fovqa_frame::{BLOCK_ROWS, Plane};
use rayon::prelude::*;

/// Depth in the renderer's units, row by row. Its memory is used again for frame after frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DepthPlane {
    width: usize,
    values: Vec<f32>,
}

impl DepthPlane {
    /// Takes the depth of a frame over.
    pub fn take(&mut self, depth: &Plane) {
        let width = depth.width();
        self.width = width;
        if self.values.is_empty() {
            self.values = vec![0.0; width * depth.height()];
        }
        self.values.resize(width * depth.height(), 0.0);
        let blocks = self.values.par_chunks_mut(BLOCK_ROWS * width).enumerate();
        blocks.for_each(|(block, rows)| {
            for (y, row) in rows.chunks_exact_mut(width).enumerate() {
                depth.fill_row(block * BLOCK_ROWS + y, 0..width, row);
            }
        });
    }

    /// All values.
    #[inline(always)]
    pub(crate) fn values(&self) -> &[f32] {
        &self.values
    }

    /// Row `y`.
    #[inline(always)]
    pub(crate) fn row(&self, y: usize) -> &[f32] {
        &self.values[y * self.width..(y + 1) * self.width]
    }
}
