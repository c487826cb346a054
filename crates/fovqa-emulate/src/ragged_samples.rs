//! The samples of a polar buffer, read in a frame.

use crate::circle::Circle;
use crate::fetch::mean16;
use crate::pixels::Pixels;
use crate::ragged::{Column, Ragged};
use crate::sampling::Sampling;
use crate::taps::{PLACES, Taps};
use crate::texel::Texel;
use crate::values::Values;

impl Ragged {
    /// All samples of a frame.
    pub(crate) fn sample<const C: usize>(&self, frame: &impl Pixels<C>) -> Values {
        self.fill(|column, out| self.sample_arc(frame, column, 0, out))
    }

    /// Samples of a column from row `first` on, which may be before its first row or go on behind its
    /// last one.
    pub(crate) fn sample_arc<const C: usize>(
        &self,
        frame: &impl Pixels<C>,
        column: &Column,
        first: i64,
        out: &mut [Texel],
    ) {
        let [gx, gy] = self.gaze_px;
        let along = self.places.axis(1);
        let (distances_px, places) = (&column.places_px, along.count);
        let mut circle =
            Circle::new(first * places as i64, column.rows * places, along.within_cell);
        let (mut xs, mut ys) = (Taps::new(), Taps::new());
        for out in out.chunks_mut(PLACES / places) {
            match self.places.sampling {
                Sampling::Point => {
                    xs.set(gx, distances_px[0], &circle.x[..out.len()], frame.width());
                    ys.set(gy, distances_px[0], &circle.y[..out.len()], frame.height());
                    frame.fetch_all(&xs, &ys, out);
                }
                Sampling::Area => {
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = mean16(|p, q| {
                            let (x, y) = (circle.x[4 * i + q], circle.y[4 * i + q]);
                            frame.at_place(gx + distances_px[p] * x, gy + distances_px[p] * y)
                        });
                    }
                }
            }
            circle.advance();
        }
    }
}
