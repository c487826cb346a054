//! The assignment of pixels to bands: the bands of the view, without the pixels that a mask leaves
//! out.

use std::borrow::Cow;

use fovqa_frame::Mask;
use fovqa_vision::{BandEdges, BandMap, Eccentricity, Run};

/// The band of a pixel that is in no sum at all. A pixel outside all bands still counts for the
/// whole frame; its band is the number of bands.
pub(crate) const LEFT_OUT: u16 = u16::MAX;

/// The bands of pixels, and of the windows centred on them.
#[derive(Debug, Clone)]
pub struct Regions<'a> {
    pixels: Cow<'a, BandMap>,
    /// `None` if the bands of the pixels apply: without a mask, a window counts wherever it fits.
    windows: Option<BandMap>,
    left_out: u64,
}

impl<'a> Regions<'a> {
    /// Regions in which every pixel counts.
    pub fn unmasked(bands: &'a BandMap) -> Self {
        Self { pixels: Cow::Borrowed(bands), windows: None, left_out: 0 }
    }

    /// Regions in which only the pixels of a mask count, and only windows of radius `window_radius`
    /// that lie completely within it.
    pub fn masked(bands: &BandMap, mask: &Mask, window_radius: usize) -> Regions<'static> {
        let clean = mask.eroded(window_radius);
        Regions {
            pixels: Cow::Owned(intersection(bands, mask)),
            windows: Some(intersection(bands, &clean)),
            left_out: mask.left_out(),
        }
    }

    /// The number of bands.
    pub(crate) fn bands(&self) -> usize {
        self.pixels.bands()
    }

    /// The number of rows of the frames.
    pub(crate) fn rows(&self) -> usize {
        self.pixels.rows()
    }

    /// Whether there is a mask.
    pub(crate) fn is_masked(&self) -> bool {
        self.windows.is_some()
    }

    /// The number of pixels that the mask leaves out.
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    /// The number of pixels in each band, then the number outside all bands.
    pub(crate) fn pixels(&self) -> Vec<u64> {
        self.pixels.pixels()
    }

    pub(crate) fn pixel_runs(&self, y: usize) -> &[Run] {
        self.pixels.row(y)
    }

    /// The stretches of row `y` that a mask leaves out, within the columns `xs`.
    pub(crate) fn left_out_in(
        &self,
        y: usize,
        xs: std::ops::Range<usize>,
    ) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let mut from = 0;
        let within = move |run: &Run| {
            let (start, end) = (from, run.end as usize);
            from = end;
            let stretch = start.max(xs.start)..end.min(xs.end);
            (run.band == LEFT_OUT && !stretch.is_empty()).then_some(stretch)
        };
        self.pixel_runs(y).iter().filter_map(within)
    }

    pub(crate) fn window_runs(&self, y: usize) -> &[Run] {
        self.windows.as_ref().unwrap_or(&self.pixels).row(y)
    }
}

/// The bands of the blocks of each level of a wavelet transform. Level 1 has blocks of 2x2 pixels,
/// and every level halves the number of blocks in both directions.
#[derive(Debug, Clone, Default)]
pub struct BlockRegions<'a>(Cow<'a, [BandMap]>);

impl<'a> BlockRegions<'a> {
    /// Regions in which every block counts, with one map per level as from [`BlockRegions::maps`].
    pub fn unmasked(maps: &'a [BandMap]) -> Self {
        Self(Cow::Borrowed(maps))
    }

    /// Regions in which only blocks count that lie completely within the mask.
    pub fn masked(maps: &[BandMap], mask: &Mask) -> BlockRegions<'static> {
        let mut clean = mask.clone();
        let maps = maps.iter().map(|map| {
            clean = clean.halved();
            intersection(map, &clean)
        });
        BlockRegions(Cow::Owned(maps.collect()))
    }

    /// The maps of `levels` levels, for pictures that are cropped at the right and bottom to whole
    /// blocks of the last level.
    pub fn maps(eccentricity: &Eccentricity, edges: &BandEdges, levels: usize) -> Vec<BandMap> {
        let (width, height) = (eccentricity.view().width, eccentricity.view().height);
        let maps = (1..=levels).map(|level| {
            let count = [width, height].map(|side| (side >> levels) << (levels - level));
            BandMap::of_blocks(eccentricity, edges, 1 << level, count)
        });
        maps.collect()
    }

    /// Such maps without bands: every block is outside.
    pub fn maps_without_bands((width, height): (usize, usize), levels: usize) -> Vec<BandMap> {
        let side = |side: usize, level: usize| (side >> levels) << (levels - level);
        let map = |level| BandMap::without_bands(side(width, level), side(height, level));
        (1..=levels).map(map).collect()
    }

    pub(crate) fn levels(&self) -> usize {
        self.0.len()
    }

    /// The number of blocks of a level across the picture.
    pub(crate) fn columns(&self, level: usize) -> usize {
        match self.0[level - 1].rows() {
            0 => 0,
            _ => self.0[level - 1].row(0).last().map_or(0, |run| run.end as usize),
        }
    }

    /// The number of blocks of a level down the picture.
    pub(crate) fn rows(&self, level: usize) -> usize {
        self.0[level - 1].rows()
    }

    /// The number of blocks of a level in each band, then outside all bands.
    pub(crate) fn counts(&self, level: usize) -> Vec<u64> {
        self.0[level - 1].pixels()
    }

    pub(crate) fn runs(&self, level: usize, y: usize) -> &[Run] {
        self.0[level - 1].row(y)
    }
}

fn intersection(bands: &BandMap, mask: &Mask) -> BandMap {
    // The mask of blocks also includes blocks that the crop leaves out.
    BandMap::from_rows(bands.bands(), bands.rows(), |y, runs| {
        let first = runs.len();
        let mut from = 0;
        for run in bands.row(y) {
            for (x, valid) in (from..run.end).zip(&mask.row(y)[from as usize..run.end as usize]) {
                let band = if *valid { run.band } else { LEFT_OUT };
                match runs[first..].last_mut() {
                    Some(last) if last.band == band => last.end = x + 1,
                    _ => runs.push(Run { end: x + 1, band }),
                }
            }
            from = run.end;
        }
    })
}

/// The parts of runs that lie in the columns `xs`, as `(from, to, band)`.
pub(crate) fn clipped(
    runs: &[Run],
    xs: std::ops::Range<usize>,
) -> impl Iterator<Item = (usize, usize, u16)> + '_ {
    let first = runs.partition_point(|run| run.end as usize <= xs.start);
    let mut from = xs.start;
    runs[first..]
        .iter()
        .map(move |run| {
            let to = (run.end as usize).min(xs.end);
            let stretch = (from, to, run.band);
            from = to;
            stretch
        })
        .take_while(|(from, to, _)| from < to)
        .filter(|(_, _, band)| *band != LEFT_OUT)
}
