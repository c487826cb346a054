//! One pass over the rows of a picture: moments of bands, the wavelet pyramid, and the luma itself
//! for the comparison with the next frame.
//!
//! A block of rows is divided into tiles of columns. Two rows make a row of the next level, and two
//! of those make a row of the level after it. So a pyramid needs only a few rows, which stay in the
//! first-level cache.

use std::ops::Range;

use fovqa_frame::{BLOCK_ROWS, LumaScratch, LumaSignal};
use multiversion::multiversion;
use rayon::prelude::*;

use super::haar::{self, Sums};
use super::rms_contrast::Moments;
use crate::regions::{BlockRegions, Regions, clipped};
use crate::temporal::kept_plane::KeptPlane;

/// The number of columns of a tile: a multiple of the side of the coarsest block within a block of
/// rows.
const TILE_COLUMNS: usize = 512;
/// The number of levels whose blocks lie within one block of rows. Higher levels are computed from
/// the means that these levels leave.
const LEVELS_WITHIN: usize = BLOCK_ROWS.trailing_zeros() as usize;
const _: () = assert!(TILE_COLUMNS.is_multiple_of(1 << LEVELS_WITHIN));

/// The inputs and sums of a pass.
pub(crate) struct Wanted<'a> {
    pub(crate) luma: &'a LumaSignal<'a>,
    /// The signal whose contrast is computed: the luma, or another signal.
    pub(crate) contrast: Option<Contrast<'a>>,
    pub(crate) regions: &'a Regions<'a>,
    /// The blocks of each level of the wavelet.
    pub(crate) blocks: Option<&'a BlockRegions<'a>>,
}

/// The signal whose contrast is computed.
#[derive(Clone, Copy)]
pub(crate) enum Contrast<'a> {
    Luma,
    Of(&'a LumaSignal<'a>),
}

/// Sums over a picture, or over one block of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ProfileSums {
    /// For each band, then outside all bands.
    pub(crate) moments: Vec<Moments>,
    /// For each level and band: LH, HL and HH.
    pub(crate) haar: Vec<Vec<[Sums; 3]>>,
}

impl ProfileSums {
    fn new(bands: usize, levels: usize) -> Self {
        Self {
            moments: vec![Moments::default(); bands + 1],
            haar: vec![vec![[Sums::default(); 3]; bands + 1]; levels],
        }
    }

    fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.moments.iter_mut().zip(&other.moments) {
            mine.merge(theirs);
        }
        for (mine, theirs) in self.haar.iter_mut().flatten().zip(other.haar.iter().flatten()) {
            for (mine, theirs) in mine.iter_mut().zip(theirs) {
                mine.merge(theirs);
            }
        }
    }
}

/// Runs the pass over blocks of rows in parallel, and adds their sums in order. `plane`, which has
/// the picture's size, receives the luma.
pub(crate) fn run(wanted: &Wanted<'_>, plane: Option<&mut KeptPlane>) -> ProfileSums {
    let (width, height) = (wanted.luma.width(), wanted.luma.height());
    let ranges = (0..height).step_by(BLOCK_ROWS).map(|y| y..(y + BLOCK_ROWS).min(height));
    let rows: Vec<Option<&mut [f32]>> = match plane {
        Some(plane) => plane.values_mut().chunks_mut(BLOCK_ROWS * width).map(Some).collect(),
        None => (0..height.div_ceil(BLOCK_ROWS)).map(|_| None).collect(),
    };
    let work: Vec<_> = ranges.zip(rows).collect();
    let blocks: Vec<(ProfileSums, Vec<f64>)> = work
        .into_par_iter()
        .map(|(range, plane)| {
            let mut block = Block::new(wanted, range, plane);
            for x in (0..width).step_by(TILE_COLUMNS) {
                block.tile(x..(x + TILE_COLUMNS).min(width));
            }
            (block.sums, block.means)
        })
        .collect();
    let levels = wanted.blocks.map_or(0, BlockRegions::levels);
    let mut sums = ProfileSums::new(wanted.regions.bands(), levels);
    let mut means = Vec::new();
    for (block, rest) in blocks {
        sums.merge(&block);
        means.extend(rest);
    }
    if let Some(blocks) = wanted.blocks.filter(|blocks| blocks.levels() > LEVELS_WITHIN) {
        coarse_levels(&means, blocks, &mut sums);
    }
    sums
}

/// Computes the levels above [`LEVELS_WITHIN`] from the means that this level leaves.
fn coarse_levels(means: &[f64], blocks: &BlockRegions<'_>, sums: &mut ProfileSums) {
    let width = blocks.columns(LEVELS_WITHIN);
    let mut pyramid = Pyramid::new(LEVELS_WITHIN, blocks.levels(), width);
    for (y, row) in means.chunks_exact(width).enumerate() {
        pyramid.row_mut(y, width).copy_from_slice(row);
        pyramid.rise(y, 0..width, blocks, sums);
    }
}

