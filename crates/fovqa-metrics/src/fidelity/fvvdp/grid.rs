//! A plane whose rows begin at multiples of a vector's length, so that loops over a whole row have
//! no remainder.

use fovqa_frame::{BLOCK_ROWS, Frame, LuminanceScratch, LuminanceTables};
use rayon::prelude::*;

use super::spare;

/// The number of floats in two of the widest vectors.
pub(super) const ROW_STEP: usize = 32;

/// A plane of `f32`. The padding after the end of a row is finite and has no meaning.
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

    /// A plane of which the caller writes every row with its padding. Until then its values have no
    /// meaning.
    pub(crate) fn to_fill(width: usize, height: usize) -> Self {
        let stride = width.next_multiple_of(ROW_STEP);
        Self { width, height, stride, values: spare::stale(stride * height) }
    }

    /// The luminance of a frame in cd/m².
    pub fn luminance(frame: &Frame, tables: &LuminanceTables) -> Self {
        let signal = tables.luminance(frame);
        let mut grid = Self::to_fill(frame.width(), frame.height());
        let width = grid.width;
        grid.fill_blocks(|first, rows| {
            let mut scratch = LuminanceScratch::new(width);
            for (index, row) in rows.enumerate() {
                signal.fill(first + index, 0..width, &mut scratch, row);
                row[width..].fill(0.0);
            }
        });
        grid
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The numbers of columns and rows.
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The number of columns including the padding.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    /// A row.
    pub fn row(&self, y: usize) -> &[f32] {
        &self.padded_row(y)[..self.width]
    }

    /// A row including its padding.
    pub(crate) fn padded_row(&self, y: usize) -> &[f32] {
        &self.values[y * self.stride..(y + 1) * self.stride]
    }

    /// Passes blocks of rows to `fill`, in parallel: the index of a block's first row, and its rows
    /// with their padding.
    pub(crate) fn fill_blocks(
        &mut self,
        fill: impl Fn(usize, std::slice::ChunksExactMut<'_, f32>) + Sync + Send,
    ) {
        let stride = self.stride;
        self.values.par_chunks_mut(stride * BLOCK_ROWS).enumerate().for_each(|(block, rows)| {
            fill(block * BLOCK_ROWS, rows.chunks_exact_mut(stride));
        });
    }

    /// Passes blocks of rows of several planes of one size to a function, one block of each plane.
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
