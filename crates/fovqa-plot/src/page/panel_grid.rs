//! The positions of a figure's panels, in rows and columns whose plot areas are aligned and have
//! the same size.

use crate::canvas::drawing::Rect;

/// The space that a panel needs around its plot area, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Needs {
    /// Space for the vertical axis, with a margin.
    pub(crate) left: f64,
    /// Space for the last label of the horizontal axis, with a margin.
    pub(crate) right: f64,
    /// Space for its title, above everything else.
    pub(crate) title: f64,
    /// Space for infinite values, above the plot area and below it.
    pub(crate) strips: (f64, f64),
    /// Space for the horizontal axis, with a margin.
    pub(crate) axis: f64,
}

impl Needs {
    /// The larger of two needs on each side.
    fn most(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            right: self.right.max(other.right),
            title: self.title.max(other.title),
            strips: (self.strips.0.max(other.strips.0), self.strips.1.max(other.strips.1)),
            axis: self.axis.max(other.axis),
        }
    }
}

/// The position of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    /// Left edge of its column.
    pub(crate) edge_px: f64,
    /// Lower edge of its title.
    pub(crate) title_px: f64,
    pub(crate) plot: Rect,
    /// Height of the strip below the plot area.
    pub(crate) below_px: f64,
}

/// The space that each column needs on its sides, and each row above and below.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Grid {
    columns: Vec<Needs>,
    rows: Vec<Needs>,
    /// Width and height of a plot area.
    plot_px: (f64, f64),
}

impl Grid {
    /// Panels in rows of `columns`, with plot areas of a width and a height.
    pub(crate) fn new(panels: &[Needs], columns: usize, plot_px: (f64, f64)) -> Self {
        let column = |c| panels.iter().skip(c).step_by(columns).copied();
        let most =
            |needs: &mut dyn Iterator<Item = Needs>| needs.fold(Needs::default(), Needs::most);
        Self {
            columns: (0..columns).map(|c| most(&mut column(c))).collect(),
            rows: panels.chunks(columns).map(|row| most(&mut row.iter().copied())).collect(),
            plot_px,
        }
    }

    /// The width of all columns.
    pub(crate) fn width_px(&self) -> f64 {
        self.left_px(self.columns.len())
    }

    /// The height of all rows.
    pub(crate) fn height_px(&self) -> f64 {
        self.top_px(self.rows.len())
    }

    /// The position of a panel in a grid that begins at `top_px`.
    pub(crate) fn place(&self, panel: usize, top_px: f64) -> Cell {
        let (r, c) = (panel / self.columns.len(), panel % self.columns.len());
        let (row, column) = (self.rows[r], self.columns[c]);
        let (width, height) = self.plot_px;
        let edge_px = self.left_px(c);
        let title_px = top_px + self.top_px(r) + row.title;
        let (left, top) = (edge_px + column.left, title_px + row.strips.0);
        let plot = Rect { left, top, right: left + width, bottom: top + height };
        Cell { edge_px, title_px, plot, below_px: row.strips.1 }
    }

    /// The left edge of a column.
    fn left_px(&self, column: usize) -> f64 {
        let width = |needs: &Needs| needs.left + self.plot_px.0 + needs.right;
        self.columns[..column].iter().map(width).sum()
    }

    /// The upper edge of a row.
    fn top_px(&self, row: usize) -> f64 {
        let height = |needs: &Needs| {
            needs.title + needs.strips.0 + self.plot_px.1 + needs.strips.1 + needs.axis
        };
        self.rows[..row].iter().map(height).sum()
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_are_as_large_as_the_largest_of_them_needs() {
        let least = Needs { left: 40.0, right: 8.0, title: 0.0, strips: (8.0, 0.0), axis: 20.0 };
        let wide = Needs { left: 60.0, right: 10.0, ..least };
        let high = Needs { title: 16.0, strips: (18.0, 18.0), ..least };
        let grid = Grid::new(&[least, wide, high], 2, (100.0, 50.0));
        assert_eq!(grid.width_px(), 148.0 + 170.0);
        assert_eq!(grid.height_px(), 78.0 + 122.0);
        let [first, second, third] = [0, 1, 2].map(|panel| grid.place(panel, 5.0));
        let plot =
            |left: f64, top: f64| Rect { left, top, right: left + 100.0, bottom: top + 50.0 };
        assert_eq!((first.edge_px, first.plot), (0.0, plot(40.0, 13.0)));
        assert_eq!((second.edge_px, second.plot), (148.0, plot(208.0, 13.0)));
        assert_eq!((third.title_px, third.plot), (99.0, plot(40.0, 117.0)));
        assert_eq!((second.below_px, third.below_px), (0.0, 18.0));
    }
}
