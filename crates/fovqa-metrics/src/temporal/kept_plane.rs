//! A plane of one value per pixel, kept for the comparison with the next frame.

use fovqa_frame::{BLOCK_ROWS, Plane};
use rayon::prelude::*;

/// Luma, 0 to 1, or depth in the renderer's units, row by row. Its memory is reused for every
/// frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeptPlane {
    width: usize,
    values: Vec<f32>,
}

impl KeptPlane {
    /// Changes the size of the plane. Its content is not cleared.
    pub(crate) fn resized(&mut self, width: usize, height: usize) -> &mut Self {
        self.width = width;
        if self.values.is_empty() {
            // The system zeroes this memory page by page, when it is first written.
            self.values = vec![0.0; width * height];
        }
        self.values.resize(width * height, 0.0);
        self
    }

    /// Copies the values of another plane.
    pub fn take(&mut self, plane: &Plane) {
        let width = plane.width();
        let values = self.resized(width, plane.height()).values_mut();
        values.par_chunks_mut(BLOCK_ROWS * width).enumerate().for_each(|(block, rows)| {
            for (y, row) in rows.chunks_exact_mut(width).enumerate() {
                plane.fill_row(block * BLOCK_ROWS + y, 0..width, row);
            }
        });
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels; 0 before the first values are stored.
    pub fn height(&self) -> usize {
        self.values.len().checked_div(self.width).unwrap_or(0)
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
