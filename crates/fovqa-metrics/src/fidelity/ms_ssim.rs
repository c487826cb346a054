//! MS-SSIM (Wang, Simoncelli, Bovik 2003, Eq. 7): the product of the contrast-structure terms at
//! the first four scales and the full SSIM at the coarsest, each with its exponent.
//!
//! Exponents are used as printed (not normalised). Scales are 2x2 means, and an odd last row or
//! column is dropped. Negative means are clamped to 0. `rgb` averages the channels' scores. It is
//! in [0, 1], and higher is better.

use std::ops::Range;

use fovqa_frame::{BLOCK_ROWS, PairSignal, PairTile, Part};
use multiversion::multiversion;

use crate::info::{MetricInfo, Needs};
use crate::metric_params::MetricParams;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "ms_ssim",
    label: "MS-SSIM",
    needs: Needs { every_pixel: true, ..Needs::NOTHING },
    about: "structural similarity over five scales; sides of 176 px or more",
    source: "Wang, Simoncelli, Bovik 2003; window and constants are ssim's",
    ..MetricInfo::FIDELITY
};

/// MS-SSIM has no parameters of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Params;

impl MetricParams for Params {
    fn smallest_side(&self, ssim_window: usize) -> usize {
        ssim_window * COARSEST
    }
}

/// Exponents of the scales, finest first (Wang et al. 2003, section 3.2).
pub(crate) const EXPONENTS: [f64; 5] = [0.0448, 0.2856, 0.3001, 0.2363, 0.1333];

/// The factor between the sides of the picture and those of the coarsest scale.
pub(crate) const COARSEST: usize = 1 << (EXPONENTS.len() - 1);

/// Rows of sum and difference, of a pair of frames or of one of its coarser scales.
pub(crate) trait PairRows: Sync {
    fn size(&self) -> (usize, usize);
    fn planes(&self) -> usize;
    fn peak(&self) -> f32;
    /// If sums and differences come from 8-bit codes: the unit of which they are whole multiples.
    fn unit(&self) -> Option<f32>;
    fn fill(&self, y: usize, xs: Range<usize>, tile: &mut PairTile, row: usize);
}

impl PairRows for PairSignal<'_> {
    fn size(&self) -> (usize, usize) {
        (self.width(), self.height())
    }

    fn planes(&self) -> usize {
        self.planes()
    }

    fn peak(&self) -> f32 {
        self.peak()
    }

    fn unit(&self) -> Option<f32> {
        self.is_eight_bit().then_some(1.0)
    }

    fn fill(&self, y: usize, xs: Range<usize>, tile: &mut PairTile, row: usize) {
        self.fill(y, xs, tile, row);
    }
}

/// Rows of one scale at half the size, computed from one block of the finer scale.
#[derive(Debug)]
pub(crate) struct HalvedRows {
    width: usize,
    rows: usize,
    values: Values,
}

/// The values of a scale. Scales below 8-bit pictures hold quarters, sixteenths and so on. Two
/// bytes represent them exactly for three scales, which halves the memory; touching memory for the
/// first time costs as much as the arithmetic.
#[derive(Debug)]
enum Values {
    /// Whole multiples of a unit.
    Whole(Vec<i16>, f32),
    Floats(Vec<f32>),
}

/// The unit of the next scale, for values that are whole multiples of `unit`; `None` if two bytes
/// cannot hold them any more.
pub(crate) fn unit_below(unit: Option<f32>) -> Option<f32> {
    /// The largest sum or difference of two 8-bit codes.
    const LARGEST: f32 = 255.0;
    unit.map(|unit| unit / 4.0).filter(|below| LARGEST / below <= f32::from(i16::MAX))
}

impl HalvedRows {
    /// A buffer for the halves of `rows` rows of `width` pixels of a pair.
    pub(crate) fn of(pair: &impl PairRows, rows: usize) -> Self {
        let (width, rows) = (pair.size().0 / 2, rows / 2);
        let length = pair.planes() * 2 * width * rows;
        let values = match unit_below(pair.unit()) {
            Some(unit) => Values::Whole(vec![0; length], unit),
            None => Values::Floats(vec![0.0; length]),
        };
        Self { width, rows, values }
    }

    fn row(&self, plane: usize, part: Part, y: usize) -> Range<usize> {
        let start = ((plane * 2 + part as usize) * self.rows + y) * self.width;
        start..start + self.width
    }

    /// Halves two rows, whose first values are in the even column `x`.
    pub(crate) fn put(
        &mut self,
        (plane, part): (usize, Part),
        y: usize,
        x: usize,
        above: &[f32],
        below: &[f32],
    ) {
        let row = self.row(plane, part, y);
        match &mut self.values {
            Values::Whole(values, unit) => {
                halve_exactly(above, below, 0.25 / *unit, &mut values[row][x / 2..]);
            }
            Values::Floats(values) => halve(above, below, &mut values[row][x / 2..]),
        }
    }

    /// Reads a stretch of a row.
    fn get(&self, plane: usize, part: Part, y: usize, xs: Range<usize>, out: &mut [f32]) {
        let row = self.row(plane, part, y);
        match &self.values {
            Values::Whole(values, unit) => from_whole(&values[row][xs], *unit, out),
            Values::Floats(values) => out.copy_from_slice(&values[row][xs]),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn halve(above: &[f32], below: &[f32], out: &mut [f32]) {
    let (above, below) = (above.as_chunks::<2>().0, below.as_chunks::<2>().0);
    for ((out, a), b) in out.iter_mut().zip(above).zip(below) {
        *out = 0.25 * ((a[0] + a[1]) + (b[0] + b[1]));
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn halve_exactly(above: &[f32], below: &[f32], scale: f32, out: &mut [i16]) {
    let (above, below) = (above.as_chunks::<2>().0, below.as_chunks::<2>().0);
    for ((out, a), b) in out.iter_mut().zip(above).zip(below) {
        *out = (((a[0] + a[1]) + (b[0] + b[1])) * scale) as i16;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn from_whole(whole: &[i16], unit: f32, out: &mut [f32]) {
    for (out, value) in out.iter_mut().zip(whole) {
        *out = unit * f32::from(*value);
    }
}

/// A coarser scale of a pair.
#[derive(Debug)]
pub(crate) struct Scale {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) planes: usize,
    pub(crate) peak: f32,
    pub(crate) unit: Option<f32>,
    pub(crate) blocks: Vec<HalvedRows>,
}

impl PairRows for Scale {
    fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    fn planes(&self) -> usize {
        self.planes
    }

    fn peak(&self) -> f32 {
        self.peak
    }

    fn unit(&self) -> Option<f32> {
        self.unit
    }

    fn fill(&self, y: usize, xs: Range<usize>, tile: &mut PairTile, row: usize) {
        const HALVED_ROWS: usize = BLOCK_ROWS / 2;
        let block = &self.blocks[y / HALVED_ROWS];
        for plane in 0..self.planes {
            for part in [Part::Sum, Part::Difference] {
                let out = tile.row_mut(plane, part, row, xs.len());
                block.get(plane, part, y % HALVED_ROWS, xs.clone(), out);
            }
        }
    }
}

/// One channel's score from its means at the five scales: four of contrast-structure, and one of
/// SSIM.
pub(crate) fn combine(means: impl Iterator<Item = f64>) -> f64 {
    means.zip(EXPONENTS).map(|(mean, exponent)| libm::pow(mean.max(0.0), exponent)).product()
}
