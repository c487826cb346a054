//! One pass over the rows of a pair: every sum the metrics need, block by block.
//!
//! A block is cut into tiles of columns, so that the rows the window looks at stay in the cache.
//! Each tile walks down its rows with a ring of the last ones.

use std::ops::Range;

use fovqa_frame::{PairTile, map_row_blocks};

use super::fpsnr::WeightField;
use super::fssim::WeightedMean;
use super::ms_ssim::{HalvedRows, PairRows, Scale};
use super::squared_error::squared_row;
use super::ssim::rows::{Constants, MapRow, Ring, Scratch, map_row};
use super::sums::{add_by_band, sum, weighted};
use crate::regions::{Regions, clipped};

/// Columns of a tile. Even, for the 2x2 means; the ring of a tile of RGB is 280 kB.
const TILE_COLUMNS: usize = 512;

/// What a pass has to sum.
#[derive(Debug)]
pub(crate) struct Wanted<'a> {
    /// Squared error per band.
    pub(crate) squared_error: bool,
    /// Weighted squared error and weighted map.
    pub(crate) weight: Option<&'a WeightField>,
    /// The SSIM map.
    pub(crate) ssim: Option<Constants>,
    /// Each channel's means over the whole frame, and the next scale.
    pub(crate) scales: Scales,
}

/// What MS-SSIM needs of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scales {
    /// Nothing.
    None,
    /// Channel means and the next scale.
    AndNext,
    /// Channel means alone: the coarsest scale.
    Last,
}

/// Sums over a frame, or over one block of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sums {
    /// Squared error of all planes, per band, then outside all bands.
    pub(crate) squared: Vec<f64>,
    /// Σ f² d² and Σ f².
    pub(crate) weighted_squared: WeightedMean,
    /// SSIM of all planes, per band, then outside all bands.
    pub(crate) ssim: Vec<f64>,
    /// Windows counted in `ssim`.
    pub(crate) windows: Vec<u64>,
    /// Σ f² map and Σ f² over windows, map summed over planes.
    pub(crate) weighted_ssim: WeightedMean,
    /// Σ SSIM of each plane.
    pub(crate) channel_ssim: [f64; 3],
    /// Σ contrast-structure of each plane.
    pub(crate) channel_structure: [f64; 3],
}

impl Sums {
    fn new(bands: usize) -> Self {
        Self {
            squared: vec![0.0; bands + 1],
            weighted_squared: WeightedMean::default(),
            ssim: vec![0.0; bands + 1],
            windows: vec![0; bands + 1],
            weighted_ssim: WeightedMean::default(),
            channel_ssim: [0.0; 3],
            channel_structure: [0.0; 3],
        }
    }

    fn merge(&mut self, other: &Self) {
        let add = |mine: &mut [f64], theirs: &[f64]| {
            for (mine, theirs) in mine.iter_mut().zip(theirs) {
                *mine += theirs;
            }
        };
        add(&mut self.squared, &other.squared);
        add(&mut self.ssim, &other.ssim);
        add(&mut self.channel_ssim, &other.channel_ssim);
        add(&mut self.channel_structure, &other.channel_structure);
        for (mine, theirs) in self.windows.iter_mut().zip(&other.windows) {
            *mine += theirs;
        }
        self.weighted_squared.merge(&other.weighted_squared);
        self.weighted_ssim.merge(&other.weighted_ssim);
    }
}

/// Runs the pass, blocks of rows in parallel, and adds them up in order. Returns the next scale
/// where it is wanted.
pub(crate) fn run(
    rows: &impl PairRows,
    regions: &Regions<'_>,
    wanted: &Wanted<'_>,
) -> (Sums, Option<Scale>) {
    let (width, height) = rows.size();
    let blocks = map_row_blocks(height, |range| {
        let mut block = Block::new(rows, regions, wanted, range);
        for x in (0..width).step_by(TILE_COLUMNS) {
            block.tile(x..(x + TILE_COLUMNS).min(width));
        }
        (block.sums, block.halved)
    });
    let mut sums = Sums::new(regions.bands());
    let mut halved = Vec::new();
    for (block, rows) in blocks {
        sums.merge(&block);
        halved.extend(rows);
    }
    let scale = (wanted.scales == Scales::AndNext).then(|| Scale {
        width: width / 2,
        height: height / 2,
        planes: rows.planes(),
        peak: rows.peak(),
        blocks: halved,
    });
    (sums, scale)
}

struct Block<'a, R> {
    source: &'a R,
    regions: &'a Regions<'a>,
    wanted: &'a Wanted<'a>,
    rows: Range<usize>,
    radius: usize,
    ring: Ring,
    tile: PairTile,
    scratch: Scratch,
    /// One row each: squared error, weights, a plane's map, its structure, the planes' map.
    squared: Vec<f32>,
    weights: Vec<f32>,
    plane_map: Vec<f32>,
    structure: Vec<f32>,
    map: Vec<f32>,
    sums: Sums,
    halved: Option<HalvedRows>,
}

