//! One picture, alone or as part of a pair: its samples, converted to the signal in stretches of
//! rows.

use std::ops::Range;

use half::f16;
use multiversion::multiversion;

use crate::codes::within_unit;
use crate::conversion::Conversion;
use crate::frame::{Channels, Frame};

/// A frame with the conversion of its samples.
#[derive(Debug)]
pub(crate) struct Side<'a> {
    frame: &'a Frame,
    conversion: Conversion<'a>,
}

impl<'a> Side<'a> {
    pub(crate) fn new(frame: &'a Frame, conversion: Conversion<'a>) -> Self {
        Self { frame, conversion }
    }
}

impl Side<'_> {
    /// Reads a stretch of a row into one plane, or into three.
    pub(crate) fn fill(&self, y: usize, xs: Range<usize>, planes: &mut [&mut [f32]]) {
        let from = self.frame.row_start(y) + xs.start;
        let pixels = from..from + xs.len();
        let colour = self.frame.channels() == Channels::Rgb;
        let channels = if colour { 3 } else { 1 };
        let interleaved = pixels.start * channels..pixels.end * channels;
        match self.conversion {
            Conversion::Codes8(s, scale) => codes8(&s[interleaved], planes, scale),
            Conversion::Codes16(s, scale) => codes16(&s[interleaved], planes, scale),
            Conversion::Table8(s, table) => {
                take_apart(&s[interleaved], planes, |c| table[usize::from(c)]);
            }
            Conversion::Table16(s, table) => {
                take_apart(&s[interleaved], planes, |c| table[usize::from(c)]);
            }
            Conversion::Half(s, table) => {
                self.floats(s, pixels, planes, |v: f16| table[usize::from(v.to_bits())]);
            }
            Conversion::Linear(s, to_signal) => {
                self.floats(s, pixels, planes, |v| to_signal.map(v));
            }
            Conversion::Encoded(s) => self.floats(s, pixels, planes, within_unit),
            Conversion::Curve(s, curve) => self.floats(s, pixels, planes, |v| curve.at(v)),
            Conversion::ToneMapped(s, to_signal, curve) => {
                self.floats(s, pixels, planes, |v| curve.at(to_signal.map(v)));
            }
            Conversion::Absolute(s, range) => {
                self.floats(s, pixels, planes, |v| range.displayed(v));
            }
        }
        if !colour && let [gray, others @ ..] = planes {
            for other in others {
                other.copy_from_slice(gray);
            }
        }
    }
}

