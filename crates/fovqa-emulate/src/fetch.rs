//! Reading an image between its pixels: bilinear, clamped to its edges, or wrapped around.
//!
//! With a = x - 0.5, i = floor(a), t = a - i the pixels i and i + 1 weigh 1 - t and t; pixel i has its
//! centre at i + 0.5. A coordinate clamped to the outermost centres reads the same as taps that are.

use crate::image::Image;

/// Two neighbours along an axis, and the weight of the second one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tap {
    pub(crate) at: u32,
    pub(crate) next: u32,
    pub(crate) t: f32,
}

impl Tap {
    /// At a coordinate among `n` pixels, clamped to them.
    #[inline]
    pub(crate) fn clamped(coordinate: f64, n: usize) -> Self {
        let last = n as u32 - 1;
        // `max` and `min` rather than `clamp`, which would let a NaN through.
        let a = (coordinate - 0.5).max(0.0).min(f64::from(last));
        let at = a as u32;
        Self { at, next: (at + 1).min(last), t: (a - f64::from(at)) as f32 }
    }
}

/// From one pixel to another: exactly the first where both are equal.
#[inline(always)]
pub(crate) fn lerp<const C: usize>(a: [f32; C], b: [f32; C], t: f32) -> [f32; C] {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * t)
}

/// The mean of 4 x 4 pixels: of equal ones exactly that.
#[inline(always)]
pub(crate) fn mean16<const C: usize>(pixel: impl Fn(usize, usize) -> [f32; C]) -> [f32; C] {
    let sum = |a: [f32; C], b: [f32; C]| std::array::from_fn(|c| a[c] + b[c]);
    let four = |q: usize| sum(sum(pixel(0, q), pixel(1, q)), sum(pixel(2, q), pixel(3, q)));
    sum(sum(four(0), four(1)), sum(four(2), four(3))).map(|total: f32| total * (1.0 / 16.0))
}

impl<const C: usize> Image<C> {
    /// The image at two taps.
    #[inline]
    pub(crate) fn fetch(&self, x: Tap, y: Tap) -> [f32; C] {
        let (upper, lower) = (self.row(y.at as usize), self.row(y.next as usize));
        let along = |row: &[[f32; C]]| lerp(row[x.at as usize], row[x.next as usize], x.t);
        lerp(along(upper), along(lower), y.t)
    }

    /// The image at a place in pixels, clamped to its edges.
    #[inline]
    pub(crate) fn at(&self, x: f64, y: f64) -> [f32; C] {
        self.fetch(Tap::clamped(x, self.width()), Tap::clamped(y, self.height()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_stand_at_their_centres_and_edges_go_on() {
        let image = Image::<1>::by_rows(3, 2, |y, row| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = [(x + 3 * y) as f32];
            }
        });
        for (x, y, value) in [
            (0.5, 0.5, 0.0),
            (2.5, 1.5, 5.0),
            (1.0, 0.5, 0.5),
            (1.75, 1.0, 2.75),
            (-9.0, -9.0, 0.0),
            (99.0, 0.5, 2.0),
            (f64::NAN, 0.5, 0.0),
        ] {
            assert!((image.at(x, y)[0] - value).abs() < 1e-6, "{x}, {y}");
        }
    }

    #[test]
    fn equal_pixels_have_their_own_mean() {
        let value = [0.1f32, 0.7, 1.0 / 3.0];
        assert_eq!(mean16(|_, _| value).map(f32::to_bits), value.map(f32::to_bits));
        assert_eq!(lerp(value, value, 0.3).map(f32::to_bits), value.map(f32::to_bits));
        assert!((mean16(|p, q| [(p + 4 * q) as f32])[0] - 7.5).abs() < 1e-6);
    }
}
