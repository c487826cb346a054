//! A frame of 8-bit codes, read where samples stand: nobody writes 100 MB of floats to read a part of
//! them.

use std::borrow::Cow;
use std::ops::Range;

use fovqa_frame::{Frame, Samples, SignalTables, Transfer};
use multiversion::multiversion;

use crate::image::Image;
use crate::pixels::Pixels;
use crate::texel::Texel;

/// 1/255 in two parts: the product of a code with the first is exact, so that the sum of both is rounded
/// once, as a division would be.
const UNIT: [f32; 2] = [257.0 / 65536.0, (1.0 / 255.0 - 257.0 / 65536.0) as f32];

/// A code over 255: what `Picture::from_frame` makes of it, to the last bit.
#[inline(always)]
fn unit(code: u8) -> f32 {
    let code = f32::from(code);
    code * UNIT[0] + code * UNIT[1]
}

/// The codes of a frame, the channels of a pixel side by side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Codes<'a, const C: usize> {
    width: usize,
    codes: &'a [u8],
}

impl<'a, const C: usize> Codes<'a, C> {
    /// The codes of a frame of so many channels, where they are the signal already and all of them are
    /// visible.
    pub(crate) fn of(frame: &'a Frame, tables: &SignalTables) -> Option<Self> {
        let Samples::U8(codes) = frame.samples() else { return None };
        let width = frame.width();
        let whole = frame.file_size() == (width, frame.height());
        let are_signal = tables.params().transfer_of(frame) != Transfer::Linear;
        (whole && are_signal && frame.channels().count() == C).then_some(Self { width, codes })
    }
}

impl<const C: usize> Pixels<C> for Codes<'_, C> {
    fn width(&self) -> usize {
        self.width
    }

    fn height(&self) -> usize {
        self.codes.len() / C / self.width
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> Texel {
        let at = index * C;
        if C == 1 {
            return [unit(self.codes[at]); 4];
        }
        // Four bytes are one read; the fourth is of the next pixel, and the last pixel has none.
        let four = match self.codes.get(at..at + 4) {
            Some(&[r, g, b, next]) => [r, g, b, next],
            _ => std::array::from_fn(|c| self.codes[at + c.min(C - 1)]),
        };
        four.map(unit)
    }

    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]) {
        let row = y * self.width;
        read(&self.codes[(row + xs.start) * C..(row + xs.end) * C], out.as_flattened_mut());
    }

    fn signal(&self) -> Cow<'_, Image<C>> {
        Cow::Owned(Image::by_rows(self.width, self.height(), |y, row| {
            self.read_row(y, 0..self.width, row);
        }))
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn read(codes: &[u8], out: &mut [f32]) {
    for (out, code) in out.iter_mut().zip(codes) {
        *out = unit(*code);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_divided_exactly() {
        for code in 0..=255u8 {
            assert_eq!(unit(code).to_bits(), (f32::from(code) / 255.0).to_bits(), "{code}");
            assert_eq!(unit(code).to_bits(), ((f64::from(code) / 255.0) as f32).to_bits());
        }
    }

    #[test]
    fn the_last_pixel_needs_no_byte_behind_it() {
        let codes: Vec<u8> = (0..18).collect();
        let frame = Codes::<3> { width: 3, codes: &codes };
        assert_eq!(frame.height(), 2);
        for index in 0..6 {
            let texel = frame.texel(index).map(f32::to_bits);
            for c in 0..3 {
                assert_eq!(texel[c], unit(codes[3 * index + c]).to_bits());
            }
        }
    }
}
