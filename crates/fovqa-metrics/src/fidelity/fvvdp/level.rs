//! One level of the pyramids of reference and test, row by row: first the values that depend only
//! on the reference, then the masked differences.

use super::band::Band;
use super::contrast::{background, differences, gain};
use super::csf::{Cells, Coordinates};
use super::geometry::BandDirections;
use super::grid::Grid;
use super::masking::log2_masked;
use super::pyramid::Expander;

/// One level of a pyramid and the next one: for the sustained and the transient channel or, for a
/// still, for a single channel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Levels<'a> {
    fine: [&'a Grid; 2],
    coarse: [&'a Grid; 2],
    channels: usize,
}

impl<'a> Levels<'a> {
    pub(super) fn new(fine: &[&'a Grid], coarse: &'a [Grid]) -> Self {
        let last = fine.len() - 1;
        Self {
            fine: [fine[0], fine[last]],
            coarse: [&coarse[0], &coarse[last]],
            channels: fine.len(),
        }
    }

    /// The number of channels.
    pub(super) fn channels(&self) -> usize {
        self.channels
    }
}

/// The viewing conditions of a level.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewing<'a> {
    pub(super) band: &'a Band,
    /// The directions of the pixels; `None` means foveal vision at every pixel.
    pub(super) directions: Option<&'a BandDirections>,
}

/// The values of a row that depend only on the reference: its differences, the gain of each
/// channel, and the limit of differences.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReferenceRow<'a> {
    pub(super) limit: &'a [f32],
    pub(super) differences: [&'a [f32]; 2],
    pub(super) gains: [&'a [f32]; 2],
}

/// Computes the rows of a reference.
pub(super) struct ReferenceRows<'a> {
    viewing: Viewing<'a>,
    levels: Levels<'a>,
    expander: Expander,
    coordinates: Coordinates,
    cells: Cells,
    log2_background: Vec<f32>,
    limit: Vec<f32>,
    differences: [Vec<f32>; 2],
    gains: [Vec<f32>; 2],
}

impl<'a> ReferenceRows<'a> {
    pub(super) fn new(viewing: Viewing<'a>, levels: Levels<'a>) -> Self {
        let stride = levels.fine[0].stride();
        let row = || vec![0.0; stride];
        Self {
            viewing,
            levels,
            expander: Expander::new(viewing.band.size),
            coordinates: Coordinates { rho: row(), ecc: row() },
            cells: Cells::new(stride),
            log2_background: row(),
            limit: row(),
            differences: [row(), row()],
            gains: [row(), row()],
        }
    }

    pub(super) fn row(&mut self, y: usize) -> ReferenceRow<'_> {
        let Levels { fine, coarse, channels } = self.levels;
        for (coarse, out) in coarse.iter().zip(&mut self.differences).take(channels) {
            self.expander.row(coarse, y, out);
        }
        background(&self.differences[0], &mut self.limit, &mut self.log2_background);
        if let Some(directions) = self.viewing.directions {
            directions.row(y, &mut self.coordinates);
            self.cells.find(&self.log2_background, &self.coordinates);
        }
        for (channel, fine) in fine.iter().enumerate().take(channels) {
            differences(fine.padded_row(y), &self.limit, &mut self.differences[channel]);
            let out = &mut self.gains[channel];
            if self.viewing.directions.is_some() {
                self.cells.log2_sensitivity(channel, out);
            } else {
                self.viewing.band.foveal.log2_sensitivity(channel, &self.log2_background, out);
            }
            gain(&self.log2_background, self.viewing.band.log2_gain, out);
        }
        ReferenceRow {
            limit: &self.limit,
            differences: self.differences.each_ref().map(Vec::as_slice),
            gains: self.gains.each_ref().map(Vec::as_slice),
        }
    }
}

/// The rows of a reference, computed once for several tests.
#[derive(Debug, Clone)]
pub(super) struct KeptRows {
    limit: Grid,
    differences: Vec<Grid>,
    gains: Vec<Grid>,
}

impl KeptRows {
    pub(super) fn new(viewing: Viewing<'_>, levels: Levels<'_>) -> Self {
        let (width, height) = viewing.band.size;
        let grid = || Grid::new(width, height);
        let channels = || (0..levels.channels).map(|_| grid()).collect::<Vec<_>>();
        let mut kept = Self { limit: grid(), differences: channels(), gains: channels() };
        let grids = [&mut kept.limit].into_iter().chain(&mut kept.differences);
        Grid::fill_blocks_of(grids.chain(&mut kept.gains), |first, blocks| {
            let mut rows = ReferenceRows::new(viewing, levels);
            let stride = levels.fine[0].stride();
            for index in 0..blocks[0].len() / stride {
                let row = rows.row(first + index);
                let parts = [row.limit].into_iter();
                let parts = parts.chain(row.differences.into_iter().take(levels.channels));
                let parts = parts.chain(row.gains.into_iter().take(levels.channels));
                for (block, part) in blocks.iter_mut().zip(parts) {
                    block[index * stride..(index + 1) * stride].copy_from_slice(part);
                }
            }
        });
        kept
    }

    fn row(&self, y: usize) -> ReferenceRow<'_> {
        ReferenceRow {
            limit: self.limit.padded_row(y),
            differences: rows_of(&self.differences, y),
            gains: rows_of(&self.gains, y),
        }
    }
}

/// A row of each channel; if there is one channel, its row twice.
fn rows_of(grids: &[Grid], y: usize) -> [&[f32]; 2] {
    [0, 1].map(|channel| grids[channel.min(grids.len() - 1)].padded_row(y))
}

/// The rows of a reference, computed for this test only or stored for several tests.
pub(super) enum Reference<'a> {
    Computed(Box<ReferenceRows<'a>>),
    Kept(&'a KeptRows),
}

/// Computes the masked differences of a test and its reference.
pub(super) struct DifferenceRows<'a> {
    reference: Reference<'a>,
    test: Levels<'a>,
    expander: Expander,
    differences: Vec<f32>,
    log2_masked: [Vec<f32>; 2],
}

impl<'a> DifferenceRows<'a> {
    pub(super) fn new(band: &'a Band, reference: Reference<'a>, test: Levels<'a>) -> Self {
        let stride = test.fine[0].stride();
        let row = || vec![0.0; stride];
        Self {
            reference,
            test,
            expander: Expander::new(band.size),
            differences: row(),
            log2_masked: [row(), row()],
        }
    }

    /// log2 of D along row `y`, for each channel.
    pub(super) fn row(&mut self, y: usize) -> &[Vec<f32>] {
        let reference = match &mut self.reference {
            Reference::Computed(rows) => rows.row(y),
            Reference::Kept(kept) => kept.row(y),
        };
        let channels = self.test.channels;
        for channel in 0..channels {
            let row = &mut self.differences;
            self.expander.row(self.test.coarse[channel], y, row);
            differences(self.test.fine[channel].padded_row(y), reference.limit, row);
            let pair = (row.as_slice(), reference.differences[channel]);
            log2_masked(channel, pair, reference.gains[channel], &mut self.log2_masked[channel]);
        }
        &self.log2_masked[..channels]
    }
}
