//! Converts samples to the luminance that a display shows.
//!
//! Encoded samples go through the display's curve. Linear samples are either scene values, which
//! are exposed, tone-mapped and encoded before the display shows them, or absolute luminance, which
//! the display shows within its range. NaN becomes the darkest possible luminance.

use std::ops::Range;
use std::sync::OnceLock;

use half::f16;
use multiversion::multiversion;

use crate::blocks::map_row_blocks;
use crate::codes::{CODES_8, CODES_16, table};
use crate::conversion::{Conversion, FloatToSignal};
use crate::display_range::{Curve, DisplayRange};
use crate::frame::{Channels, Frame, Samples};
use crate::side::Side;
use crate::signal_params::{SignalParams, Transfer};

/// How a display shows linear samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LinearInput {
    /// Exposure, tone map and sRGB encoding, then the display's curve.
    ToneMapped,
    /// The samples are absolute luminance, clipped to the range of the display.
    Absolute(DisplayRange),
}

/// Converts an encoded value in `[0, 1]` to cd/m².
type Emitted = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// The conversion from samples to luminance, tabulated once where samples have few possible values.
pub struct LuminanceTables {
    signal: SignalParams,
    emitted: Emitted,
    linear: LinearInput,
    /// The weights of red, green and blue in the luminance.
    weights: [f32; 3],
    curve: OnceLock<Box<[f32; CODES_16]>>,
    codes8: OnceLock<Box<[f32; CODES_8]>>,
    codes16: OnceLock<Box<[f32; CODES_16]>>,
    half: OnceLock<Box<[f32; CODES_16]>>,
}

impl std::fmt::Debug for LuminanceTables {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { signal, linear, weights, .. } = self;
        let mut shown = f.debug_struct("LuminanceTables");
        shown.field("signal", signal).field("linear", linear).field("weights", weights);
        shown.finish_non_exhaustive()
    }
}

impl LuminanceTables {
    /// Tables for a display that emits `emitted(v)` cd/m² for an encoded value v in `[0, 1]`. The
    /// luminance is the sum of the emitted red, green and blue, weighted by `weights`. The emitted
    /// value of a gray picture is its luminance already.
    pub fn new(
        signal: SignalParams,
        emitted: impl Fn(f64) -> f64 + Send + Sync + 'static,
        linear: LinearInput,
        weights: [f64; 3],
    ) -> Self {
        Self {
            signal,
            emitted: Box::new(emitted),
            linear,
            weights: weights.map(|weight| weight as f32),
            curve: OnceLock::new(),
            codes8: OnceLock::new(),
            codes16: OnceLock::new(),
            half: OnceLock::new(),
        }
    }

    /// A frame, ready to be read as luminance.
    pub fn luminance<'a>(&'a self, frame: &'a Frame) -> LuminanceSignal<'a> {
        LuminanceSignal { frame, side: Side::new(frame, self.source(frame)), weights: self.weights }
    }

    /// Whether the samples of a frame are absolute luminance.
    pub fn is_absolute(&self, frame: &Frame) -> bool {
        self.signal.transfer_of(frame) == Transfer::Linear && self.linear != LinearInput::ToneMapped
    }

    fn curve(&self) -> Curve<'_> {
        let value = |code: usize| (self.emitted)(code as f64 / (CODES_16 - 1) as f64) as f32;
        Curve(self.curve.get_or_init(|| table(value)))
    }

    /// Exposure, tone map and encoding.
    fn to_signal(&self) -> FloatToSignal {
        FloatToSignal::new(&self.signal)
    }

    /// The emitted luminance of a linear value.
    fn of_linear(&self, value: f32) -> f32 {
        match self.linear {
            LinearInput::Absolute(range) => range.displayed(value),
            LinearInput::ToneMapped => self.curve().at(self.to_signal().map(value)),
        }
    }

    fn source<'a>(&'a self, frame: &'a Frame) -> Conversion<'a> {
        let linear = self.signal.transfer_of(frame) == Transfer::Linear;
        let of_code = |code: usize, codes: usize| {
            let value = code as f64 / (codes - 1) as f64;
            if linear { self.of_linear(value as f32) } else { (self.emitted)(value) as f32 }
        };
        match frame.samples() {
            Samples::U8(s) => {
                let table = self.codes8.get_or_init(|| table(|code| of_code(code, CODES_8)));
                Conversion::Table8(s, table)
            }
            Samples::U16(s) => {
                let table = self.codes16.get_or_init(|| table(|code| of_code(code, CODES_16)));
                Conversion::Table16(s, table)
            }
            Samples::F16(s) => {
                let value = |bits: usize| {
                    let value = f16::from_bits(bits as u16).to_f32();
                    if linear { self.of_linear(value) } else { self.curve().at(value) }
                };
                Conversion::Half(s, self.half.get_or_init(|| table(value)))
            }
            Samples::F32(s) => match self.linear {
                _ if !linear => Conversion::Curve(s, self.curve()),
                LinearInput::ToneMapped => {
                    Conversion::ToneMapped(s, self.to_signal(), self.curve())
                }
                LinearInput::Absolute(range) => Conversion::Absolute(s, range),
            },
        }
    }
}

