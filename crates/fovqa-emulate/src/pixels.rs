//! Pictures that samples read: the signal, or a frame's own 8-bit codes, a quarter of the memory.

use std::borrow::Cow;
use std::ops::Range;

use crate::fetch::{Tap, lerp};
use crate::image::Image;
use crate::texel::{Texel, widened};

/// A picture of `C` channels whose pixels can be read one by one, as the signal in `[0, 1]`.
pub(crate) trait Pixels<const C: usize>: Sync {
    /// Width in pixels.
    fn width(&self) -> usize;

    /// Height in pixels.
    fn height(&self) -> usize;

    /// A pixel, by its number in reading order.
    fn texel(&self, index: usize) -> Texel;

    /// The pixels `xs` of row `y`.
    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]);

    /// The whole picture as the signal.
    fn signal(&self) -> Cow<'_, Image<C>>;

    /// The picture at two taps.
    #[inline(always)]
    fn fetch(&self, x: Tap, y: Tap) -> Texel {
        let (upper, lower) = (y.at as usize * self.width(), y.next as usize * self.width());
        let along = |row: usize| {
            lerp(self.texel(row + x.at as usize), self.texel(row + x.next as usize), x.t)
        };
        lerp(along(upper), along(lower), y.t)
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
    fn texel(&self, index: usize) -> Texel {
        widened(self.pixels()[index])
    }

    fn read_row(&self, y: usize, xs: Range<usize>, out: &mut [[f32; C]]) {
        out.copy_from_slice(&self.row(y)[xs]);
    }

    fn signal(&self) -> Cow<'_, Self> {
        Cow::Borrowed(self)
    }
}
