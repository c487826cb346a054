//! The luma of a whole picture, and its halves.

use fovqa_frame::{Frame, LumaKind, LumaScratch, LumaSignal, SignalTables};

/// One value per pixel, row by row.
#[derive(Debug)]
pub(crate) struct Plane {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f32>,
}

impl Plane {
    pub(crate) fn new(frame: &Frame, tables: &SignalTables) -> Self {
        let (width, height) = (frame.width(), frame.height());
        let signal = LumaSignal::new(frame, tables, LumaKind::Luma);
        let mut scratch = LumaScratch::new(width);
        let mut row = vec![0.0; width];
        let mut values = Vec::with_capacity(width * height);
        for y in 0..height {
            signal.fill_row(y, 0..width, &mut scratch, &mut row);
            values.extend(row.iter().map(|value| *value as f32));
        }
        Self { width, height, values }
    }

    pub(crate) fn row(&self, y: usize) -> &[f32] {
        &self.values[y * self.width..][..self.width]
    }

    /// Means of 2x2 pixels.
    pub(crate) fn halved(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let mut values = Vec::with_capacity(width * height);
        for y in 0..height {
            let (upper, lower) = (self.row(2 * y), self.row(2 * y + 1));
            let pairs = upper.as_chunks::<2>().0.iter().zip(lower.as_chunks::<2>().0);
            values.extend(pairs.map(|([a, b], [c, d])| 0.25 * (a + b + c + d)));
        }
        Self { width, height, values }
    }
}
