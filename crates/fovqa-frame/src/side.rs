//! One picture, alone or as part of a pair: its samples, converted to the signal in stretches of
//! rows.

use std::ops::Range;

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
        let plane = self.frame.plane_len();
        let colour = self.frame.channels() == Channels::Rgb;
        let channels = if colour { 0..3 } else { 0..1 };
        let interleaved = pixels.start * channels.len()..pixels.end * channels.len();
        let planar = |c: usize| c * plane + pixels.start..c * plane + pixels.end;
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
                for c in channels {
                    for (out, v) in planes[c].iter_mut().zip(&s[planar(c)]) {
                        *out = table[usize::from(v.to_bits())];
                    }
                }
            }
            Conversion::Linear(s, to_signal) => {
                channels.for_each(|c| each(&s[planar(c)], planes[c], |v| to_signal.map(v)));
            }
            Conversion::Encoded(s) => {
                channels.for_each(|c| each(&s[planar(c)], planes[c], within_unit));
            }
            Conversion::Curve(s, curve) => {
                channels.for_each(|c| each(&s[planar(c)], planes[c], |v| curve.at(v)));
            }
            Conversion::ToneMapped(s, to_signal, curve) => {
                let light = |v| curve.at(to_signal.map(v));
                channels.for_each(|c| each(&s[planar(c)], planes[c], light));
            }
            Conversion::Absolute(s, range) => {
                channels.for_each(|c| each(&s[planar(c)], planes[c], |v| range.displayed(v)));
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
            // Planes: each for itself first.
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
