//! The samples of a polar buffer that a piece of the frame reads.

use crate::piece::Piece;
use crate::pixels::Pixels;
use crate::radial::Radial;
use crate::ragged::Ragged;
use crate::texel::Texel;
use crate::values::Window;

/// The samples of a piece; the room is kept from piece to piece.
#[derive(Debug, Default)]
pub(crate) struct PieceSamples {
    values: Vec<Texel>,
    reads: Vec<(u32, f32)>,
    first: usize,
}

impl PieceSamples {
    /// Takes the samples of a piece. `coordinate` is that of its pixels' columns, and `readers` says where
    /// each column is read.
    pub(crate) fn take<const C: usize>(
        &mut self,
        buffer: &Ragged,
        frame: &impl Pixels<C>,
        (coordinate, readers): (&Radial, &[[f32; 2]]),
        piece: &Piece,
    ) {
        let columns = buffer.columns();
        let last = columns.len() - 1;
        let [nearest, farthest] = piece.squares();
        let at = |square: f32| (coordinate.at(square) - 0.5).clamp(0.0, last as f32);
        self.first = (at(nearest) - 0.01).max(0.0) as usize;
        let end = ((at(farthest) + 0.01) as usize + 1).min(last);
        self.reads.clear();
        let mut length = 0;
        for column in &columns[self.first..=end] {
            let [inner, outer] = readers[column.index];
            let rows = piece.rows(inner, outer, column.rows);
            self.reads.push(((length as u32).wrapping_sub(rows.start as u32), column.rows as f32));
            if self.values.len() < length + rows.len() {
                self.values.resize(length + rows.len(), Texel::default());
            }
            let out = &mut self.values[length..length + rows.len()];
            // Row 1 is the first sample.
            buffer.sample_arc(frame, column, rows.start as i64 - 1, out);
            length += rows.len();
        }
        self.reads.extend(self.reads.last().copied());
    }

    /// The samples, for reading.
    pub(crate) fn window(&self) -> Window<'_> {
        Window { values: &self.values, reads: &self.reads, first: self.first }
    }
}

/// Between which distances from the gaze pixels read each of `n` columns: less than a column away.
/// Pixels within the first column read the one behind it too, with a weight of 0, and those beyond the
/// last one the one before it.
pub(crate) fn readers(coordinate: &Radial, n: usize) -> Vec<[f32; 2]> {
    const FAR_PX: f32 = 1e15;
    // A column's own coordinate is 0.5 more than its number.
    let of_column = |c: usize| {
        let inner = if c > 1 { coordinate.first(c as f32 - 0.5) } else { 0.0 };
        let outer = if c + 2 < n { coordinate.last(c as f32 + 1.5) } else { FAR_PX };
        // For rounding.
        [inner * 0.9999, outer * 1.0001]
    };
    (0..n).map(of_column).collect()
}
