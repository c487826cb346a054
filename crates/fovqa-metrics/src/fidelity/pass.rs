//! One pass over the rows of a pair, which computes every sum that the metrics need, block by
//! block.
//!
//! A block is divided into tiles of columns. A tile is read with all rows and columns that its
//! windows cover. Then each plane is processed row by row, so that the eleven rows of a window stay
//! in the first-level cache. Finally the rows of the finished map are summed.

use std::ops::Range;

use fovqa_frame::{BLOCK_ROWS, PairTile, Part, map_row_blocks};
use fovqa_vision::Run;

use super::fpsnr::WeightField;
use super::ms_ssim::{HalvedRows, PairRows, Scale, unit_below};
use super::mse::squared_row;
use super::ssim::rows::{Constants, MapRow, Scratch, map_row};
use super::weighted_mean::WeightedMean;
use crate::map::scaled;
use crate::regions::{Regions, clipped};
use crate::sums::{add_by_band, sum, weighted};

/// The number of columns of a tile. It is even, for the 2x2 means. Eleven rows of sum and
/// difference take 23 kB, and the whole tile in RGB takes half a megabyte.
const TILE_COLUMNS: usize = 256;

/// The sums that a pass computes.
#[derive(Debug)]
pub(crate) struct Wanted<'a> {
    /// Squared error per band.
    pub(crate) squared_error: bool,
    /// Squared error and map, both weighted.
    pub(crate) weight: Option<&'a WeightField>,
    /// The SSIM map.
    pub(crate) ssim: Option<Constants>,
    /// The sums for MS-SSIM.
    pub(crate) scales: Scales,
    /// The per-pixel values that are kept.
    pub(crate) maps: WantedMaps,
}

/// The per-pixel values that are kept.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WantedMaps {
    /// The squared error.
    pub(crate) squared_error: bool,
    /// SSIM.
    pub(crate) ssim: bool,
}

/// Per-pixel values, row by row; NaN where a pixel is left out. Empty if they are not wanted.
#[derive(Debug, Default)]
pub(crate) struct PixelMaps {
    pub(crate) squared_error: Vec<f32>,
    pub(crate) ssim: Vec<f32>,
}

impl PixelMaps {
    fn new(wanted: WantedMaps, pixels: usize) -> Self {
        let map = |wanted: bool| vec![f32::NAN; if wanted { pixels } else { 0 }];
        Self { squared_error: map(wanted.squared_error), ssim: map(wanted.ssim) }
    }
}

/// The sums for MS-SSIM at one scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scales {
    /// Nothing.
    None,
    /// The contrast-structure term of each channel, and the next scale.
    AndNext,
    /// The full SSIM of each channel, at the coarsest scale.
    Last,
}

/// Sums over a frame, or over one block of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sums {
    /// Squared error of all planes: for each band, then outside all bands.
    pub(crate) squared: Vec<f64>,
    /// Σ f² d² and Σ f².
    pub(crate) weighted_squared: WeightedMean,
    /// SSIM of all planes: for each band, then outside all bands.
    pub(crate) ssim: Vec<f64>,
    /// The number of windows in each sum of `ssim`.
    pub(crate) windows: Vec<u64>,
    /// Σ f² map and Σ f² over windows, with the map summed over planes.
    pub(crate) weighted_ssim: WeightedMean,
    /// For each plane, the sum that MS-SSIM takes from this scale.
    pub(crate) channels: [f64; 3],
}

