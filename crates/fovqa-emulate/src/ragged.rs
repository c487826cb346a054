//! Polar buffers whose columns have different numbers of rows: VaFR and Visual-Polar. Columns are
//! distances from the gaze, rows directions.
//!
//! Column c is at its distance for (c + 0.5), its row j in the direction (j + 0.5) / rows of a turn. Two
//! columns are read at the same direction, not at the same row.

use std::f64::consts::TAU;
use std::ops::Range;

use fovqa_methods::Setting;
use rayon::prelude::*;

use crate::arcs::Surroundings;
use crate::circle::Circle;
use crate::fetch::{lerp, mean16};
use crate::image::Image;
use crate::pixels::Pixels;
use crate::sampling::Sampling;
use crate::split::split;
use crate::taps::{PLACES, Taps};
use crate::texel::{Texel, narrowed};

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
    /// The samples that pixels read.
    seen: Vec<Range<usize>>,
}

/// The shape of a buffer.
#[derive(Debug)]
pub(crate) struct Ragged {
    columns: Vec<Column>,
    /// Where the values of each column begin, and its rows: what reading needs, close together. The
    /// last column is there twice, so that each one has a next.
    reads: Vec<(u32, f32)>,
    sampling: Sampling,
    gaze_px: [f64; 2],
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
            let places_px = places.collect();
            let column = Column { distance_px, places_px, rows, start, seen: Vec::new() };
            start += rows + WRAPPED;
            column
        });
        let mut columns: Vec<Column> = columns.collect();
        for (column, seen) in seen(&columns, setting).into_iter().enumerate() {
            columns[column].seen = seen;
        }
        let read = |column: &Column| (column.start as u32, column.rows as f32);
        let reads = columns.iter().chain(columns.last()).map(read).collect();
        Self { columns, reads, sampling, gaze_px: setting.gaze_px() }
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
    pub(crate) fn on_screen(&self, setting: &Setting) -> usize {
        let frame = Surroundings::frame(setting);
        self.columns.iter().map(|column| frame.count(column.distance_px, column.rows)).sum()
    }

    /// All samples of a frame.
    pub(crate) fn sample<const C: usize>(&self, frame: &impl Pixels<C>) -> Values {
        self.fill(|_, column, out| self.sample_arc(frame, column, 0, out))
    }

    /// Those samples of a frame that its pixels read.
    pub(crate) fn sample_seen<const C: usize>(&self, frame: &impl Pixels<C>) -> Values {
        self.fill(|_, column, out| {
            for arc in &column.seen {
                self.sample_arc(frame, column, arc.start, &mut out[arc.clone()]);
            }
        })
    }

    /// Samples of a column, from its row `first` on.
    fn sample_arc<const C: usize>(
        &self,
        frame: &impl Pixels<C>,
        column: &Column,
        first: usize,
        out: &mut [Texel],
    ) {
        let [gx, gy] = self.gaze_px;
        let distances = &column.places_px;
        match self.sampling {
            Sampling::Point => {
                let mut circle = Circle::new(first, column.rows);
                let (mut xs, mut ys) = (Taps::new(), Taps::new());
                for out in out.chunks_mut(PLACES) {
                    xs.set(gx, distances[0], &circle.x[..out.len()], frame.width());
                    ys.set(gy, distances[0], &circle.y[..out.len()], frame.height());
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = frame.fetch(xs.get(i), ys.get(i));
                    }
                    circle.advance();
                }
            }
            Sampling::Area => {
                let mut circle = Circle::new(4 * first, 4 * column.rows);
                for out in out.chunks_mut(PLACES / 4) {
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = mean16(|p, q| {
                            let (x, y) = (circle.x[4 * i + q], circle.y[4 * i + q]);
                            frame.at_place(gx + distances[p] * x, gy + distances[p] * y)
                        });
                    }
                    circle.advance();
                }
            }
        }
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
        along(values, self.reads[c], turn)
    }

    /// The buffer between a column and the next one, and in a direction in turns.
    #[inline(always)]
    pub(crate) fn between(&self, values: &Values, c: usize, t: f32, turn: f32) -> Texel {
        let pair = &self.reads[c..c + 2];
        lerp(along(values, pair[0], turn), along(values, pair[1], turn), t)
    }

    /// The buffer at a column less 0.5, clamped to the columns, and a direction in turns.
    #[inline(always)]
    pub(crate) fn read(&self, values: &Values, column: f32, turn: f32) -> Texel {
        let last = self.columns.len() - 1;
        let (c, t) = split(column.max(0.0).min(last as f32));
        self.between(values, c as usize, t, turn)
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

/// A column that begins somewhere and has so many rows, read in a direction.
#[inline(always)]
fn along(values: &Values, (start, rows): (u32, f32), turn: f32) -> Texel {
    let (at, t) = split(turn * rows + 0.5);
    let from = (start + at) as usize;
    let pair = &values.0[from..from + 2];
    lerp(pair[0], pair[1], t)
}

/// The samples of each column that pixels read: a pixel is less than a column away along the line to the
/// gaze, and less than a row across it. Of the last column that is all, for pixels beyond it.
fn seen(columns: &[Column], setting: &Setting) -> Vec<Vec<Range<usize>>> {
    let frame = Surroundings::frame(setting);
    let distance_px = |c: usize| columns[c].distance_px;
    let of_column = |(c, column): (usize, &Column)| {
        if c + 1 == columns.len() {
            return vec![0..column.rows];
        }
        let (inner, outer) = (c.checked_sub(1).map_or(0.0, distance_px), distance_px(c + 1));
        let along_px = (column.distance_px - inner).max(outer - column.distance_px);
        let across_px = outer * TAU / column.rows as f64;
        // Pixels know their column to a thousandth.
        let margin_px = 1.01 * (along_px + across_px) + 1.0;
        frame.widened(margin_px).arcs(column.distance_px, column.rows)
    };
    columns.iter().enumerate().map(of_column).collect()
}