impl<'a, R: PairRows> Block<'a, R> {
    fn new(source: &'a R, regions: &'a Regions<'a>, wanted: &'a Wanted<'a>, rows: Range<usize>) -> Self {
        let (width, _) = source.size();
        let radius = wanted.ssim.as_ref().map_or(0, Constants::radius);
        let columns = TILE_COLUMNS.min(width);
        let stride = columns + 2 * radius;
        let row = || vec![0.0; columns];
        Self {
            source,
            regions,
            wanted,
            radius,
            ring: Ring::new(source.planes(), radius, stride),
            tile: PairTile::new(stride),
            scratch: Scratch::new(stride),
            squared: row(),
            weights: row(),
            plane_map: row(),
            structure: row(),
            map: row(),
            sums: Sums::new(regions.bands()),
            halved: (wanted.scales == Scales::AndNext)
                .then(|| HalvedRows::new(source.planes(), width, rows.len())),
            rows,
        }
    }

    /// Walks down the rows of one tile.
    fn tile(&mut self, xs: Range<usize>) {
        let (width, height) = self.source.size();
        let radius = self.radius;
        let read = xs.start.saturating_sub(radius)..(xs.end + radius).min(width);
        // Windows fit around these columns and, below, rows.
        let map_xs = xs.start.max(radius)..xs.end.min(width.saturating_sub(radius));
        let mut next = self.rows.start.saturating_sub(radius);
        for y in self.rows.clone() {
            let last = (y + radius).min(height - 1);
            while next <= last {
                self.load(next, read.clone());
                next += 1;
            }
            if let Some(field) = self.wanted.weight {
                field.fill_row(y, xs.clone(), &mut self.weights[..xs.len()]);
            }
            if self.wanted.squared_error {
                self.squared_error(y, xs.clone(), xs.start - read.start);
            }
            if y % 2 == 1 {
                self.halve(y, xs.clone(), xs.start - read.start);
            }
            if (radius..height.saturating_sub(radius)).contains(&y) && !map_xs.is_empty() {
                self.map(y, xs.start, map_xs.clone());
            }
        }
    }

    fn load(&mut self, y: usize, read: Range<usize>) {
        let length = read.len();
        self.source.fill(y, read, &mut self.tile);
        for plane in 0..self.source.planes() {
            let (sum, difference) = self.tile.plane(plane);
            let squares = self.wanted.ssim.is_some();
            self.ring.push(plane, y, &sum[..length], &difference[..length], squares);
        }
    }

    fn squared_error(&mut self, y: usize, xs: Range<usize>, offset: usize) {
        let planes = self.source.planes();
        let rows: [&[f32]; 3] = std::array::from_fn(|p| {
            &self.ring.row(p.min(planes - 1), 1, y, offset + xs.len())[offset..]
        });
        let squared = &mut self.squared[..xs.len()];
        squared_row(&rows[..planes], squared);
        let runs = self.regions.pixel_runs(y);
        add_by_band(squared, xs.start, runs, &mut self.sums.squared);
        if self.wanted.weight.is_some() {
            let weights = &self.weights[..xs.len()];
            self.sums.weighted_squared.add(weighted(squared, weights, xs.start, runs));
        }
    }

    /// Rows `y - 1` and `y`, `y` odd: both are in the ring, since a window has three rows or more.
    fn halve(&mut self, y: usize, xs: Range<usize>, offset: usize) {
        let Some(halved) = &mut self.halved else { return };
        let even = offset..offset + xs.len() / 2 * 2;
        for plane in 0..self.source.planes() {
            for part in 0..2 {
                let above = &self.ring.row(plane, part, y - 1, even.end)[even.clone()];
                let below = &self.ring.row(plane, part, y, even.end)[even.clone()];
                halved.put((plane, part), (y - self.rows.start) / 2, xs.start, above, below);
            }
        }
    }

    /// The map's row `y`, columns `xs`, in the tile that starts at column `tile_x`.
    fn map(&mut self, y: usize, tile_x: usize, xs: Range<usize>) {
        let Some(constants) = &self.wanted.ssim else { return };
        let n = xs.len();
        let runs = self.regions.window_runs(y);
        for plane in 0..self.source.planes() {
            let out = MapRow {
                ssim: &mut self.plane_map[..n],
                contrast_structure: &mut self.structure[..n],
            };
            map_row(&self.ring, plane, y, constants, &mut self.scratch, out);
            if self.wanted.scales != Scales::None {
                self.sums.channel_ssim[plane] += sum(&self.plane_map[..n]);
                self.sums.channel_structure[plane] += sum(&self.structure[..n]);
            }
            if plane == 0 {
                self.map[..n].copy_from_slice(&self.plane_map[..n]);
            } else {
                for (total, value) in self.map[..n].iter_mut().zip(&self.plane_map[..n]) {
                    *total += value;
                }
            }
        }
        for (from, to, band) in clipped(runs, xs.clone()) {
            self.sums.windows[usize::from(band)] += (to - from) as u64;
        }
        add_by_band(&self.map[..n], xs.start, runs, &mut self.sums.ssim);
        if self.wanted.weight.is_some() {
            let weights = &self.weights[xs.start - tile_x..xs.end - tile_x];
            self.sums.weighted_ssim.add(weighted(&self.map[..n], weights, xs.start, runs));
        }
    }
}
