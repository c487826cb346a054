//! The paper that a figure is printed on, in pixels: the smallest text has 11 of them.

use crate::canvas::printed::PT_PER_IN;
use crate::canvas::text::VALUE_PX;
use crate::page::style::Style;

/// The width of a column in inches.
const COLUMN_IN: f64 = 3.3;
/// The width of a page in inches.
const PAGE_IN: f64 = 7.0;
/// The height of the plot area of a single chart, as a share of the figure's width. With its axes
/// and one row of legend the figure is then about two thirds as high as it is wide.
const PLOT_HEIGHT: f64 = 0.47;
/// The height of the plot area of one of several charts, as a share of the figure's width.
const PANEL_HEIGHT: f64 = 0.18;
/// The smallest height of a plot area unless a height was asked for.
const LEAST_HEIGHT_PX: f64 = 130.0;
/// The smallest width of a plot area unless a width was asked for, as a share of the figure's
/// width. Wide labels widen the figure instead.
const LEAST_PLOT: f64 = 0.5;
/// The same where the width was asked for.
const LEAST_FIXED_PLOT: f64 = 0.35;
/// The smallest width of a picture, and where the width was asked for.
const LEAST_PICTURE_PX: [f64; 2] = [140.0, 80.0];

/// The sizes that charts are laid out with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Paper {
    /// Points in print per pixel.
    pub(crate) pt_per_px: f64,
    /// The width of a figure with one chart.
    pub(crate) column_px: f64,
    /// The width of a figure with charts side by side.
    pub(crate) page_px: f64,
    /// Whether the width was asked for, so that a figure must not become wider.
    pub(crate) fixed: bool,
    /// The height of the plot area of a single chart.
    pub(crate) plot_height_px: f64,
    /// The height of the plot area of one of several charts.
    pub(crate) panel_height_px: f64,
}

impl Paper {
    pub(crate) fn new(style: &Style) -> Self {
        let pt_per_px = style.font_pt / VALUE_PX;
        let px = |inches: f64| inches * PT_PER_IN / pt_per_px;
        let column_px = px(style.width_in.unwrap_or(COLUMN_IN));
        let page_px = px(style.width_in.unwrap_or(PAGE_IN));
        Self {
            pt_per_px,
            column_px,
            page_px,
            fixed: style.width_in.is_some(),
            plot_height_px: (column_px * PLOT_HEIGHT).max(LEAST_HEIGHT_PX).round(),
            panel_height_px: (page_px * PANEL_HEIGHT).max(LEAST_HEIGHT_PX).round(),
        }
    }

    /// The smallest width of the plot area of a single chart. Labels that need more room widen the
    /// figure, or make all of it smaller if its width is fixed.
    pub(crate) fn least_plot_px(self) -> f64 {
        self.column_px * if self.fixed { LEAST_FIXED_PLOT } else { LEAST_PLOT }
    }

    /// The smallest width of a picture.
    pub(crate) fn least_picture_px(self) -> f64 {
        LEAST_PICTURE_PX[usize::from(self.fixed)]
    }

    /// The largest width of a figure of groups, beyond which bars become thinner.
    pub(crate) fn most_px(self) -> f64 {
        if self.fixed { self.column_px } else { self.page_px }
    }

    /// Inches in print of a number of pixels.
    pub(crate) fn inches(self, px: f64) -> f64 {
        px * self.pt_per_px / PT_PER_IN
    }

    /// The same paper with plot areas of this height.
    pub(crate) fn with_plot_height(self, height_px: f64) -> Self {
        Self { plot_height_px: height_px, panel_height_px: height_px, ..self }
    }
}

#[cfg(test)]
impl Paper {
    /// Wide paper, on which every label has room.
    pub(crate) fn wide() -> Self {
        Self {
            pt_per_px: 0.75,
            column_px: 480.0,
            page_px: 960.0,
            fixed: false,
            plot_height_px: 226.0,
            panel_height_px: 170.0,
        }
    }
}
