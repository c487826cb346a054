//! Buffers whose columns and rows are functions of x and of y alone: RMFR, DEAMP, Guenter's layers and
//! grids. All positions are tabulated along the two axes.

use std::ops::Range;

use crate::fetch::{Tap, lerp, mean16};
use crate::image::Image;
use crate::pixels::Pixels;
use crate::sample_places::{AxisPlaces, SamplePlaces};
use crate::sampling::Sampling;
use crate::texel::{Texel, narrowed, write_all};
use crate::value::Value;

/// The mapping along one axis, between the buffer and the frame.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    /// Where the centres of the samples' cells are on the frame, in pixels.
    pub(crate) centres_px: Vec<f64>,
    /// Where samples stand on the frame, in pixels.
    positions_px: Vec<f64>,
    /// The places of each sample, in pixels.
    pub(crate) places_px: Vec<f64>,
    /// From the places of each sample into the frame.
    from: Vec<Tap>,
    /// From each pixel of the frame into the buffer.
    to: Vec<Tap>,
}

impl Axis {
    /// An axis of `n` samples over a frame of `side` pixels. `position` leads from the buffer's
    /// coordinates, 0 to n, to the frame's in pixels, and `coordinate` back.
    pub(crate) fn new(
        n: usize,
        side: usize,
        places: AxisPlaces,
        position: impl Fn(f64) -> f64,
        coordinate: impl Fn(f64) -> f64,
    ) -> Self {
        let places_px: Vec<f64> = places.coordinates(n).map(&position).collect();
        Self {
            positions_px: (0..n).map(|i| position(i as f64 + places.within_cell)).collect(),
            centres_px: (0..n).map(|i| position(i as f64 + 0.5)).collect(),
            from: places_px.iter().map(|place| Tap::clamped(*place, side)).collect(),
            places_px,
            to: (0..side).map(|i| Tap::clamped(coordinate(i as f64 + 0.5), n)).collect(),
        }
    }

    /// Samples along the axis.
    pub(crate) fn len(&self) -> usize {
        self.centres_px.len()
    }
}

/// A buffer.
#[derive(Debug, Clone)]
pub(crate) struct Separable {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) places: SamplePlaces,
}

impl Separable {
    /// A buffer of two axes, both with the same places.
    pub(crate) fn new(x: Axis, y: Axis, places: SamplePlaces) -> Self {
        Self { x, y, places }
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// Where samples stand on the frame, in pixels, row by row.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let (xs, ys) = (&self.x.positions_px, &self.y.positions_px);
        ys.iter().flat_map(|y| xs.iter().map(|x| [*x, *y]))
    }

    /// The same without the samples whose column and row are both in a hole.
    pub(crate) fn positions_outside(
        &self,
        [columns, rows]: &[Range<usize>; 2],
    ) -> impl Iterator<Item = [f64; 2]> + '_ {
        let (w, columns, rows) = (self.x.len(), columns.clone(), rows.clone());
        let is_outside = move |index: usize| {
            let (i, j) = (index % w, index / w);
            !(columns.contains(&i) && rows.contains(&j))
        };
        let positions = self.positions().enumerate();
        positions.filter(move |(index, _)| is_outside(*index)).map(|(_, position)| position)
    }

    /// The buffer of a frame.
    pub(crate) fn sample<const C: usize, const L: usize>(
        &self,
        frame: &impl Pixels<C>,
    ) -> Image<L> {
        let [width, height] = self.size();
        Image::by_rows(width, height, |j, row| match self.places.sampling {
            Sampling::Point => {
                for (out, x) in row.iter_mut().zip(&self.x.from) {
                    *out = narrowed(frame.fetch(*x, self.y.from[j]));
                }
            }
            Sampling::Area => {
                let ys = &self.y.from[4 * j..4 * j + 4];
                for (out, xs) in row.iter_mut().zip(self.x.from.chunks_exact(4)) {
                    *out = narrowed(mean16(|p, q| frame.fetch(xs[p], ys[q])));
                }
            }
        })
    }

    /// What the pixels `xs` of row `y` of the frame read in a buffer. `scratch` is kept between calls.
    pub(crate) fn read_row<const C: usize>(
        &self,
        buffer: &Image<4>,
        y: usize,
        xs: Range<usize>,
        scratch: &mut Vec<Texel>,
        out: &mut [[f32; C]],
    ) {
        let taps = &self.x.to[xs];
        let (Some(first), Some(last)) = (taps.first(), taps.last()) else { return };
        let (first, last) = (first.at as usize, last.next as usize);
        let down = self.y.to[y];
        let upper = &buffer.row(down.at as usize)[first..=last];
        let lower = &buffer.row(down.next as usize)[first..=last];
        scratch.clear();
        scratch.extend(upper.iter().zip(lower).map(|(a, b)| lerp(*a, *b, down.t)));
        write_all(out, |i| {
            let tap = taps[i];
            let (at, next) = (tap.at as usize - first, tap.next as usize - first);
            lerp(scratch[at], scratch[next], tap.t)
        });
    }

    /// The frame as read from a buffer.
    pub(crate) fn read<const C: usize, V: Value>(&self, buffer: &Image<4>) -> Image<C, V> {
        let (width, height) = (self.x.to.len(), self.y.to.len());
        Image::by_rows_with(width, height, Vec::new, |scratch, y, out| {
            self.read_row(buffer, y, 0..width, scratch, out);
        })
    }
}
