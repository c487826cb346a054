//! Pixels of 1 or 3 channels, the channels side by side: what is fetched at a place is one read.

use std::ops::Range;

use fovqa_frame::BLOCK_ROWS;
use rayon::prelude::*;

use crate::value::Value;

/// An image of `f32` values, or others, row by row from the top-left corner, the channels of a pixel
/// side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Image<const C: usize, V = f32> {
    width: usize,
    pixels: Vec<[V; C]>,
}

impl<const C: usize> Image<C> {
    /// Computes an image of `width` x `height` pixels, both at least 1, in parallel: `fill` gets
    /// blocks of rows of a fixed height, and which rows they are.
    pub(crate) fn by_blocks(
        width: usize,
        height: usize,
        fill: impl Fn(Range<usize>, &mut [[f32; C]]) + Sync + Send,
    ) -> Self {
        let mut pixels = vec![[0.0; C]; width * height];
        pixels.par_chunks_mut(BLOCK_ROWS * width).enumerate().for_each(|(block, pixels)| {
            let first = block * BLOCK_ROWS;
            fill(first..first + pixels.len() / width, pixels);
        });
        Self { width, pixels }
    }

    /// The same image, kept as values of another kind.
    pub(crate) fn kept<V: Value>(self) -> Image<C, V> {
        Image { width: self.width, pixels: V::keep(self.pixels) }
    }

    /// The same image with every row changed.
    pub(crate) fn map_rows(
        &self,
        change: impl Fn(&[[f32; C]], &mut [[f32; C]]) + Sync + Send,
    ) -> Self {
        Self::by_rows(self.width, self.height(), |y, out| change(self.row(y), out))
    }
}

impl<const C: usize, V> Image<C, V> {
    /// Computes an image of `width` x `height` pixels, both at least 1, in parallel, row by row: `fill`
    /// gets the number of the row, and room that it may use from row to row.
    pub(crate) fn by_rows_with<R>(
        width: usize,
        height: usize,
        room: impl Fn() -> R + Sync + Send,
        fill: impl Fn(&mut R, usize, &mut [[f32; C]]) + Sync + Send,
    ) -> Self
    where
        V: Value,
    {
        let mut pixels = vec![[V::default(); C]; width * height];
        pixels.par_chunks_mut(BLOCK_ROWS * width).enumerate().for_each(|(block, pixels)| {
            let (mut room, mut signal) = (room(), Vec::new());
            for (i, out) in pixels.chunks_exact_mut(width).enumerate() {
                let y = block * BLOCK_ROWS + i;
                V::keep_row(out, &mut signal, |row| fill(&mut room, y, row));
            }
        });
        Self { width, pixels }
    }

    /// Computes an image of `width` x `height` pixels in parallel: `fill` gets strips of so many rows, and
    /// which rows they are.
    pub(crate) fn by_strips(
        width: usize,
        height: usize,
        rows: usize,
        fill: impl Fn(Range<usize>, &mut [[V; C]]) + Sync + Send,
    ) -> Self
    where
        V: Value,
    {
        let mut pixels = vec![[V::default(); C]; width * height];
        pixels.par_chunks_mut(rows * width).enumerate().for_each(|(strip, pixels)| {
            let first = strip * rows;
            fill(first..first + pixels.len() / width, pixels);
        });
        Self { width, pixels }
    }

    /// The same without room.
    pub(crate) fn by_rows(
        width: usize,
        height: usize,
        fill: impl Fn(usize, &mut [[f32; C]]) + Sync + Send,
    ) -> Self
    where
        V: Value,
    {
        Self::by_rows_with(width, height, || (), |(), y, row| fill(y, row))
    }

    /// All pixels, row by row.
    pub(crate) fn into_pixels(self) -> Vec<[V; C]> {
        self.pixels
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.pixels.len() / self.width
    }

    /// The pixels of row `y`.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn row(&self, y: usize) -> &[[V; C]] {
        &self.pixels[y * self.width..(y + 1) * self.width]
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[[V; C]] {
        &self.pixels
    }
}
