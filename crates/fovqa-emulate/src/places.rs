//! Where the pixels of a tile's row read a polar buffer.

use multiversion::multiversion;

use crate::radial::Radial;
use crate::split::split;
use crate::turn::turn;

/// Width of a tile in pixels.
pub(crate) const TILE: usize = 64;

/// Places of up to as many pixels as a tile is wide.
#[derive(Debug)]
pub(crate) struct Places {
    /// Columns, and how far behind each the pixel reads, from 0 to 1.
    pub(crate) columns: [u32; TILE],
    pub(crate) rest: [f32; TILE],
    /// Directions in turns.
    pub(crate) turns: [f32; TILE],
}

impl Default for Places {
    fn default() -> Self {
        Self { columns: [0; TILE], rest: [0.0; TILE], turns: [0.0; TILE] }
    }
}

impl Places {
    /// Of pixels at offsets `xs` and `dy` from the gaze. `column` is the buffer's coordinate, 0.5 at the
    /// first column; what lies beyond the first and the last one reads these.
    pub(crate) fn set(&mut self, column: &Radial, xs: &[f32], dy: f32, last: usize) {
        directions(self, xs, dy);
        let coordinates = &mut self.rest[..xs.len()];
        squares(xs, dy, coordinates);
        column.at_all(coordinates);
        columns(&mut self.columns, coordinates, last as f32);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn directions(places: &mut Places, xs: &[f32], dy: f32) {
    for (dx, direction) in xs.iter().zip(&mut places.turns) {
        *direction = turn(*dx, dy);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn squares(xs: &[f32], dy: f32, squares: &mut [f32]) {
    for (dx, square) in xs.iter().zip(squares) {
        *square = dx * dx + dy * dy;
    }
}

/// Makes coordinates into columns and what is left of them.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn columns(columns: &mut [u32], coordinates: &mut [f32], last: f32) {
    for (column, rest) in columns.iter_mut().zip(coordinates) {
        (*column, *rest) = split((*rest - 0.5).max(0.0).min(last));
    }
}
