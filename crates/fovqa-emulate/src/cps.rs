//! Coarse pixel shading: one sample for 1, 2x2 or 4x4 pixels (Patney et al. 2016, section 4.3).
//!
//! A pixel takes, unfiltered, the sample of the n x n cell that holds it; cells form a grid from the
//! frame's top-left corner. `continuous` blends grids of all rates instead.

use std::ops::Range;

use fovqa_frame::{BLOCK_ROWS, Mask};
use fovqa_methods::Setting;
use fovqa_methods::cps::{Cps as Mapped, Params, Quantise};

use crate::borders::{Border, circle};
use crate::counts::Counts;
use crate::grids::Grids;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::sample_places::SamplePlaces;
use crate::source::Source;
use crate::sums::{count_on, sum_over_mask, sum_over_pixels};
use crate::texel::narrowed;
use crate::value::Value;

/// Coarse pixel shading of a frame and a gaze.
#[derive(Debug)]
pub(crate) enum Cps {
    Cells(Cells),
    Continuous {
        grids: Grids,
        /// Samples for each pixel, by the distance from the gaze.
        density: Radial,
        samples: f64,
    },
}

/// Sides of the cells of more than one pixel. A block of rows holds a whole number of each.
const COARSE: [usize; 2] = [2, 4];
const _: () = assert!(BLOCK_ROWS.is_multiple_of(COARSE[1]));

/// Rates of 1, 1/2 and 1/4.
#[derive(Debug)]
pub(crate) struct Cells {
    /// Up to which distance every pixel is shaded, and up to which one of 2x2.
    reach_px: [f64; 2],
    offsets: Offsets,
    places: SamplePlaces,
}

impl Cps {
    pub(crate) fn new(params: &Params, setting: &Setting, places: SamplePlaces) -> Self {
        let offsets = Offsets::new(setting);
        let Params { foveal_deg, transition_deg, quantise } = *params;
        // The share of the fall after which the request is below 1/2 and 1/4, or 3/4 and 3/8.
        let shares = match quantise {
            Quantise::Ceil => [2.0 / 3.0, 1.0],
            Quantise::Nearest => [1.0 / 3.0, 5.0 / 6.0],
            Quantise::Continuous => {
                let mapped = Mapped::new(params, setting);
                let request = |r: f64| mapped.request(setting.eccentricity_deg(r));
                let (fine, reach) = (Detail::Fine, setting.corner_px());
                let density = Radial::new(fine, reach, |r| request(r) * request(r));
                let samples = sum_over_pixels(&density, &offsets);
                let level = Radial::new(fine, reach, |r| -libm::log2(request(r)));
                let grids = Grids::new(level, offsets, places);
                return Self::Continuous { grids, density, samples };
            }
        };
        let reach_px = shares.map(|share| {
            let bound_deg = foveal_deg + share * transition_deg;
            if bound_deg < 90.0 { setting.radius_px(bound_deg) } else { f64::INFINITY }
        });
        Self::Cells(Cells { reach_px, offsets, places })
    }

    /// The circles at which the rate changes.
    pub(crate) fn borders(&self) -> Vec<Border> {
        let Self::Cells(cells) = self else { return Vec::new() };
        let gaze = cells.offsets.gaze_px();
        cells.reach_px.into_iter().filter_map(|radius| circle(gaze, radius)).collect()
    }

    pub(crate) fn counts(&self) -> Counts {
        match self {
            Self::Cells(cells) => {
                let samples = [1, 2, 4].map(|n| cells.used(n, n)).iter().sum::<u64>();
                let quads = [1, 2, 4].map(|n| cells.used(n, 2 * n)).iter().sum();
                Counts { quads: Some(quads), ..Counts::on_screen(Vec::new(), samples as f64) }
            }
            Self::Continuous { samples, .. } => Counts::on_screen(Vec::new(), *samples),
        }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Cells(cells) => cells.positions(),
            Self::Continuous { grids, .. } => grids.positions().collect(),
        }
    }

    /// Samples on the pixels of a mask.
    pub(crate) fn samples_on(&self, mask: &Mask) -> f64 {
        match self {
            Self::Cells(cells) => count_on(mask, cells.positions()) as f64,
            Self::Continuous { grids, density, .. } => {
                sum_over_mask(density, grids.offsets(), mask)
            }
        }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        match self {
            Self::Cells(cells) => cells.show(source),
            Self::Continuous { grids, .. } => grids.show(source),
        }
    }
}

