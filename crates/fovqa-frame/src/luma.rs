//! A picture as one plane, for profiles of a single picture: its luma, or its luminance.
//!
//! Values are `f64`, because the differences of neighbours that wavelets take are small compared
//! with the values.

use std::ops::Range;

use half::f16;
use multiversion::multiversion;

use crate::frame::{Channels, Frame, Samples};
use crate::side::Side;
use crate::signal::SignalTables;
use crate::signal_params::{Luma, Transfer};
use crate::transfer::{pq, srgb};

/// The number that each pixel is reduced to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LumaKind {
    /// Y = 0.2126 R + 0.7152 G + 0.0722 B of the display-encoded signal, 0 to 1.
    #[default]
    Luma,
    /// The same sum of linear light, after exposure and before the tone map. Encoded input is
    /// decoded: to 0 to 1, or to cd/m² (PQ).
    Luminance,
}

/// A frame, ready to be read row by row as luma or luminance.
#[derive(Debug)]
pub struct LumaSignal<'a> {
    frame: &'a Frame,
    source: LumaSource<'a>,
}

#[derive(Debug)]
enum LumaSource<'a> {
    /// The signal, and the divisor that brings its peak to 1.
    Encoded(Side<'a>, f64),
    Linear(Linear<'a>),
}

/// Samples with their conversion to linear light.
#[derive(Debug)]
enum Linear<'a> {
    Codes8(&'a [u8], Box<[f64]>),
    Codes16(&'a [u16], Box<[f64]>),
    Half(&'a [f16], Decoder),
    Float(&'a [f32], Decoder),
}

/// Converts a value to linear light.
#[derive(Debug, Clone, Copy)]
struct Decoder {
    transfer: Transfer,
    gain: f64,
}

impl Decoder {
    fn decode(self, value: f64) -> f64 {
        let clamped = value.clamp(0.0, 1.0);
        match self.transfer {
            Transfer::Linear => value * self.gain,
            Transfer::Srgb => srgb::decode(clamped),
            Transfer::Pq => pq::decode(clamped),
            Transfer::Gamma22 => libm::pow(clamped, 2.2),
        }
    }

    fn table(self, codes: usize) -> Box<[f64]> {
        (0..codes).map(|code| self.decode(code as f64 / (codes - 1) as f64)).collect()
    }
}

/// A buffer for the channels of a stretch of a row.
#[derive(Debug, Clone)]
pub struct LumaScratch([Vec<f32>; 3]);

impl LumaScratch {
    /// A buffer for up to `columns` pixels.
    pub fn new(columns: usize) -> Self {
        Self(std::array::from_fn(|_| vec![0.0; columns]))
    }
}

impl<'a> LumaSignal<'a> {
    /// Reads a frame as luma or luminance.
    pub fn new(frame: &'a Frame, tables: &'a SignalTables, kind: LumaKind) -> Self {
        let source = match kind {
            LumaKind::Luma => {
                let peak = match frame.samples() {
                    Samples::U8(_) => 255.0,
                    _ => 65535.0,
                };
                let exact = tables.codes_are_signal(frame);
                match SignalTables::codes(frame, peak).filter(|_| exact) {
                    Some(codes) => LumaSource::Encoded(Side::new(frame, codes), f64::from(peak)),
                    None => LumaSource::Encoded(Side::new(frame, tables.unit(frame)), 1.0),
                }
            }
            LumaKind::Luminance => LumaSource::Linear(linear(frame, tables)),
        };
        Self { frame, source }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.frame.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.frame.height()
    }

    /// Reads the columns `xs` of row `y`. In luma, NaN becomes 0 and infinity 1; luminance keeps
    /// them.
    pub fn fill_row(&self, y: usize, xs: Range<usize>, scratch: &mut LumaScratch, out: &mut [f64]) {
        let columns = xs.len();
        let out = &mut out[..columns];
        match &self.source {
            LumaSource::Encoded(side, peak) => {
                let mut planes = scratch.0.each_mut().map(|plane| &mut plane[..columns]);
                if self.frame.channels() == Channels::Gray {
                    side.fill(y, xs, &mut planes[..1]);
                    scale(planes[0], 1.0 / peak, out);
                } else {
                    side.fill(y, xs, &mut planes);
                    weigh(planes, WEIGHTS.map(|w| w / peak), out);
                }
            }
            LumaSource::Linear(linear) => self.linear_row(linear, y, xs, out),
        }
    }

    fn linear_row(&self, linear: &Linear<'_>, y: usize, xs: Range<usize>, out: &mut [f64]) {
        let first = self.frame.row_start(y) + xs.start;
        for (x, out) in out.iter_mut().enumerate() {
            let index = |c: usize| self.frame.index(c, first + x);
            let light = |c: usize| match linear {
                Linear::Codes8(s, table) => table[usize::from(s[index(c)])],
                Linear::Codes16(s, table) => table[usize::from(s[index(c)])],
                Linear::Half(s, decoder) => decoder.decode(s[index(c)].to_f64()),
                Linear::Float(s, decoder) => decoder.decode(f64::from(s[index(c)])),
            };
            *out = match self.frame.channels() {
                Channels::Gray => light(0),
                Channels::Rgb => {
                    WEIGHTS[0] * light(0) + WEIGHTS[1] * light(1) + WEIGHTS[2] * light(2)
                }
            };
        }
    }
}

/// [`Luma::WEIGHTS`] in `f64`, with the digits of the standard.
const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];
const _: () =
    assert!(WEIGHTS[0] as f32 == Luma::WEIGHTS[0] && WEIGHTS[2] as f32 == Luma::WEIGHTS[2]);

fn linear<'a>(frame: &'a Frame, tables: &SignalTables) -> Linear<'a> {
    let params = tables.params();
    let decoder =
        Decoder { transfer: params.transfer_of(frame), gain: libm::exp2(params.exposure_stops) };
    match frame.samples() {
        Samples::U8(s) => Linear::Codes8(s, decoder.table(1 << 8)),
        Samples::U16(s) => Linear::Codes16(s, decoder.table(1 << 16)),
        Samples::F16(s) => Linear::Half(s, decoder),
        Samples::F32(s) => Linear::Float(s, decoder),
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn scale(values: &[f32], by: f64, out: &mut [f64]) {
    for (out, &value) in out.iter_mut().zip(values) {
        *out = f64::from(value) * by;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn weigh(planes: [&mut [f32]; 3], weights: [f64; 3], out: &mut [f64]) {
    let [r, g, b] = planes;
    let [wr, wg, wb] = weights;
    for (((out, &r), &g), &b) in out.iter_mut().zip(&*r).zip(&*g).zip(&*b) {
        *out = f64::from(r) * wr + f64::from(g) * wg + f64::from(b) * wb;
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;
    use crate::frame::Crop;
    use crate::signal_params::SignalParams;

    fn read(frame: &Frame, params: SignalParams, kind: LumaKind) -> Vec<Vec<f64>> {
        let tables = SignalTables::new(params);
        let signal = LumaSignal::new(frame, &tables, kind);
        let mut scratch = LumaScratch::new(frame.width());
        let rows = (0..frame.height()).map(|y| {
            let mut row = vec![0.0; frame.width()];
            // The row is read in two stretches, as tiles read it.
            let middle = frame.width() / 2;
            signal.fill_row(y, 0..middle, &mut scratch, &mut row[..middle]);
            signal.fill_row(y, middle..frame.width(), &mut scratch, &mut row[middle..]);
            row
        });
        rows.collect()
    }

    fn near(got: f64, want: f64) {
        assert!((got - want).abs() <= 1e-12 * want.abs().max(1.0), "{got} for {want}");
    }

    #[test]
    fn luma_of_codes_is_that_of_the_encoded_signal() {
        let codes: Vec<u8> = (0..5 * 3 * 3).map(|i| (i * 37 % 256) as u8).collect();
        let frame = Frame::new(5, 3, Channels::Rgb, Samples::U8(codes.clone().into())).unwrap();
        let luma = |x: usize, y: usize| {
            let code = |c: usize| f64::from(codes[(y * 5 + x) * 3 + c]) / 255.0;
            0.2126 * code(0) + 0.7152 * code(1) + 0.0722 * code(2)
        };
        let rows = read(&frame, SignalParams::default(), LumaKind::Luma);
        for (y, row) in rows.iter().enumerate() {
            for (x, value) in row.iter().enumerate() {
                near(*value, luma(x, y));
            }
        }
        let cut = frame.cropped(Crop { x: 2, y: 1, width: 3, height: 2 }).unwrap();
        let rows = read(&cut, SignalParams::default(), LumaKind::Luma);
        near(rows[1][2], luma(4, 2));
        let gray =
            Frame::new(2, 1, Channels::Gray, Samples::U16(vec![65535, 13107].into())).unwrap();
        let rows = read(&gray, SignalParams::default(), LumaKind::Luma);
        assert_eq!(rows[0], [1.0, 0.2]);
    }

    #[test]
    fn luminance_is_linear_after_exposure_and_before_the_tone_map() {
        let values = vec![2.0f32, -0.5, 0.25, 0.5, 4.0, 1.0];
        let frame = Frame::new(2, 1, Channels::Rgb, Samples::F32(values.into())).unwrap();
        let params = SignalParams { exposure_stops: 1.0, ..SignalParams::default() };
        let rows = read(&frame, params, LumaKind::Luminance);
        near(rows[0][0], 2.0 * (0.2126 * 2.0 + 0.7152 * 0.25 + 0.0722 * 4.0));
        near(rows[0][1], 2.0 * (0.2126 * -0.5 + 0.7152 * 0.5 + 0.0722 * 1.0));
        let codes = Frame::new(2, 1, Channels::Gray, Samples::U8(vec![128, 255].into())).unwrap();
        let of = |transfer| {
            let params = SignalParams { transfer, exposure_stops: 3.0, ..SignalParams::default() };
            read(&codes, params, LumaKind::Luminance)[0].clone()
        };
        let code = 128.0 / 255.0;
        near(of(None)[0], srgb::decode(code));
        near(of(Some(Transfer::Gamma22))[0], libm::pow(code, 2.2));
        near(of(Some(Transfer::Pq))[1], 10_000.0);
        near(of(Some(Transfer::Linear))[0], code * 8.0);
    }

    #[test]
    fn a_half_float_gives_the_luma_that_is_scored() {
        let half: Vec<f16> = [0.25f32, 0.5, 1.5, f32::NAN].map(f16::from_f32).to_vec();
        let frame = Frame::new(4, 1, Channels::Gray, Samples::F16(half.into())).unwrap();
        let rows = read(&frame, SignalParams::default(), LumaKind::Luma);
        assert!((rows[0][0] - srgb::encode(0.25)).abs() < 1e-7);
        assert_eq!(rows[0][2..], [1.0, 0.0]);
    }
}