struct Block<'a> {
    wanted: &'a Wanted<'a>,
    rows: Range<usize>,
    /// The block's rows of the luma plane.
    plane: Option<&'a mut [f32]>,
    scratch: LumaScratch,
    row: Vec<f64>,
    pyramid: Pyramid,
    sums: ProfileSums,
    /// The means that the last level within the block leaves, if there are levels above it.
    means: Vec<f64>,
}

impl<'a> Block<'a> {
    fn new(wanted: &'a Wanted<'a>, rows: Range<usize>, plane: Option<&'a mut [f32]>) -> Self {
        let columns = TILE_COLUMNS.min(wanted.luma.width());
        let levels = wanted.blocks.map_or(0, BlockRegions::levels);
        Self {
            wanted,
            rows,
            plane,
            scratch: LumaScratch::new(columns),
            row: vec![0.0; columns],
            pyramid: Pyramid::new(0, levels.min(LEVELS_WITHIN), columns),
            sums: ProfileSums::new(wanted.regions.bands(), levels),
            means: Vec::new(),
        }
    }

    fn tile(&mut self, xs: Range<usize>) {
        let columns = xs.len();
        for y in self.rows.clone() {
            let luma = self.pyramid.row_mut(y, columns);
            self.wanted.luma.fill_row(y, xs.clone(), &mut self.scratch, luma);
            if let Some(plane) = &mut self.plane {
                let width = self.wanted.luma.width();
                let start = (y - self.rows.start) * width;
                narrow(luma, &mut plane[start + xs.start..start + xs.end]);
            }
            let contrast = match self.wanted.contrast {
                None => None,
                Some(Contrast::Luma) => Some(&*luma),
                Some(Contrast::Of(signal)) => {
                    signal.fill_row(y, xs.clone(), &mut self.scratch, &mut self.row[..columns]);
                    Some(&self.row[..columns])
                }
            };
            if let Some(values) = contrast {
                let runs = self.wanted.regions.pixel_runs(y);
                for (from, to, band) in clipped(runs, xs.clone()) {
                    let moments = Moments::of(&values[from - xs.start..to - xs.start]);
                    self.sums.moments[usize::from(band)].merge(&moments);
                }
            }
            if let Some(blocks) = self.wanted.blocks {
                let left = self.pyramid.rise(y, xs.clone(), blocks, &mut self.sums);
                if blocks.levels() > LEVELS_WITHIN {
                    self.means.extend_from_slice(left);
                }
            }
        }
    }
}

/// The rows of a wavelet transform that are still needed: two per level.
struct Pyramid {
    /// The level of the input rows: 0 for pixels.
    base: usize,
    /// The last level.
    levels: usize,
    /// An even and an odd row for each level, starting with `base`.
    rows: Vec<[Vec<f64>; 2]>,
    details: [Vec<f64>; 3],
}

impl Pyramid {
    fn new(base: usize, levels: usize, columns: usize) -> Self {
        let row = |level: usize| vec![0.0; columns >> (level - base)];
        Self {
            base,
            levels,
            rows: (base..=levels.max(base)).map(|level| [row(level), row(level)]).collect(),
            details: std::array::from_fn(|_| vec![0.0; columns / 2]),
        }
    }

    /// The buffer for row `y` of the base level.
    fn row_mut(&mut self, y: usize, columns: usize) -> &mut [f64] {
        &mut self.rows[0][y % 2][..columns]
    }

    /// Processes row `y` of the base level, columns `xs` of the frame, and every level whose second
    /// row this completes. Returns the row of means that the last level leaves, or an empty one.
    fn rise(
        &mut self,
        y: usize,
        xs: Range<usize>,
        blocks: &BlockRegions<'_>,
        sums: &mut ProfileSums,
    ) -> &[f64] {
        let mut y = y;
        for level in self.base + 1..=self.levels {
            if y.is_multiple_of(2) {
                return &[];
            }
            y /= 2;
            let shift = level - self.base;
            let columns = (xs.start >> shift)..(xs.end >> shift).min(blocks.columns(level));
            if y >= blocks.rows(level) || columns.is_empty() {
                return &[];
            }
            let n = columns.len();
            let (below, above) = self.rows.split_at_mut(shift);
            let [top, bottom] = &below[shift - 1];
            let [lh, hl, hh] = &mut self.details;
            let details = [&mut lh[..n], &mut hl[..n], &mut hh[..n]];
            haar::level(top, bottom, &mut above[0][y % 2][..n], details);
            for (from, to, band) in clipped(blocks.runs(level, y), columns.clone()) {
                let stretch = from - columns.start..to - columns.start;
                let sums = &mut sums.haar[level - 1][usize::from(band)];
                for (sums, details) in sums.iter_mut().zip(&self.details) {
                    sums.merge(&haar::sums(&details[stretch.clone()]));
                }
            }
            if level == self.levels {
                return &self.rows[shift][y % 2][..n];
            }
        }
        &[]
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn narrow(values: &[f64], out: &mut [f32]) {
    for (out, &value) in out.iter_mut().zip(values) {
        *out = value as f32;
    }
}
