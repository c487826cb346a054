//! Values of polar buffers, and how pixels read them.
//!
//! The values of a column are side by side: its last sample, all its samples, and its first one again, so
//! that reading between any two needs no wrapping.

use multiversion::multiversion;
use rayon::prelude::*;

use crate::fetch::lerp;
use crate::image::Image;
use crate::places::{Places, TILE};
use crate::ragged::{Column, Ragged, WRAPPED};
use crate::split::split;
use crate::texel::{Texel, narrowed, write_all};

/// The samples of a whole buffer.
#[derive(Debug, Clone)]
pub(crate) struct Values(Vec<Texel>);

impl Values {
    /// A sample of a column.
    #[inline]
    pub(crate) fn sample(&self, column: &Column, j: usize) -> Texel {
        self.0[column.start + 1 + j]
    }
}

/// Values of some neighbouring columns, for reading.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window<'a> {
    pub(crate) values: &'a [Texel],
    /// Where row 0 of each column is or would be, modulo 2^32, and the rows of the whole column. The
    /// last column is there twice, so that each one has a next.
    pub(crate) reads: &'a [(u32, f32)],
    /// The number of the first column.
    pub(crate) first: usize,
}

/// What a pixel reads of its two columns: a row and the next one, and how far behind the first.
#[derive(Debug, Clone, Copy, Default)]
struct Pair {
    at: [u32; 2],
    t: [f32; 2],
}

impl Ragged {
    /// The samples as an image: column by column from the top, 0 where a column has no more rows.
    pub(crate) fn image<const C: usize>(&self, values: &Values) -> Image<C> {
        let [width, height] = self.size();
        Image::by_rows(width, height, |j, row| {
            for (out, column) in row.iter_mut().zip(self.columns()) {
                let inside = j < column.rows;
                *out = narrowed(if inside { values.sample(column, j) } else { [0.0; 4] });
            }
        })
    }

    /// Values of this buffer, computed column by column, in parallel.
    pub(crate) fn fill(&self, column: impl Fn(&Column, &mut [Texel]) + Sync) -> Values {
        let mut values = vec![Texel::default(); self.length];
        let mut rest = values.as_mut_slice();
        let mut parts = Vec::with_capacity(self.columns().len());
        for column in self.columns() {
            let (part, behind) = rest.split_at_mut(column.rows + WRAPPED);
            parts.push(part);
            rest = behind;
        }
        parts.into_par_iter().zip(self.columns()).for_each(|(part, of)| {
            column(of, &mut part[1..=of.rows]);
            part[0] = part[of.rows];
            part[of.rows + 1] = part[1];
        });
        Values(values)
    }

    /// All values, for reading.
    pub(crate) fn window<'a>(&'a self, values: &'a Values) -> Window<'a> {
        Window { values: &values.0, reads: &self.reads, first: 0 }
    }

    /// A column read in a direction, in turns from 0 to 1.
    #[inline]
    pub(crate) fn along(&self, values: &Values, c: usize, turn: f32) -> Texel {
        let (at, t) = row(self.reads[c], turn);
        let pair = &values.0[at as usize..at as usize + 2];
        lerp(pair[0], pair[1], t)
    }

    /// The buffer at a column less 0.5, clamped to the columns, and a direction in turns.
    #[inline]
    pub(crate) fn read(&self, values: &Values, column: f32, turn: f32) -> Texel {
        let last = self.columns().len() - 1;
        let (c, t) = split(column.max(0.0).min(last as f32));
        let c = c as usize;
        lerp(self.along(values, c, turn), self.along(values, (c + 1).min(last), turn), t)
    }
}

impl Window<'_> {
    /// The values at many places.
    pub(crate) fn read_all<const C: usize>(&self, places: &Places, out: &mut [[f32; C]]) {
        let mut columns = [[(0, 0.0); 2]; TILE];
        for (pair, column) in columns[..out.len()].iter_mut().zip(&places.columns) {
            let column = *column as usize - self.first;
            pair.copy_from_slice(&self.reads[column..column + 2]);
        }
        let mut pairs = [Pair::default(); TILE];
        find_rows(&columns[..out.len()], &places.turns, &mut pairs[..out.len()]);
        write_all(out, |i| {
            let Pair { at, t } = pairs[i];
            let along = |k: usize| {
                let pair = &self.values[at[k] as usize..at[k] as usize + 2];
                lerp(pair[0], pair[1], t[k])
            };
            lerp(along(0), along(1), places.rest[i])
        });
    }
}

/// What is read of a column in a direction: a row, and how far behind it.
#[inline(always)]
fn row((start, rows): (u32, f32), turn: f32) -> (u32, f32) {
    let (row, t) = split(turn * rows + 0.5);
    (start.wrapping_add(row), t)
}

/// Rows of many pixels, after what is known of their columns was brought together.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn find_rows(columns: &[[(u32, f32); 2]], turns: &[f32], pairs: &mut [Pair]) {
    for ((pair, columns), turn) in pairs.iter_mut().zip(columns).zip(turns) {
        for (k, column) in columns.iter().enumerate() {
            (pair.at[k], pair.t[k]) = row(*column, *turn);
        }
    }
}