impl Cells {
    /// The pixels of row `y` that share a sample with n x n.
    fn pixels(&self, n: usize, y: usize) -> [Range<usize>; 2] {
        let [one, two] = self.reach_px.map(|reach| self.offsets.within(y, reach));
        let around = |outer: Range<usize>, inner: Range<usize>| {
            if inner.is_empty() {
                [outer, 0..0]
            } else {
                [outer.start..inner.start, inner.end..outer.end]
            }
        };
        match n {
            1 => [one, 0..0],
            2 => around(two, one),
            _ => around(0..self.offsets.width(), two),
        }
    }

    /// How many blocks of `side` x `side` pixels hold a pixel that shares its sample with n x n.
    fn used(&self, n: usize, side: usize) -> u64 {
        let mut used = 0;
        self.each_row_of_blocks(n, side, |_, blocks| {
            used += blocks.iter().filter(|used| **used).count() as u64;
        });
        used
    }

    /// Visits the rows of these blocks: their numbers, and which blocks hold such a pixel.
    fn each_row_of_blocks(&self, n: usize, side: usize, mut visit: impl FnMut(usize, &[bool])) {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let mut blocks = vec![false; width.div_ceil(side)];
        for top in (0..height).step_by(side) {
            blocks.fill(false);
            for y in top..(top + side).min(height) {
                for xs in self.pixels(n, y).into_iter().filter(|xs| !xs.is_empty()) {
                    blocks[xs.start / side..xs.end.div_ceil(side)].fill(true);
                }
            }
            visit(top / side, &blocks);
        }
    }

    /// Where the samples in use stand, in pixels.
    fn positions(&self) -> Vec<[f64; 2]> {
        let within = [0, 1].map(|axis| self.places.axis(axis).within_cell);
        let mut positions = Vec::new();
        for n in [1, 2, 4] {
            self.each_row_of_blocks(n, n, |k, cells| {
                let used = cells.iter().enumerate().filter(|(_, used)| **used);
                positions.extend(used.map(|(i, _)| {
                    [(i as f64 + within[0]) * n as f64, (k as f64 + within[1]) * n as f64]
                }));
            });
        }
        positions
    }

    fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        // The samples of the cells that hold a row: blocks of rows begin with a row of cells, so that
        // each sample is taken once.
        let room = || COARSE.map(|n| vec![None; width.div_ceil(n)]);
        Image::by_rows_with(width, height, room, |taken, y, row| {
            let [shaded, _] = self.pixels(1, y);
            source.sample_pixels(self.places, y, shaded.clone(), &mut row[shaded]);
            for (n, taken) in COARSE.into_iter().zip(taken) {
                if y.is_multiple_of(n) {
                    taken.fill(None);
                }
                for xs in self.pixels(n, y) {
                    let mut from = xs.start;
                    while from < xs.end {
                        let cell = from / n;
                        let to = ((cell + 1) * n).min(xs.end);
                        let sample =
                            *taken[cell].get_or_insert_with(|| self.sample(source, n, cell, y / n));
                        row[from..to].fill(sample);
                        from = to;
                    }
                }
            }
        })
    }

    /// The sample of a cell.
    fn sample<const C: usize>(
        &self,
        source: &impl Source<C>,
        n: usize,
        i: usize,
        k: usize,
    ) -> [f32; C] {
        let n = n as f64;
        let position = |x: f64, y: f64| [(i as f64 + x) * n, (k as f64 + y) * n];
        narrowed(source.sample(self.places, position))
    }
}
