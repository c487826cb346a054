//! Pieces of the frame, and what their pixels read of a polar buffer.
//!
//! A whole buffer of a large frame is larger than the caches. What the pixels of a piece read is not, and
//! is sampled for them alone.

use std::ops::Range;

use crate::turn::turn;

/// A rectangle of pixels in one quarter around the gaze.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// The least and the largest distance of its pixels from the gaze along x and along y, in pixels.
    x_px: [f32; 2],
    y_px: [f32; 2],
    /// Whether it is left of the gaze, and above it.
    left: bool,
    upper: bool,
}

impl Piece {
    /// Pixels at offsets from the gaze; all in `xs` and all in `ys` are of one sign, and there are some.
    pub(crate) fn new(xs: &[f32], ys: &[f32]) -> Self {
        let range = |offsets: &[f32]| {
            let ends = [offsets[0].abs(), offsets[offsets.len() - 1].abs()];
            [ends[0].min(ends[1]), ends[0].max(ends[1])]
        };
        Self { x_px: range(xs), y_px: range(ys), left: xs[0] < 0.0, upper: ys[0] < 0.0 }
    }

    /// The least and the largest squared distance of its pixels from the gaze.
    pub(crate) fn squares(&self) -> [f32; 2] {
        [0, 1].map(|i| self.x_px[i] * self.x_px[i] + self.y_px[i] * self.y_px[i])
    }

    /// Directions, in turns, between which its pixels at distances from `inner` to `outer` are, if it has
    /// any.
    fn directions(&self, inner: f32, outer: f32) -> Option<[f32; 2]> {
        let ([x0, x1], [y0, y1]) = (self.x_px, self.y_px);
        if outer < x0 || outer < y0 {
            return None;
        }
        // The other side of a triangle.
        let side = |long: f32, short: f32| ((long - short) * (long + short)).sqrt();
        let mut from = turn(side(outer, y0), y0);
        let mut to = turn(x0, side(outer, x0));
        if inner > x1 {
            from = from.max(turn(x1, side(inner, x1)));
        }
        if inner > y1 {
            to = to.min(turn(side(inner, y1), y1));
        }
        (from <= to).then_some(match (self.left, self.upper) {
            (false, false) => [from, to],
            (true, false) => [0.5 - to, 0.5 - from],
            (true, true) => [0.5 + from, 0.5 + to],
            (false, true) => [1.0 - to, 1.0 - from],
        })
    }

    /// The rows that its pixels read of a column of so many samples; of these row 1 is the first one. The
    /// pixels are at distances from `inner` to `outer`.
    pub(crate) fn rows(&self, inner: f32, outer: f32, samples: usize) -> Range<usize> {
        let Some([from, to]) = self.directions(inner, outer) else { return 0..0 };
        // Directions are off by 1e-7 turns.
        let (samples, slack) = (samples as f32, 0.01 + 1e-6 * samples as f32);
        let first = (from * samples + 0.5 - slack).max(0.0);
        let last = (to * samples + 0.5 + slack).min(samples + 0.5);
        first as usize..last as usize + 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_hold_those_of_all_pixels() {
        let offsets = |from: i32, n: i32| (from..from + n).map(|i| i as f32 + 0.25).collect();
        for (x, y) in [(0, 0), (0, 40), (40, 0), (31, 57), (-30, 0), (-90, -95), (5, -30), (-31, 7)]
        {
            let (xs, ys): (Vec<f32>, Vec<f32>) = (offsets(x, 30), offsets(y, 24));
            let piece = Piece::new(&xs, &ys);
            for samples in [1, 5, 100, 3000] {
                for inner in [0.0f32, 3.0, 29.0, 45.0, 70.0, 100.0] {
                    let outer = inner + 4.0;
                    let rows = piece.rows(inner, outer, samples);
                    for (x, y) in xs.iter().flat_map(|x| ys.iter().map(move |y| (*x, *y))) {
                        if !(inner..=outer).contains(&x.hypot(y)) {
                            continue;
                        }
                        let row = (turn(x, y) * samples as f32 + 0.5) as usize;
                        assert!(rows.contains(&row) && rows.contains(&(row + 1)), "{x} {y}");
                    }
                    assert!(rows.end <= samples + 2);
                }
            }
        }
    }
}
