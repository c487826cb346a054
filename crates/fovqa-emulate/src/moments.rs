//! Mean and mean square around each pixel, and their mip chain: what history is clamped to.
//!
//! Level 0 is the mean over 3x3 pixels, edges clamped; level l + 1 has half the size, rounded up, its
//! sample i the mean of 2i and min(2i + 1, last) along both axes.

use crate::fetch::{Tap, lerp};
use crate::image::Image;

/// The coarsest level.
pub(crate) const COARSEST: usize = 4;

/// Which moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Moment {
    /// Of C.
    First,
    /// Of C².
    Second,
}

impl Moment {
    #[inline(always)]
    fn of<const C: usize>(self, value: [f32; C]) -> [f32; C] {
        match self {
            Self::First => value,
            Self::Second => value.map(|v| v * v),
        }
    }

    /// One row of level 0.
    pub(crate) fn row<const C: usize>(self, image: &Image<C>, y: usize, out: &mut [[f32; C]]) {
        let last = image.height() - 1;
        let rows = [y.saturating_sub(1), y, (y + 1).min(last)].map(|y| image.row(y));
        let column = |x: usize| {
            let [a, b, c] = rows.map(|row| self.of(row[x]));
            std::array::from_fn::<f32, C, _>(|i| a[i] + b[i] + c[i])
        };
        let width = out.len();
        let mut before = column(0);
        let mut here = before;
        for (x, out) in out.iter_mut().enumerate() {
            let behind = if x + 1 < width { column(x + 1) } else { here };
            *out = std::array::from_fn(|i| (before[i] + here[i] + behind[i]) * (1.0 / 9.0));
            (before, here) = (here, behind);
        }
    }
}

/// Levels 1 to [`COARSEST`] of a moment, and where each pixel reads them.
#[derive(Debug)]
pub(crate) struct Chain<const C: usize> {
    levels: Vec<Level<C>>,
}

#[derive(Debug)]
struct Level<const C: usize> {
    image: Image<C>,
    x: Vec<Tap>,
    y: Vec<Tap>,
}

impl<const C: usize> Chain<C> {
    pub(crate) fn new(moment: Moment, frame: &Image<C>) -> Self {
        let (width, height) = (frame.width(), frame.height());
        let mut levels: Vec<Level<C>> = Vec::with_capacity(COARSEST);
        for l in 1..=COARSEST {
            let image = match levels.last() {
                None => halved(width, height, |y, row| moment.row(frame, y, row)),
                Some(Level { image, .. }) => halved(image.width(), image.height(), |y, row| {
                    row.copy_from_slice(image.row(y));
                }),
            };
            let taps = |side: usize, n: usize| {
                let scale = f64::from(1u32 << l);
                (0..side).map(|i| Tap::clamped((i as f64 + 0.5) / scale, n)).collect()
            };
            let (x, y) = (taps(width, image.width()), taps(height, image.height()));
            levels.push(Level { image, x, y });
        }
        Self { levels }
    }

    /// The moment at pixel x, y and a level from 0 to [`COARSEST`], between levels linearly; `finest` is
    /// level 0 there.
    #[inline]
    pub(crate) fn at(&self, level: f32, x: usize, y: usize, finest: [f32; C]) -> [f32; C] {
        let l = (level as usize).min(COARSEST);
        let read = |l: usize| match l.checked_sub(1).map(|l| &self.levels[l]) {
            None => finest,
            Some(level) => level.image.fetch(level.x[x], level.y[y]),
        };
        let t = level - l as f32;
        if t > 0.0 && l < COARSEST { lerp(read(l), read(l + 1), t) } else { read(l) }
    }
}

/// Means of 2x2, of rows as `read` gives them.
fn halved<const C: usize>(
    width: usize,
    height: usize,
    read: impl Fn(usize, &mut [[f32; C]]) + Sync + Send,
) -> Image<C> {
    let half = width.div_ceil(2);
    Image::by_blocks(half, height.div_ceil(2), |rows, pixels| {
        let (mut upper, mut lower) = (vec![[0.0; C]; width], vec![[0.0; C]; width]);
        for (y, out) in rows.zip(pixels.chunks_exact_mut(half)) {
            read(2 * y, &mut upper);
            read((2 * y + 1).min(height - 1), &mut lower);
            for (i, out) in out.iter_mut().enumerate() {
                let (a, b) = (2 * i, (2 * i + 1).min(width - 1));
                *out = lerp(lerp(upper[a], upper[b], 0.5), lerp(lower[a], lower[b], 0.5), 0.5);
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chain_halves_odd_sides_upwards() {
        let image = Image::<1>::by_rows(5, 3, |y, row| {
            for (x, out) in row.iter_mut().enumerate() {
                *out = [if (x, y) == (4, 2) { 9.0 } else { 0.0 }];
            }
        });
        let mut row = vec![[0.0]; 5];
        Moment::First.row(&image, 2, &mut row);
        // The corner stands four times in its own window.
        assert_eq!(row.iter().map(|v| v[0].round()).collect::<Vec<_>>(), [0.0, 0.0, 0.0, 2.0, 4.0]);
        Moment::Second.row(&image, 1, &mut row);
        assert_eq!(
            row.iter().map(|v| v[0].round()).collect::<Vec<_>>(),
            [0.0, 0.0, 0.0, 9.0, 18.0]
        );
        let chain = Chain::new(Moment::First, &image);
        let sizes = chain.levels.iter().map(|l| [l.image.width(), l.image.height()]);
        assert_eq!(sizes.collect::<Vec<_>>(), [[3, 2], [2, 1], [1, 1], [1, 1]]);
        // Columns 4 and 4 again, rows 2 and 2 again.
        assert!((chain.levels[0].image.row(1)[2][0] - 4.0).abs() < 1e-5);
    }
}
