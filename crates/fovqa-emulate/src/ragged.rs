//! Polar buffers whose columns have different numbers of rows: VaFR and Visual-Polar. Columns are
//! distances from the gaze, rows directions.
//!
//! Column c is at its distance for (c + 0.5), its row j in the direction (j + 0.5) / rows of a turn. Two
//! columns are read at the same direction, not at the same row.

use std::f64::consts::TAU;

use fovqa_methods::Setting;
use rayon::prelude::*;

use crate::fetch::{lerp, mean16};
use crate::image::Image;
use crate::places::{in_frame, place};
use crate::sampling::Sampling;
use crate::texel::{Texel, narrowed, widened};

/// A column of a buffer.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// Distance of its samples from the gaze in pixels.
    pub(crate) distance_px: f64,
    /// Distances of the places of its samples.
    places_px: Vec<f64>,
    /// Samples around the gaze, at least 1.
    pub(crate) rows: usize,
    /// Where its values begin in a [`Values`].
    start: usize,
}

/// The shape of a buffer.
#[derive(Debug)]
pub(crate) struct Ragged {
    columns: Vec<Column>,
    /// Where the values of each column begin, and its rows: what reading needs, close together.
    reads: Vec<(u32, f32)>,
    sampling: Sampling,
    setting: Setting,
}

/// The samples of a buffer, column after column. Each column has its last sample before its first one
/// and its first behind its last, so that reading between any two needs no wrapping.
#[derive(Debug, Clone)]
pub(crate) struct Values(Vec<Texel>);

/// Values of a column beside its samples.
const WRAPPED: usize = 2;

impl Ragged {
    /// A buffer of `n` columns. `distance` leads from a column's coordinate, 0 to n, to pixels, and
    /// `rows` from there to the number of rows.
    pub(crate) fn new(
        n: usize,
        setting: &Setting,
        sampling: Sampling,
        distance: impl Fn(f64) -> f64,
        rows: impl Fn(f64) -> usize,
    ) -> Self {
        let mut start = 0;
        let columns = (0..n).map(|c| {
            let distance_px = distance(c as f64 + 0.5);
            let places = sampling.places().iter().map(|place| distance(c as f64 + place));
            let rows = rows(distance_px);
            let column = Column { distance_px, places_px: places.collect(), rows, start };
            start += rows + WRAPPED;
            column
        });
        let columns: Vec<Column> = columns.collect();
        let reads =
            columns.iter().map(|column| (column.start as u32, column.rows as f32)).collect();
        Self { columns, reads, sampling, setting: *setting }
    }

    /// The columns from the gaze outwards.
    pub(crate) fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Columns, and rows of the longest one.
    pub(crate) fn size(&self) -> [usize; 2] {
        let longest = self.columns.iter().map(|column| column.rows).max();
        [self.columns.len(), longest.unwrap_or_default()]
    }

    /// Number of samples inside the frame.
    pub(crate) fn on_screen(&self) -> usize {
        let of_column = |column: &Column| {
            let places = directions(column.rows).take(column.rows);
            let seen = |at: &[f64; 2]| {
                in_frame(&self.setting, place(&self.setting, column.distance_px, *at))
            };
            places.filter(seen).count()
        };
        self.columns.par_iter().map(of_column).sum()
    }

    /// The samples of a frame.
    pub(crate) fn sample<const C: usize>(&self, frame: &Image<C>) -> Values {
        self.fill(|_, column, out| {
            let read = |distance_px: f64, direction: [f64; 2]| {
                let [x, y] = place(&self.setting, distance_px, direction);
                widened(frame.at(x, y))
            };
            match self.sampling {
                Sampling::Point => {
                    for (out, direction) in out.iter_mut().zip(directions(column.rows)) {
                        *out = read(column.places_px[0], direction);
                    }
                }
                Sampling::Area => {
                    let mut directions = directions(4 * column.rows);
                    for out in out {
                        let around: [_; 4] =
                            std::array::from_fn(|_| directions.next().unwrap_or_default());
                        *out = mean16(|p, q| read(column.places_px[p], around[q]));
                    }
                }
            }
        })
    }

    /// A buffer of this shape, computed column by column, in parallel.
    pub(crate) fn fill(&self, column: impl Fn(usize, &Column, &mut [Texel]) + Sync) -> Values {
        let length = self.columns.iter().map(|column| column.rows + WRAPPED).sum();
        let mut values = vec![Texel::default(); length];
        let mut rest = values.as_mut_slice();
        let mut parts = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            let (part, behind) = rest.split_at_mut(column.rows + WRAPPED);
            parts.push(part);
            rest = behind;
        }
        parts.into_par_iter().zip(&self.columns).enumerate().for_each(|(c, (part, of))| {
            column(c, of, &mut part[1..=of.rows]);
            part[0] = part[of.rows];
            part[of.rows + 1] = part[1];
        });
        Values(values)
    }

    /// A column read in a direction, in turns from 0 to 1.
    #[inline(always)]
    pub(crate) fn along(&self, values: &Values, c: usize, turn: f32) -> Texel {
        let (start, rows) = self.reads[c];
        let row = turn * rows + 0.5;
        let at = row as u32;
        let from = (start + at) as usize;
        let pair = &values.0[from..from + 2];
        lerp(pair[0], pair[1], row - at as f32)
    }

    /// The buffer at a column less 0.5, clamped to the columns, and a direction in turns.
    #[inline(always)]
    pub(crate) fn read(&self, values: &Values, column: f32, turn: f32) -> Texel {
        let last = self.reads.len() - 1;
        let column = column.max(0.0).min(last as f32);
        let c = column as usize;
        let near = self.along(values, c, turn);
        lerp(near, self.along(values, (c + 1).min(last), turn), column - c as f32)
    }

    /// The samples of a column.
    pub(crate) fn rows<'a>(&self, values: &'a Values, c: usize) -> &'a [Texel] {
        let column = &self.columns[c];
        &values.0[column.start + 1..=column.start + column.rows]
    }

    /// The samples as an image: column by column from the top, 0 where a column has no more rows.
    pub(crate) fn image<const C: usize>(&self, values: &Values) -> Image<C> {
        let [width, height] = self.size();
        Image::by_rows(width, height, |j, row| {
            for (c, out) in row.iter_mut().enumerate() {
                let sample = self.rows(values, c).get(j).copied();
                *out = narrowed(sample.unwrap_or_default());
            }
        })
    }
}

/// Unit vectors in the directions (k + 0.5) / n of a turn: each is the one before it, turned. After a
/// thousand of them rounding has added up to 1e-13.
fn directions(n: usize) -> impl Iterator<Item = [f64; 2]> {
    let (sin, cos) = libm::sincos(TAU / n as f64);
    let (y, x) = libm::sincos(TAU / (2.0 * n as f64));
    std::iter::successors(Some([x, y]), move |[x, y]| Some([x * cos - y * sin, x * sin + y * cos]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_stay_on_the_circle() {
        for n in [1, 2, 7, 2000] {
            for (k, [x, y]) in directions(n).take(n).enumerate() {
                let angle = TAU * (k as f64 + 0.5) / n as f64;
                assert!((x - angle.cos()).abs() < 1e-12 && (y - angle.sin()).abs() < 1e-12);
            }
        }
    }
}
