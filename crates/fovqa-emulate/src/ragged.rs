//! Polar buffers: KFR, LaFR, VaFR and Visual-Polar. Columns are distances from the gaze, rows directions,
//! of which each column may have a number of its own.
//!
//! Column c is at its distance for (c + 0.5), its row j in the direction (j + 0.5) / rows of a turn, and
//! with jitter at (c + ξ) and (j + η) / rows. Two columns are read at the same direction, not at the same
//! row.

use std::f64::consts::TAU;

use fovqa_methods::Setting;

use crate::arcs::Sides;
use crate::sample_places::SamplePlaces;

/// Values of a column beside its samples: the last one again before them, the first one behind.
pub(crate) const WRAPPED: usize = 2;

/// A column of a buffer.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// Its number.
    pub(crate) index: usize,
    /// Distance of its middle from the gaze in pixels.
    pub(crate) distance_px: f64,
    /// Distance of its samples from the gaze in pixels.
    radius_px: f64,
    /// Distances of the places of its samples.
    pub(crate) places_px: Vec<f64>,
    /// Samples around the gaze, at least 1.
    pub(crate) rows: usize,
    /// Where its values begin in [`Values`] of the whole buffer.
    pub(crate) start: usize,
}

/// The shape of a buffer.
#[derive(Debug)]
pub(crate) struct Ragged {
    columns: Vec<Column>,
    /// Where the values of each column begin, and its rows: what reading needs, close together. The last
    /// column is there twice, so that each one has a next.
    pub(crate) reads: Vec<(u32, f32)>,
    /// Values of all columns.
    pub(crate) length: usize,
    pub(crate) places: SamplePlaces,
    pub(crate) gaze_px: [f64; 2],
}

impl Ragged {
    /// A buffer of `n` columns. `distance` leads from a column's coordinate, 0 to n, to pixels, and
    /// `rows` from there to the number of rows.
    pub(crate) fn new(
        n: usize,
        setting: &Setting,
        places: SamplePlaces,
        distance: impl Fn(f64) -> f64,
        rows: impl Fn(f64) -> usize,
    ) -> Self {
        let mut length = 0;
        let column = |c: usize| {
            let distance_px = distance(c as f64 + 0.5);
            let along = places.axis(0);
            let radius_px = distance(c as f64 + along.within_cell);
            let places_px = (0..along.count).map(|p| distance(c as f64 + along.at(p))).collect();
            let (rows, start) = (rows(distance_px), length);
            length += rows + WRAPPED;
            Column { index: c, distance_px, radius_px, places_px, rows, start }
        };
        let columns: Vec<Column> = (0..n).map(column).collect();
        let read = |column: &Column| (column.start as u32, column.rows as f32);
        let reads = columns.iter().chain(columns.last()).map(read).collect();
        Self { columns, reads, length, places, gaze_px: setting.gaze_px() }
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

    /// Place (p, q) of sample `j` of a column, on the frame in pixels.
    pub(crate) fn place_px(&self, column: &Column, j: usize, p: usize, q: usize) -> [f64; 2] {
        self.at(column, column.places_px[p], j as f64 + self.places.axis(1).at(q))
    }

    /// Where samples stand on the frame, in pixels, column by column.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let within = self.places.axis(1).within_cell;
        self.columns.iter().flat_map(move |column| {
            (0..column.rows).map(move |j| self.at(column, column.radius_px, j as f64 + within))
        })
    }

    /// A distance from the gaze in the direction of a column's row, on the frame in pixels.
    fn at(&self, column: &Column, radius_px: f64, row: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(row / column.rows as f64 * TAU);
        let [gx, gy] = self.gaze_px;
        [gx + radius_px * cos, gy + radius_px * sin]
    }

    /// Number of samples inside the frame.
    pub(crate) fn on_screen(&self, setting: &Setting) -> usize {
        let frame = Sides::of_frame(setting);
        self.columns.iter().map(|column| frame.count_inside(column.distance_px, column.rows)).sum()
    }
}