impl Side<'_> {
    /// Converts the floats of some pixels of a row.
    #[inline(always)]
    fn floats<T: Copy>(
        &self,
        samples: &[T],
        pixels: Range<usize>,
        planes: &mut [&mut [f32]],
        of: impl Fn(T) -> f32,
    ) {
        for (nth, piece) in self.frame.pieces(pixels.start, pixels.len()).enumerate() {
            if self.frame.is_interleaved() {
                take_apart(&samples[piece], planes, &of);
            } else {
                each(&samples[piece], planes[nth], &of);
            }
        }
    }

    /// Reads a whole row, the channels of a pixel side by side.
    pub(crate) fn fill_interleaved(&self, y: usize, out: &mut [f32]) {
        let channels = self.frame.channels().count();
        let start = self.frame.row_start(y) * channels;
        let row = start..start + out.len();
        match self.conversion {
            Conversion::Codes8(s, scale) => each(&s[row], out, |c| f32::from(c) * scale),
            Conversion::Codes16(s, scale) => each(&s[row], out, |c| f32::from(c) * scale),
            Conversion::Table8(s, table) => each(&s[row], out, |c| table[usize::from(c)]),
            Conversion::Table16(s, table) => each(&s[row], out, |c| table[usize::from(c)]),
            // Floats may be in planes: each channel for itself first.
            _ => {
                let width = self.frame.width();
                let mut values = vec![0.0; out.len()];
                let mut planes: Vec<&mut [f32]> = values.chunks_exact_mut(width).collect();
                self.fill(y, 0..width, &mut planes);
                for (c, plane) in values.chunks_exact(width).enumerate() {
                    for (out, value) in out[c..].iter_mut().step_by(channels).zip(plane) {
                        *out = *value;
                    }
                }
            }
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn codes8(codes: &[u8], planes: &mut [&mut [f32]], scale: f32) {
    take_apart(codes, planes, |c| f32::from(c) * scale);
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn codes16(codes: &[u16], planes: &mut [&mut [f32]], scale: f32) {
    take_apart(codes, planes, |c| f32::from(c) * scale);
}

#[inline(always)]
fn each<T: Copy>(values: &[T], out: &mut [f32], of: impl Fn(T) -> f32) {
    for (out, &value) in out.iter_mut().zip(values) {
        *out = of(value);
    }
}

/// Separates interleaved codes: either one code per pixel into the first plane (gray), or three
/// codes per pixel into three planes.
#[inline(always)]
fn take_apart<T: Copy>(codes: &[T], planes: &mut [&mut [f32]], value: impl Fn(T) -> f32) {
    if let [r, g, b] = planes
        && codes.len() > r.len()
    {
        let n = r.len();
        let (g, b) = (&mut g[..n], &mut b[..n]);
        let codes = &codes.as_chunks::<3>().0[..n];
        for x in 0..n {
            r[x] = value(codes[x][0]);
            g[x] = value(codes[x][1]);
            b[x] = value(codes[x][2]);
        }
    } else {
        for (out, &code) in planes[0].iter_mut().zip(codes) {
            *out = value(code);
        }
    }
}

#[cfg(test)]
mod tests {
    use half::f16;

    use crate::display_range::DisplayRange;
    use crate::frame::{Channels, Crop, Frame, Samples};
    use crate::frame_signal::FrameSignal;
    use crate::luma::{LumaKind, LumaScratch, LumaSignal};
    use crate::luminance::{LinearInput, LuminanceScratch, LuminanceTables};
    use crate::signal::SignalTables;
    use crate::signal_params::{SignalParams, Transfer};

    const SIZE: (usize, usize) = (9, 4);
    const CROP: Crop = Crop { x: 2, y: 1, width: 6, height: 2 };

    /// The second visible row, as each reader reads it.
    fn rows(frame: &Frame, transfer: Option<Transfer>) -> Vec<Vec<f64>> {
        let params = SignalParams { transfer, exposure_stops: 0.5, ..SignalParams::default() };
        let tables = SignalTables::new(params);
        let mut signal = vec![0.0; 3 * CROP.width];
        FrameSignal::new(frame, &tables).fill_row(1, &mut signal);
        let mut rows = vec![signal.iter().copied().map(f64::from).collect()];
        for kind in [LumaKind::Luma, LumaKind::Luminance] {
            let mut row = vec![0.0; CROP.width - 1];
            let mut scratch = LumaScratch::new(CROP.width);
            LumaSignal::new(frame, &tables, kind).fill_row(
                1,
                1..CROP.width,
                &mut scratch,
                &mut row,
            );
            rows.push(row);
        }
        let shown = DisplayRange {
            cd_m2_per_unit: 10.0,
            floor_cd_m2: 0.005,
            peak_cd_m2: 100.0,
            black_cd_m2: 0.5,
        };
        for linear in [LinearInput::ToneMapped, LinearInput::Absolute(shown)] {
            let weights = [0.25, 0.5, 0.25];
            let tables = LuminanceTables::new(params, |v| 100.0 * v * v + 1.0, linear, weights);
            let mut row = vec![0.0; CROP.width - 1];
            let mut scratch = LuminanceScratch::new(CROP.width);
            tables.luminance(frame).fill(1, 1..CROP.width, &mut scratch, &mut row);
            rows.push(row.iter().copied().map(f64::from).collect());
        }
        rows
    }

    /// Floats whose channels are side by side have the same signal as floats in planes, to the bit.
    #[test]
    fn floats_side_by_side_have_the_signal_of_planes() {
        let pixels = SIZE.0 * SIZE.1;
        let planes: Vec<f32> = (0..3 * pixels).map(|i| 0.5 + (i as f32).sin() * 0.6).collect();
        let side_by_side: Vec<f32> =
            (0..3 * pixels).map(|i| planes[i % 3 * pixels + i / 3]).collect();
        let halves = |values: &[f32]| values.iter().copied().map(f16::from_f32).collect();
        let frame = |samples| {
            let frame = Frame::new(SIZE.0, SIZE.1, Channels::Rgb, samples).unwrap();
            frame.cropped(CROP).unwrap()
        };
        for (planes, side_by_side) in [
            (Samples::F16(halves(&planes)), Samples::F16(halves(&side_by_side))),
            (Samples::F32(planes.into()), Samples::F32(side_by_side.into())),
        ] {
            let (planes, pixels) = (frame(planes), frame(side_by_side).interleaved());
            for transfer in [None, Some(Transfer::Srgb), Some(Transfer::Pq)] {
                assert_eq!(rows(&planes, transfer), rows(&pixels, transfer));
            }
        }
    }
}
