//! Reference and test side by side, as their sum and their difference.
//!
//! Metrics of fidelity need nothing else: the squared error is the difference squared, and SSIM's
//! moments follow from those of sum and difference (`2 ab = ((a+b)² - (a-b)²) / 2`). It keeps
//! equal pictures equal to the last bit, and integer codes exact.

use std::ops::Range;

use multiversion::multiversion;

use crate::frame::{Channels, Frame};
use crate::signal::{Luma, SignalChannels, SignalTables, Source};

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

#[derive(Debug)]
struct Side<'a> {
    frame: &'a Frame,
    source: Source<'a>,
}

/// A stretch of one row: for each plane the centred sum `a + b - peak` and the difference
/// `a - b`.
#[derive(Debug, Clone)]
pub struct PairTile {
    sum: [Vec<f32>; 3],
    difference: [Vec<f32>; 3],
}

impl PairTile {
    /// Room for stretches of up to `width` pixels.
    pub fn new(width: usize) -> Self {
        let planes = || std::array::from_fn(|_| vec![0.0; width]);
        Self { sum: planes(), difference: planes() }
    }

    /// Centred sum and difference of one plane.
    pub fn plane(&self, plane: usize) -> (&[f32], &[f32]) {
        (&self.sum[plane], &self.difference[plane])
    }

    /// The same, to be written.
    pub fn plane_mut(&mut self, plane: usize) -> (&mut [f32], &mut [f32]) {
        (&mut self.sum[plane], &mut self.difference[plane])
    }
}

impl<'a> PairSignal<'a> {
    /// Puts two frames side by side.
    ///
    /// # Panics
    /// When their sizes differ: whoever pairs frames has to have said so before.
    pub fn new(reference: &'a Frame, test: &'a Frame, tables: &'a SignalTables) -> Self {
        let (width, height) = (reference.width(), reference.height());
        assert_eq!((width, height), (test.width(), test.height()), "frames of one size");
        let exact = tables.codes_are_signal(reference) && tables.codes_are_signal(test);
        let both_eight_bit = [reference, test]
            .iter()
            .all(|f| matches!(f.samples(), crate::frame::Samples::U8(_)));
        let peak = match (exact, both_eight_bit) {
            (true, true) => 255.0,
            (true, false) => 65535.0,
            (false, _) => 1.0,
        };
        let side = |frame: &'a Frame| {
            let codes = if exact { SignalTables::codes(frame, peak) } else { None };
            Side { frame, source: codes.unwrap_or_else(|| tables.unit(frame)) }
        };
        let gray = [reference, test].iter().all(|f| f.channels() == Channels::Gray);
        let luma = tables.params().channels == SignalChannels::Luma;
        Self {
            reference: side(reference),
            test: side(test),
            width,
            height,
            // Three equal channels score as one.
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

    /// Planes of the signal: 1 or 3.
    pub fn planes(&self) -> usize {
        self.planes
    }

    /// The signal's largest value: 1, or that of the integer codes both frames hold.
    pub fn peak(&self) -> f32 {
        self.peak
    }

    /// Reads the columns `xs` of row `y`.
    pub fn fill(&self, y: usize, xs: Range<usize>, tile: &mut PairTile) {
        let read = if self.luma { 3 } else { self.planes };
        self.reference.fill(y, xs.clone(), &mut tile.sum[..read]);
        self.test.fill(y, xs.clone(), &mut tile.difference[..read]);
        for (sum, difference) in tile.sum.iter_mut().zip(&mut tile.difference).take(read) {
            combine(&mut sum[..xs.len()], &mut difference[..xs.len()], self.peak);
        }
        if self.luma {
            // Of sum and difference rather than of the pictures: an exact difference stays small.
            weigh(&mut tile.sum, xs.len());
            weigh(&mut tile.difference, xs.len());
        }
    }
}

impl Side<'_> {
    fn fill(&self, y: usize, xs: Range<usize>, planes: &mut [Vec<f32>]) {
        let from = self.frame.row_start(y) + xs.start;
        let pixels = from..from + xs.len();
        let plane = self.frame.plane_len();
        let colour = self.frame.channels() == Channels::Rgb;
        let channels = if colour { 0..3 } else { 0..1 };
        let interleaved = pixels.start * channels.len()..pixels.end * channels.len();
        let planar = |c: usize| c * plane + pixels.start..c * plane + pixels.end;
        match self.source {
            Source::Codes8(s, scale) => {
                interleaved_codes(&s[interleaved], channels.len(), planes, |c| f32::from(c) * scale);
            }
            Source::Codes16(s, scale) => {
                interleaved_codes(&s[interleaved], channels.len(), planes, |c| f32::from(c) * scale);
            }
            Source::Table8(s, table) => {
                interleaved_codes(&s[interleaved], channels.len(), planes, |c| table[usize::from(c)]);
            }
            Source::Table16(s, table) => {
                interleaved_codes(&s[interleaved], channels.len(), planes, |c| table[usize::from(c)]);
            }
            Source::Half(s, table) => {
                for c in channels {
                    for (out, v) in planes[c].iter_mut().zip(&s[planar(c)]) {
                        *out = table[usize::from(v.to_bits())];
                    }
                }
            }
            Source::Linear(s, to_signal) => {
                for c in channels {
                    for (out, &v) in planes[c].iter_mut().zip(&s[planar(c)]) {
                        *out = to_signal.map(v);
                    }
                }
            }
            Source::Encoded(s) => {
                for c in channels {
                    for (out, &v) in planes[c].iter_mut().zip(&s[planar(c)]) {
                        *out = v.max(0.0).min(1.0);
                    }
                }
            }
        }
        if !colour {
            let (gray, others) = planes.split_at_mut(1);
            for other in others {
                other[..xs.len()].copy_from_slice(&gray[0][..xs.len()]);
            }
        }
    }
}

/// Takes interleaved codes apart: one channel into the first plane, or three into three.
fn interleaved_codes<T: Copy>(
    codes: &[T],
    channels: usize,
    planes: &mut [Vec<f32>],
    value: impl Fn(T) -> f32,
) {
    if let (3, [r, g, b]) = (channels, planes.as_mut()) {
        let n = codes.len() / 3;
        let planes = r[..n].iter_mut().zip(&mut g[..n]).zip(&mut b[..n]);
        for (((r, g), b), code) in planes.zip(codes.as_chunks::<3>().0) {
            (*r, *g, *b) = (value(code[0]), value(code[1]), value(code[2]));
        }
    } else {
        for (out, &code) in planes[0].iter_mut().zip(codes) {
            *out = value(code);
        }
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn combine(a: &mut [f32], b: &mut [f32], peak: f32) {
    for (a, b) in a.iter_mut().zip(b) {
        (*a, *b) = (*a + *b - peak, *a - *b);
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn weigh(planes: &mut [Vec<f32>; 3], n: usize) {
    let [wr, wg, wb] = Luma::WEIGHTS;
    let [r, g, b] = planes;
    for ((r, g), b) in r[..n].iter_mut().zip(&g[..n]).zip(&b[..n]) {
        *r = *r * wr + *g * wg + *b * wb;
    }
}
