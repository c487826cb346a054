//! A plane whose rows begin at multiples of a vector's length, so that loops over a whole row need no rest.

use fovqa_frame::{BLOCK_ROWS, Frame, LuminanceScratch, LuminanceTables};
use rayon::prelude::*;

use super::spare;

/// Floats of two of the widest vectors.
const ROW_STEP: usize = 32;

/// A plane of `f32`. What lies behind the end of a row is finite, and of no meaning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Grid {
    width: usize,
    height: usize,
    stride: usize,
    values: Vec<f32>,
}

impl Grid {
    /// A plane of zeros.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let stride = width.next_multiple_of(ROW_STEP);
        Self { width, height, stride, values: spare::zeros(stride * height) }
    }

    /// The luminance of a frame in cd/m².
    pub fn luminance(frame: &Frame, tables: &LuminanceTables) -> Self {
        let signal = tables.luminance(frame);
        let mut grid = Self::new(frame.width(), frame.height());
        let width = grid.width;
        grid.fill_blocks(|first, rows| {
            let mut scratch = LuminanceScratch::new(width);
            for (index, row) in rows.enumerate() {
                signal.fill(first + index, 0..width, &mut scratch, row);
            }
        });
        grid
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Columns with those behind the end of a row.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    /// A row.
    pub fn row(&self, y: usize) -> &[f32] {
        &self.padded_row(y)[..self.width]
    }

    /// A row with what lies behind its end.
    pub(crate) fn padded_row(&self, y: usize) -> &[f32] {
        &self.values[y * self.stride..(y + 1) * self.stride]
    }

    /// The largest value.
    pub fn max(&self) -> f32 {
        let rows = (0..self.height).map(|y| self.row(y).iter().copied().fold(f32::MIN, f32::max));
        rows.fold(f32::MIN, f32::max)
    }

    /// Hands blocks of rows to `fill`, in parallel: the number of a block's first row, and its rows with
    /// what lies behind their ends.
    pub(crate) fn fill_blocks(
        &mut self,
        fill: impl Fn(usize, std::slice::ChunksExactMut<'_, f32>) + Sync + Send,
    ) {
        let stride = self.stride;
        self.values.par_chunks_mut(stride * BLOCK_ROWS).enumerate().for_each(|(block, rows)| {
            fill(block * BLOCK_ROWS, rows.chunks_exact_mut(stride));
        });
    }

    /// The same of several planes of one size: a block of each, whole rows.
    pub(crate) fn fill_blocks_of<'a>(
        grids: impl Iterator<Item = &'a mut Self>,
        fill: impl Fn(usize, &mut [&mut [f32]]) + Sync + Send,
    ) {
        let mut blocks: Vec<Vec<&mut [f32]>> = Vec::new();
        for grid in grids {
            let length = grid.stride * BLOCK_ROWS;
            for (index, block) in grid.values.chunks_mut(length).enumerate() {
                if blocks.len() == index {
                    blocks.push(Vec::new());
                }
                blocks[index].push(block);
            }
        }
        let each = blocks.into_par_iter().enumerate();
        each.for_each(|(block, mut rows)| fill(block * BLOCK_ROWS, &mut rows));
    }
}

impl Drop for Grid {
    fn drop(&mut self) {
        spare::give_back(std::mem::take(&mut self.values));
    }
}
