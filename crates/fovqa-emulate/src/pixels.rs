//! Pictures that samples read: the signal, or a frame's own 8-bit codes, a quarter of the memory.

use std::borrow::Cow;
use std::ops::Range;

use crate::fetch::{Tap, lerp};
use crate::image::Image;
use crate::taps::Taps;
use crate::texel::{Texel, narrowed, widened};

/// A picture of `C` channels whose pixels can be read one by one, as the signal in `[0, 1]`.
pub(crate) trait Pixels<const C: usize>: Sync {
    /// Width in pixels.
    fn width(&self) -> usize;

    /// Height in pixels.
    fn height(&self) -> usize;

    /// A pixel, by its number in reading order, and the one so many behind it: 1 or 0.
    fn pair(&self, index: usize, apart: usize) -> [Texel; 2];

    /// The pixels `xs` of row `y`.
    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]);

    /// The whole picture as the signal.
    fn signal(&self) -> Cow<'_, Image<C>>;

    /// The picture at two taps.
    #[inline(always)]
    fn fetch(&self, x: Tap, y: Tap) -> Texel {
        lerp(self.fetch_in_row(y.at, x), self.fetch_in_row(y.next, x), y.t)
    }

    /// A row of the picture at a tap.
    #[inline(always)]
    fn fetch_in_row(&self, row: u32, x: Tap) -> Texel {
        let index = row as usize * self.width() + x.at as usize;
        let [pixel, next] = self.pair(index, (x.next - x.at) as usize);
        lerp(pixel, next, x.t)
    }

    /// The picture at many taps.
    fn fetch_all<const L: usize>(&self, xs: &Taps, ys: &Taps, out: &mut [[f32; L]]) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = narrowed(self.fetch(xs.get(i), ys.get(i)));
        }
    }

    /// The picture at a place in pixels, clamped to its edges.
    #[inline]
    fn at_place(&self, x: f64, y: f64) -> Texel {
        self.fetch(Tap::clamped(x, self.width()), Tap::clamped(y, self.height()))
    }
}

impl<const C: usize> Pixels<C> for Image<C> {
    fn width(&self) -> usize {
        Image::width(self)
    }

    fn height(&self) -> usize {
        Image::height(self)
    }

    #[inline(always)]
    fn pair(&self, index: usize, apart: usize) -> [Texel; 2] {
        let pixels = &self.pixels()[index..=index + apart];
        [widened(pixels[0]), widened(pixels[apart])]
    }

    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]) {
        out.copy_from_slice(&self.row(y)[xs]);
    }

    fn signal(&self) -> Cow<'_, Self> {
        Cow::Borrowed(self)
    }
}
