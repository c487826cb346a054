//! A frame of 8-bit codes, read where samples stand. The same frame as floats would be four times as
//! large, 100 MB at 4K, and writing it would take longer than most methods.

use std::borrow::Cow;
use std::ops::Range;

use fovqa_frame::{Frame, Samples, SignalTables, Transfer};
use multiversion::multiversion;

use crate::fetch::lerp;
use crate::image::Image;
use crate::pixels::Pixels;
use crate::taps::{PLACES, Taps};
use crate::texel::{Texel, narrowed};

/// 1/255 in two parts: the product of a code with the first is exact, so that the sum of both is rounded
/// once, as a division would be.
const UNIT: [f32; 2] = [257.0 / 65536.0, (1.0 / 255.0 - 257.0 / 65536.0) as f32];

/// A code over 255: what `Picture::from_frame` makes of it, to the last bit.
#[inline(always)]
fn unit(code: u8) -> f32 {
    let code = f32::from(code);
    code * UNIT[0] + code * UNIT[1]
}

/// What is read at once. A frame of fewer codes is not worth reading as such.
const BYTES: usize = 8;

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
        let fits = frame.channels().count() == C && codes.len() >= BYTES;
        (whole && are_signal && fits).then_some(Self { width, codes })
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
    fn pair(&self, index: usize, apart: usize) -> [Texel; 2] {
        let bytes = pair::<C>(self.codes, index, apart);
        [0, 4].map(|from| std::array::from_fn(|c| unit(bytes[from + c])))
    }

    fn fetch_all<const L: usize>(&self, xs: &Taps, ys: &Taps, out: &mut [[f32; L]]) {
        let (mut bytes, mut read) = ([[0; 16]; PLACES], [[[0.0; 4]; 4]; PLACES]);
        let (bytes, read) = (&mut bytes[..out.len()], &mut read[..out.len()]);
        read_pairs::<C>(self.codes, self.width, xs, ys, bytes);
        units(bytes.as_flattened(), read.as_flattened_mut().as_flattened_mut());
        for (i, (out, [a, b, c, d])) in out.iter_mut().zip(read).enumerate() {
            let (x, y) = (xs.get(i).t, ys.get(i).t);
            *out = narrowed(lerp(lerp(*a, *b, x), lerp(*c, *d, x), y));
        }
    }

    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]) {
        let row = y * self.width;
        units(&self.codes[(row + xs.start) * C..(row + xs.end) * C], out.as_flattened_mut());
    }

    fn signal(&self) -> Cow<'_, Image<C>> {
        Cow::Owned(Image::by_rows(self.width, self.height(), |y, row| {
            self.read_row(y, 0..self.width, row);
        }))
    }
}

/// The codes of a pixel, and of the one so many behind it: 1 or 0. The fourth code of each is any.
#[inline(always)]
fn pair<const C: usize>(codes: &[u8], index: usize, apart: usize) -> [u8; 8] {
    let at = index * C;
    if C == 1 {
        let [a, b] = [codes[at], codes[at + apart]];
        return [a, a, a, a, b, b, b, b];
    }
    // Eight bytes are one read; near the end of the frame they are the last eight, less those before the
    // pixel.
    let from = at.min(codes.len() - BYTES);
    let bytes = codes[from..].first_chunk().map_or(0, |bytes| u64::from_le_bytes(*bytes));
    let pixel = bytes >> (8 * (at - from));
    let next = pixel >> (8 * C * apart);
    (pixel & u64::from(u32::MAX) | next << 32).to_le_bytes()
}

/// The codes at many taps: the two pixels of the upper row, then those of the lower one. Nothing else is
/// done in between, so that many reads from memory are under way at once.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn read_pairs<const C: usize>(
    codes: &[u8],
    width: usize,
    xs: &Taps,
    ys: &Taps,
    out: &mut [[u8; 16]],
) {
    for (i, out) in out.iter_mut().enumerate() {
        let (x, y) = (xs.get(i), ys.get(i));
        let (halves, _) = out.as_chunks_mut::<8>();
        for (half, row) in halves.iter_mut().zip([y.at, y.next]) {
            let index = row as usize * width + x.at as usize;
            *half = pair::<C>(codes, index, (x.next - x.at) as usize);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn units(codes: &[u8], out: &mut [f32]) {
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
            for apart in [0, 1].into_iter().filter(|apart| index + apart < 6) {
                let pair = frame.pair(index, apart);
                for (texel, index) in pair.into_iter().zip([index, index + apart]) {
                    for c in 0..3 {
                        assert_eq!(texel[c].to_bits(), unit(codes[3 * index + c]).to_bits());
                    }
                }
            }
        }
    }
}
