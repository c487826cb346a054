//! What pixels read in a polar buffer of ragged columns.

use fovqa_methods::Setting;
use multiversion::multiversion;

use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::ragged::{Ragged, Values};
use crate::split::split;
use crate::texel::narrowed;
use crate::turn::turn;
use crate::value::Value;

/// From pixels to a buffer of ragged columns.
#[derive(Debug)]
pub(crate) struct PolarView {
    /// A pixel's column coordinate.
    column: Radial,
    offsets: Offsets,
}

impl PolarView {
    /// `column` leads from the distance from the gaze in pixels to the buffer's column coordinate.
    pub(crate) fn new(setting: &Setting, column: impl Fn(f64) -> f64 + Sync + Send) -> Self {
        let column = Radial::new(Detail::Coarse, setting.corner_px(), column);
        Self { column, offsets: Offsets::new(setting) }
    }

    /// The frame as read from a buffer; 0 beyond a distance from the gaze.
    pub(crate) fn show<const C: usize, V: Value>(
        &self,
        buffer: &Ragged,
        values: &Values,
        reach_px: f64,
    ) -> Image<C, V> {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let last = buffer.columns().len() - 1;
        Image::by_rows_with(width, height, || Places::new(width), |places, y, out| {
            places.set(&self.column, &self.offsets.x, self.offsets.y[y], last as f32);
            let xs = self.offsets.within(y, reach_px);
            let Places { columns, rest, turns } = places;
            let places = columns[xs.clone()].iter().zip(&rest[xs.clone()]).zip(&turns[xs.clone()]);
            out[..xs.start].fill([0.0; C]);
            out[xs.end..].fill([0.0; C]);
            for (out, ((column, rest), turn)) in out[xs].iter_mut().zip(places) {
                *out = narrowed(buffer.between(values, *column as usize, *rest, *turn));
            }
        })
    }
}

/// Where the pixels of a row read.
#[derive(Debug)]
struct Places {
    /// Columns, and how far behind them.
    columns: Vec<u32>,
    rest: Vec<f32>,
    /// Directions.
    turns: Vec<f32>,
}

impl Places {
    fn new(width: usize) -> Self {
        Self { columns: vec![0; width], rest: vec![0.0; width], turns: vec![0.0; width] }
    }

    fn set(&mut self, column: &Radial, xs: &[f32], dy: f32, last: f32) {
        directions(xs, dy, &mut self.turns);
        columns(column, xs, dy, last, (&mut self.columns, &mut self.rest));
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn directions(xs: &[f32], dy: f32, turns: &mut [f32]) {
    for (dx, direction) in xs.iter().zip(turns) {
        *direction = turn(*dx, dy);
    }
}

/// Column coordinates less 0.5, clamped to the columns.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn columns(
    column: &Radial,
    xs: &[f32],
    dy: f32,
    last: f32,
    (wholes, rests): (&mut [u32], &mut [f32]),
) {
    for ((dx, whole), rest) in xs.iter().zip(wholes).zip(rests) {
        let at = column.at(dx * dx + dy * dy) - 0.5;
        (*whole, *rest) = split(at.max(0.0).min(last));
    }
}