impl Sums {
    pub(crate) fn new(bands: usize) -> Self {
        Self {
            squared: vec![0.0; bands + 1],
            weighted_squared: WeightedMean::default(),
            ssim: vec![0.0; bands + 1],
            windows: vec![0; bands + 1],
            weighted_ssim: WeightedMean::default(),
            channels: [0.0; 3],
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
        add(&mut self.channels, &other.channels);
        for (mine, theirs) in self.windows.iter_mut().zip(&other.windows) {
            *mine += theirs;
        }
        self.weighted_squared.merge(&other.weighted_squared);
        self.weighted_ssim.merge(&other.weighted_ssim);
    }
}

/// Runs the pass over blocks of rows in parallel, and adds their sums in order. Returns the next
/// scale if it is wanted.
pub(crate) fn run(
    rows: &impl PairRows,
    regions: &Regions<'_>,
    wanted: &Wanted<'_>,
) -> (Sums, Option<Scale>, PixelMaps) {
    let (width, height) = rows.size();
    let blocks = map_row_blocks(height, |range| {
        let mut block = Block::new(rows, regions, wanted, range);
        for x in (0..width).step_by(TILE_COLUMNS) {
            block.tile(x..(x + TILE_COLUMNS).min(width));
        }
        (block.sums, block.halved, block.maps)
    });
    let mut sums = Sums::new(regions.bands());
    let mut halved = Vec::new();
    let mut maps = PixelMaps::default();
    let pixels = |wanted: bool| if wanted { width * height } else { 0 };
    maps.squared_error.reserve_exact(pixels(wanted.maps.squared_error));
    maps.ssim.reserve_exact(pixels(wanted.maps.ssim));
    for (block, rows, of_block) in blocks {
        sums.merge(&block);
        halved.extend(rows);
        maps.squared_error.extend(of_block.squared_error);
        maps.ssim.extend(of_block.ssim);
    }
    let scale = (wanted.scales == Scales::AndNext).then(|| Scale {
        width: width / 2,
        height: height / 2,
        planes: rows.planes(),
        peak: rows.peak(),
        unit: unit_below(rows.unit()),
        blocks: halved,
    });
    (sums, scale, maps)
}

struct Block<'a, R> {
    source: &'a R,
    regions: &'a Regions<'a>,
    wanted: &'a Wanted<'a>,
    rows: Range<usize>,
    radius: usize,
    tile: PairTile,
    scratch: Scratch,
    /// One row of each: squared error, weights, a plane's map, its contrast-structure.
    squared: Vec<f32>,
    weights: Vec<f32>,
    plane_map: Vec<f32>,
    structure: Vec<f32>,
    /// The sum of the maps of all planes, in rows of `TILE_COLUMNS`.
    map: Vec<f32>,
    sums: Sums,
    halved: Option<HalvedRows>,
    /// The per-pixel values of the block's rows.
    maps: PixelMaps,
}

/// A tile: its own columns, and the columns read for the windows around them.
struct Tile {
    xs: Range<usize>,
    read: Range<usize>,
    /// The first row that was read.
    top: usize,
    /// The columns and rows of the map.
    map_xs: Range<usize>,
    map_ys: Range<usize>,
}

impl<'a, R: PairRows> Block<'a, R> {
    fn new(
        source: &'a R,
        regions: &'a Regions<'a>,
        wanted: &'a Wanted<'a>,
        rows: Range<usize>,
    ) -> Self {
        let (width, _) = source.size();
        let radius = wanted.ssim.as_ref().map_or(0, Constants::radius);
        let columns = TILE_COLUMNS.min(width) + 2 * radius;
        let row = || vec![0.0; columns];
        let map_rows = if wanted.ssim.is_some() { BLOCK_ROWS } else { 0 };
        Self {
            source,
            regions,
            wanted,
            radius,
            tile: PairTile::new(columns, rows.len() + 2 * radius),
            scratch: Scratch::new(columns),
            squared: row(),
            weights: row(),
            plane_map: row(),
            structure: row(),
            map: vec![0.0; map_rows * TILE_COLUMNS],
            sums: Sums::new(regions.bands()),
            halved: (wanted.scales == Scales::AndNext).then(|| HalvedRows::of(source, rows.len())),
            maps: PixelMaps::new(wanted.maps, width * rows.len()),
            rows,
        }
    }

    fn tile(&mut self, xs: Range<usize>) {
        let (width, height) = self.source.size();
        let radius = self.radius;
        let inside = |range: &Range<usize>, side: usize| {
            range.start.max(radius)..range.end.min(side.saturating_sub(radius))
        };
        let tile = Tile {
            read: xs.start.saturating_sub(radius)..(xs.end + radius).min(width),
            top: self.rows.start.saturating_sub(radius),
            map_xs: inside(&xs, width),
            map_ys: inside(&self.rows, height),
            xs,
        };
        for y in tile.top..(self.rows.end + radius).min(height) {
            self.source.fill(y, tile.read.clone(), &mut self.tile, y - tile.top);
        }
        let mapped = self.wanted.ssim.is_some() && !tile.map_xs.is_empty();
        if mapped {
            for plane in 0..self.source.planes() {
                self.map_plane(plane, &tile);
            }
        }
        for y in self.rows.clone() {
            if let Some(field) = self.wanted.weight {
                field.fill_row(y, tile.xs.clone(), &mut self.weights[..tile.xs.len()]);
            }
            if self.wanted.squared_error {
                self.sum_squared_error(y, &tile);
            }
            if mapped && tile.map_ys.contains(&y) {
                self.sum_map(y, &tile);
            }
            if y % 2 == 1 {
                self.halve(y, &tile);
            }
        }
    }

