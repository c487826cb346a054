//! Display windows and data windows.

use std::ops::Range;

use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;

use crate::error::ReadErrorKind;

/// The display window, and the position of the data window in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) display_width: usize,
    pub(crate) display_height: usize,
    /// Position of the data window's corner relative to the display window's.
    data_at: (i64, i64),
    data_size: (usize, usize),
}

impl Window {
    pub(crate) fn of(header: &Header) -> Result<Self, ReadErrorKind> {
        let display = header.shared_attributes.display_window;
        let data = header.own_attributes.layer_position;
        let size = header.layer_size;
        let window = Self {
            display_width: display.size.0,
            display_height: display.size.1,
            data_at: (
                i64::from(data.0) - i64::from(display.position.0),
                i64::from(data.1) - i64::from(display.position.1),
            ),
            data_size: (size.0, size.1),
        };
        if window.columns().is_empty() || window.rows().is_empty() {
            let text = |w: usize, h: usize, x: i32, y: i32| format!("{w}x{h}{x:+}{y:+}");
            return Err(ReadErrorKind::DisjointWindows {
                data: text(size.0, size.1, data.0, data.1),
                display: text(
                    display.size.0,
                    display.size.1,
                    display.position.0,
                    display.position.1,
                ),
            });
        }
        Ok(window)
    }

    /// Columns of the display window that hold data.
    fn columns(&self) -> Range<usize> {
        overlap(self.data_at.0, self.data_size.0, self.display_width)
    }

    /// Rows of the display window that hold data.
    fn rows(&self) -> Range<usize> {
        overlap(self.data_at.1, self.data_size.1, self.display_height)
    }

    /// Whether pixel `index` of the display window holds data.
    pub(crate) fn has_data(&self, index: usize) -> bool {
        let (x, y) = (index % self.display_width, index / self.display_width);
        self.columns().contains(&x) && self.rows().contains(&y)
    }

    pub(crate) fn data_covers_display(&self) -> bool {
        self.columns() == (0..self.display_width) && self.rows() == (0..self.display_height)
    }

    /// The part of a line of samples that lies inside the display window: its position there, and
    /// its bytes. The first sample of the line is at column `x` and row `y` of the data window.
    pub(crate) fn visible<'a>(
        &self,
        x: usize,
        y: usize,
        bytes: &'a [u8],
        kind: SampleType,
    ) -> Option<(usize, &'a [u8])> {
        let sample = if kind == SampleType::F16 { 2 } else { 4 };
        let (x, y) = (x as i64 + self.data_at.0, y as i64 + self.data_at.1);
        let columns = overlap(x, bytes.len() / sample, self.display_width);
        if columns.is_empty() || !(0..self.display_height as i64).contains(&y) {
            return None;
        }
        let skip = (columns.start as i64 - x) as usize;
        let bytes = &bytes[skip * sample..(skip + columns.len()) * sample];
        Some((y as usize * self.display_width + columns.start, bytes))
    }

    /// The pixels of the display window that hold no data, as ranges of indices in reading order.
    pub(crate) fn uncovered(&self) -> impl Iterator<Item = Range<usize>> {
        let (width, columns, rows) = (self.display_width, self.columns(), self.rows());
        (0..self.display_height).flat_map(move |y| {
            let row = y * width;
            let data = if rows.contains(&y) { columns.clone() } else { width..width };
            [row..row + data.start, row + data.end..row + width]
        })
    }

    /// The number of pixels of the display window.
    pub(crate) fn display_len(&self) -> usize {
        self.display_width * self.display_height
    }

    /// The number of pixels of the data window.
    pub(crate) fn data_len(&self) -> usize {
        self.data_size.0 * self.data_size.1
    }
}

fn overlap(at: i64, length: usize, size: usize) -> Range<usize> {
    let from = at.clamp(0, size as i64);
    let to = at.saturating_add(length as i64).clamp(0, size as i64);
    from as usize..to as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_of_windows() {
        assert_eq!(overlap(-3, 10, 5), 0..5);
        assert_eq!(overlap(2, 10, 5), 2..5);
        assert_eq!(overlap(-3, 5, 5), 0..2);
        assert!(overlap(5, 3, 5).is_empty());
        assert!(overlap(-3, 3, 5).is_empty());
    }
}