/// A buffer for the channels of a row.
#[derive(Debug, Clone)]
pub struct LuminanceScratch([Vec<f32>; 3]);

impl LuminanceScratch {
    /// A buffer for up to `columns` pixels.
    pub fn new(columns: usize) -> Self {
        Self(std::array::from_fn(|_| vec![0.0; columns]))
    }
}

/// A frame that is read row by row as luminance in cd/m².
#[derive(Debug)]
pub struct LuminanceSignal<'a> {
    frame: &'a Frame,
    side: Side<'a>,
    weights: [f32; 3],
}

impl LuminanceSignal<'_> {
    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.frame.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.frame.height()
    }

    /// The brightest pixel, cd/m².
    pub fn brightest(&self) -> f32 {
        let blocks = map_row_blocks(self.height(), |rows| {
            let mut scratch = LuminanceScratch::new(self.width());
            let mut row = vec![0.0; self.width()];
            let of_row = |y: usize| {
                self.fill(y, 0..self.width(), &mut scratch, &mut row);
                row.iter().copied().fold(f32::MIN, f32::max)
            };
            rows.map(of_row).fold(f32::MIN, f32::max)
        });
        blocks.into_iter().fold(f32::MIN, f32::max)
    }

    /// Reads the columns `xs` of row `y`.
    pub fn fill(
        &self,
        y: usize,
        xs: Range<usize>,
        scratch: &mut LuminanceScratch,
        out: &mut [f32],
    ) {
        let n = xs.len();
        if self.frame.channels() == Channels::Gray {
            self.side.fill(y, xs, &mut [&mut out[..n]]);
            return;
        }
        let [r, g, b] = scratch.0.each_mut().map(|plane| &mut plane[..n]);
        self.side.fill(y, xs, &mut [&mut *r, &mut *g, &mut *b]);
        weigh([r, g, b], self.weights, &mut out[..n]);
    }

    /// Reads the columns `xs` of row `y` as red, green and blue, without their weights.
    pub(crate) fn fill_channels(&self, y: usize, xs: Range<usize>, [r, g, b]: [&mut [f32]; 3]) {
        self.side.fill(y, xs, &mut [r, g, b]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn weigh([r, g, b]: [&mut [f32]; 3], [wr, wg, wb]: [f32; 3], out: &mut [f32]) {
    for (((out, r), g), b) in out.iter_mut().zip(r).zip(g).zip(b) {
        *out = *r * wr + *g * wg + *b * wb;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tonemap::ToneMap;

    const WEIGHTS: [f64; 3] = [0.25, 0.5, 0.25];
    const SHOWN: DisplayRange = DisplayRange {
        cd_m2_per_unit: 10.0,
        floor_cd_m2: 0.005,
        peak_cd_m2: 100.0,
        black_cd_m2: 0.5,
    };

    fn read(tables: &LuminanceTables, frame: &Frame) -> Vec<f32> {
        let signal = tables.luminance(frame);
        let mut row = vec![0.0; signal.width()];
        signal.fill(0, 0..signal.width(), &mut LuminanceScratch::new(signal.width()), &mut row);
        row
    }

    fn frame(channels: Channels, width: usize, samples: Samples) -> Frame {
        Frame::new(width, 1, channels, samples).unwrap()
    }

    fn tables(signal: SignalParams, linear: LinearInput) -> LuminanceTables {
        LuminanceTables::new(signal, |v| 100.0 * v * v + 1.0, linear, WEIGHTS)
    }

    #[test]
    fn the_brightest_pixel_is_found_in_any_row() {
        let tables = tables(SignalParams::default(), LinearInput::Absolute(SHOWN));
        for brightest in [0, 7, 150] {
            let values = (0..2 * 151).map(|at| if at / 2 == brightest { 9.0 } else { 1.0 });
            let samples = Samples::F32(values.collect());
            let frame = Frame::new(2, 151, Channels::Gray, samples).unwrap();
            near(&[tables.luminance(&frame).brightest()], &[90.5]);
        }
    }

    fn near(found: &[f32], wanted: &[f64]) {
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().zip(wanted) {
            let error = (f64::from(*found) - wanted).abs();
            assert!(error <= 1e-6 * wanted.abs(), "{found} for {wanted}");
        }
    }

    #[test]
    fn codes_go_through_the_curve_and_gray_is_not_weighted() {
        let tables = tables(SignalParams::default(), LinearInput::ToneMapped);
        let light = |v: f64| 100.0 * v * v + 1.0;
        let colour = frame(Channels::Rgb, 1, Samples::U8(vec![255, 51, 0].into()));
        near(&read(&tables, &colour), &[0.25 * 101.0 + 0.5 * light(0.2) + 0.25]);
        let gray = frame(Channels::Gray, 2, Samples::U16(vec![13107, 65535].into()));
        near(&read(&tables, &gray), &[light(0.2), 101.0]);
    }

    #[test]
    fn encoded_floats_are_kept_in_range() {
        let signal = SignalParams { transfer: Some(Transfer::Srgb), ..SignalParams::default() };
        let tables = tables(signal, LinearInput::Absolute(SHOWN));
        let values = vec![-1.0, 0.0, 0.123_456, 1.0, 7.0, f32::NAN];
        let wanted = [1.0, 1.0, 100.0 * 0.123_456 * 0.123_456 + 1.0, 101.0, 101.0, 1.0];
        let floats = frame(Channels::Gray, 6, Samples::F32(values.clone().into()));
        near(&read(&tables, &floats), &wanted);
        assert!(!tables.is_absolute(&floats));
        let halves = values.iter().map(|v| f16::from_f32(*v)).collect();
        let found = read(&tables, &frame(Channels::Gray, 6, Samples::F16(halves)));
        near(&[found[0], found[3], found[4], found[5]], &[1.0, 101.0, 101.0, 1.0]);
    }

    #[test]
    fn absolute_luminance_is_clipped_before_black_is_added() {
        let tables = tables(SignalParams::default(), LinearInput::Absolute(SHOWN));
        let values = vec![0.0, 0.001, 2.0, 50.0, f32::NAN, -3.0];
        let wanted = [0.505, 0.51, 20.5, 100.5, 0.505, 0.505];
        let floats = frame(Channels::Gray, 6, Samples::F32(values.clone().into()));
        assert!(tables.is_absolute(&floats));
        near(&read(&tables, &floats), &wanted);
        let halves = values.iter().map(|v| f16::from_f32(*v)).collect();
        let found = read(&tables, &frame(Channels::Gray, 6, Samples::F16(halves)));
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((f64::from(*found) - wanted).abs() < 1e-5, "{found} for {wanted}");
        }
        let signal = SignalParams { transfer: Some(Transfer::Linear), ..SignalParams::default() };
        let tables = super::tests::tables(signal, LinearInput::Absolute(SHOWN));
        near(&read(&tables, &frame(Channels::Gray, 1, Samples::U8(vec![51].into()))), &[2.5]);
    }

    #[test]
    fn a_scene_is_tone_mapped_before_it_is_shown() {
        let signal = SignalParams {
            exposure_stops: 1.0,
            tonemap: ToneMap::Reinhard,
            ..SignalParams::default()
        };
        let tables = LuminanceTables::new(
            signal,
            |v| 50.0 * crate::transfer::srgb::decode(v),
            LinearInput::ToneMapped,
            WEIGHTS,
        );
        let values = vec![0.5, 0.02, 1.5];
        let wanted = values.iter().map(|v: &f32| {
            let exposed = 2.0 * f64::from(*v);
            50.0 * exposed / (1.0 + exposed)
        });
        let wanted: Vec<f64> = wanted.collect();
        near(&read(&tables, &frame(Channels::Gray, 3, Samples::F32(values.into()))), &wanted);
    }
}
