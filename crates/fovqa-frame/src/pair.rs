//! Reference and test together, as their sum and their difference.
//!
//! Fidelity metrics need nothing else: the squared error is the square of the difference, and
//! SSIM's moments follow from those of sum and difference (`2 ab = ((a+b)² - (a-b)²) / 2`). With
//! this form, equal pictures stay equal to the last bit, and integer codes stay exact.

use std::ops::Range;

use multiversion::multiversion;

use crate::frame::{Channels, Frame};
use crate::side::Side;
use crate::signal::SignalTables;
use crate::signal_params::{Luma, SignalChannels};

/// Two frames of one size, ready to be read row by row.
#[derive(Debug)]
pub struct PairSignal<'a> {
    reference: Side<'a>,
    test: Side<'a>,
    width: usize,
    height: usize,
    planes: usize,
    luma: bool,
    peak: f32,
}

/// A tile of a pair: some rows of some columns. For each plane it holds the centred sum
/// `a + b - peak` and the difference `a - b`.
#[derive(Debug)]
pub struct PairTile {
    values: Vec<f32>,
    /// Index where the first row starts. Every row starts at the border of a cache line.
    origin: usize,
    stride: usize,
    rows: usize,
}

/// The sum or the difference of the pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// `a + b - peak`.
    Sum,
    /// `a - b`.
    Difference,
}

/// The number of planes that a tile has room for: luma is computed from three.
const TILE_PLANES: usize = 3;

impl PairTile {
    /// A tile for `rows` rows of up to `columns` pixels.
    pub fn new(columns: usize, rows: usize) -> Self {
        const LINE_BYTES: usize = 64;
        const LINE: usize = LINE_BYTES / size_of::<f32>();
        // One cache line more than needed, so that the rows do not all map to the same cache sets.
        let stride = columns.next_multiple_of(LINE) + LINE;
        let values = vec![0.0; TILE_PLANES * 2 * rows * stride + LINE];
        let origin = values.as_ptr().align_offset(LINE_BYTES).min(LINE);
        Self { values, origin, stride, rows }
    }

    fn start(&self, plane: usize, part: Part, row: usize) -> usize {
        self.origin + ((plane * 2 + part as usize) * self.rows + row) * self.stride
    }

    /// The first `columns` values of a row.
    pub fn row(&self, plane: usize, part: Part, row: usize, columns: usize) -> &[f32] {
        let start = self.start(plane, part, row);
        &self.values[start..start + columns]
    }

    /// The same, to be written.
    pub fn row_mut(&mut self, plane: usize, part: Part, row: usize, columns: usize) -> &mut [f32] {
        let start = self.start(plane, part, row);
        &mut self.values[start..start + columns]
    }

    /// One row of all planes: `[sums, differences]`.
    fn planes_mut(&mut self, row: usize, columns: usize) -> [[&mut [f32]; TILE_PLANES]; 2] {
        let from = row * self.stride;
        let mut parts = self.values[self.origin..]
            .chunks_exact_mut(self.rows * self.stride)
            .map(|part| &mut part[from..from + columns]);
        let mut next = || parts.next().unwrap_or_default();
        let [[r, rd], [g, gd], [b, bd]]: [[&mut [f32]; 2]; TILE_PLANES] =
            std::array::from_fn(|_| [next(), next()]);
        [[r, g, b], [rd, gd, bd]]
    }
}

impl<'a> PairSignal<'a> {
    /// Combines two frames to a pair.
    ///
    /// # Panics
    /// When their sizes differ: callers must check this first.
    pub fn new(reference: &'a Frame, test: &'a Frame, tables: &'a SignalTables) -> Self {
        let (width, height) = (reference.width(), reference.height());
        assert_eq!((width, height), (test.width(), test.height()), "frames of one size");
        let exact = tables.codes_are_signal(reference) && tables.codes_are_signal(test);
        let both_eight_bit =
            [reference, test].iter().all(|f| matches!(f.samples(), crate::frame::Samples::U8(_)));
        let peak = match (exact, both_eight_bit) {
            (true, true) => 255.0,
            (true, false) => 65535.0,
            (false, _) => 1.0,
        };
        let side = |frame: &'a Frame| {
            let codes = if exact { SignalTables::codes(frame, peak) } else { None };
            Side::new(frame, codes.unwrap_or_else(|| tables.unit(frame)))
        };
        let gray = [reference, test].iter().all(|f| f.channels() == Channels::Gray);
        let luma = tables.params().channels == SignalChannels::Luma;
        Self {
            reference: side(reference),
            test: side(test),
            width,
            height,
            // Three equal channels have the same score as one.
            planes: if gray || luma { 1 } else { 3 },
            luma: luma && !gray,
            peak,
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The number of planes of the signal, 1 or 3.
    pub fn planes(&self) -> usize {
        self.planes
    }

    /// The largest value of the signal: 1, or the largest integer code that both frames can hold.
    pub fn peak(&self) -> f32 {
        self.peak
    }

    /// Whether sums and differences are whole numbers from -255 to 255.
    pub fn is_eight_bit(&self) -> bool {
        self.peak <= 255.0 && self.peak > 1.0 && !self.luma
    }

    /// Reads the columns `xs` of row `y` into row `row` of a tile.
    pub fn fill(&self, y: usize, xs: Range<usize>, tile: &mut PairTile, row: usize) {
        let read = if self.luma { TILE_PLANES } else { self.planes };
        let [mut sums, mut differences] = tile.planes_mut(row, xs.len());
        self.reference.fill(y, xs.clone(), &mut sums[..read]);
        self.test.fill(y, xs, &mut differences[..read]);
        for (sum, difference) in sums.iter_mut().zip(&mut differences).take(read) {
            combine(sum, difference, self.peak);
        }
        if self.luma {
            // Luma is computed from sum and difference rather than from the pictures, so that a
            // small exact difference keeps its precision.
            weighted_sum(sums);
            weighted_sum(differences);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn combine(a: &mut [f32], b: &mut [f32], peak: f32) {
    for (a, b) in a.iter_mut().zip(b) {
        (*a, *b) = (*a + *b - peak, *a - *b);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn weighted_sum(planes: [&mut [f32]; TILE_PLANES]) {
    let [wr, wg, wb] = Luma::WEIGHTS;
    let [r, g, b] = planes;
    for ((r, g), b) in r.iter_mut().zip(g).zip(b) {
        *r = *r * wr + *g * wg + *b * wb;
    }
}