    /// Adds one plane's map to the sum of all planes.
    fn map_plane(&mut self, plane: usize, tile: &Tile) {
        let Some(constants) = &self.wanted.ssim else { return };
        let n = tile.map_xs.len();
        for y in tile.map_ys.clone() {
            let start = (y - self.rows.start) * TILE_COLUMNS;
            let total = &mut self.map[start..start + n];
            let structure = &mut self.structure[..n];
            let ssim = if plane == 0 { &mut *total } else { &mut self.plane_map[..n] };
            let mut out = MapRow { ssim: &mut *ssim, contrast_structure: &mut *structure };
            map_row(&self.tile, plane, y - tile.top, constants, &mut self.scratch, &mut out);
            match self.wanted.scales {
                Scales::None => {}
                Scales::AndNext => self.sums.channels[plane] += sum(structure),
                Scales::Last => self.sums.channels[plane] += sum(ssim),
            }
            if plane > 0 {
                for (total, value) in total.iter_mut().zip(&self.plane_map[..n]) {
                    *total += value;
                }
            }
        }
    }

    fn sum_squared_error(&mut self, y: usize, tile: &Tile) {
        let planes = self.source.planes();
        let offset = tile.xs.start - tile.read.start;
        let n = tile.xs.len();
        let rows: [&[f32]; 3] = std::array::from_fn(|p| {
            let plane = p.min(planes - 1);
            &self.tile.row(plane, Part::Difference, y - tile.top, offset + n)[offset..]
        });
        let squared = &mut self.squared[..n];
        squared_row(&rows[..planes], squared);
        let runs = self.regions.pixel_runs(y);
        add_by_band(squared, tile.xs.start, runs, &mut self.sums.squared);
        if self.wanted.maps.squared_error {
            let peak = self.source.peak();
            let start = (y - self.rows.start) * self.source.size().0;
            let row = &mut self.maps.squared_error[start..];
            keep(squared, 1.0 / (planes as f32 * peak * peak), tile.xs.start, runs, row);
        }
        if self.wanted.weight.is_some() {
            let weights = &self.weights[..n];
            self.sums.weighted_squared.add(weighted(squared, weights, tile.xs.start, runs));
        }
    }

    fn sum_map(&mut self, y: usize, tile: &Tile) {
        let xs = tile.map_xs.clone();
        let start = (y - self.rows.start) * TILE_COLUMNS;
        let map = &self.map[start..start + xs.len()];
        let runs = self.regions.window_runs(y);
        for (from, to, band) in clipped(runs, xs.clone()) {
            self.sums.windows[usize::from(band)] += (to - from) as u64;
        }
        add_by_band(map, xs.start, runs, &mut self.sums.ssim);
        if self.wanted.maps.ssim {
            let start = (y - self.rows.start) * self.source.size().0;
            let row = &mut self.maps.ssim[start..];
            keep(map, 1.0 / self.source.planes() as f32, xs.start, runs, row);
        }
        if self.wanted.weight.is_some() {
            let weights = &self.weights[xs.start - tile.xs.start..xs.end - tile.xs.start];
            self.sums.weighted_ssim.add(weighted(map, weights, xs.start, runs));
        }
    }

    /// Halves rows `y - 1` and `y` for the next scale. `y` is odd, so both rows belong to this
    /// block.
    fn halve(&mut self, y: usize, tile: &Tile) {
        let Some(halved) = &mut self.halved else { return };
        let offset = tile.xs.start - tile.read.start;
        let even = offset..offset + tile.xs.len() / 2 * 2;
        for plane in 0..self.source.planes() {
            for part in [Part::Sum, Part::Difference] {
                let row =
                    |y: usize| &self.tile.row(plane, part, y - tile.top, even.end)[even.clone()];
                let below = (y - self.rows.start) / 2;
                halved.put((plane, part), below, tile.xs.start, row(y - 1), row(y));
            }
        }
    }
}

/// Stores the scaled values of a stretch of a row, which starts in column `x`, for the pixels that
/// count.
fn keep(values: &[f32], scale: f32, x: usize, runs: &[Run], row: &mut [f32]) {
    for (from, to, _) in clipped(runs, x..x + values.len()) {
        scaled(&values[from - x..to - x], scale, &mut row[from..to]);
    }
}
