//! Where the parts of a figure stand: title and legend on top, the plot area beneath them, its
//! axes in margins as wide as their labels are.
//!
//! The plot area of every figure has the same height and the picture grows with what stands around
//! it, so that the same step looks the same beside a short legend and a long one.

use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{LINE_PITCH, TITLE_PX};
use crate::canvas::wrap::wrap;
use crate::marks::legend::{Key, Legend};

/// Space left free along the border of a picture.
pub(crate) const MARGIN_PX: f64 = 8.0;
/// Width of a picture: printed 85 mm wide, half a page, a text of 12 px is one of 6 points.
pub(crate) const WIDTH_PX: f64 = 480.0;
/// Width of a figure of several columns: printed 170 mm wide, a whole page, a text of 12 px is one
/// of 6 points.
pub(crate) const PAGE_PX: f64 = 2.0 * WIDTH_PX;
/// Height of the plot area: with its axes and a row of legend about two thirds of the width.
pub(crate) const PLOT_HEIGHT_PX: f64 = 226.0;
/// A plot area narrower than this would show nothing: wide labels widen the picture instead.
pub(crate) const LEAST_PLOT_PX: f64 = 260.0;

/// The most lines of a title.
pub(crate) const TITLE_LINES: usize = 3;
/// Between the parts of the head and from them to the plot area.
const GAP_PX: f64 = 6.0;

/// What the axes need on each side of the plot area, the margin of the picture included at the
/// left, at the right and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sides {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) above: f64,
    pub(crate) below: f64,
}

/// A picture with title and legend drawn, and its plot area of a width.
pub(crate) fn begin(
    title: Option<&str>,
    series: &[(&str, Key)],
    sides: Sides,
    plot_width_px: f64,
) -> (Drawing, Rect) {
    let right = sides.left + plot_width_px;
    let width_px = (right + sides.right).ceil();
    let (mut drawing, top) = head(title, series, sides.left, width_px);
    let top = top + sides.above;
    let bottom = top + PLOT_HEIGHT_PX;
    drawing.height_px = (bottom + sides.below).ceil();
    (drawing, Rect { left: sides.left, top, right, bottom })
}

/// A picture of a width with title and legend drawn from `left_px` on, and where they end. It has
/// no height yet.
pub(crate) fn head(
    title: Option<&str>,
    series: &[(&str, Key)],
    left_px: f64,
    width_px: f64,
) -> (Drawing, f64) {
    let head_px = width_px - MARGIN_PX - left_px;
    let title = wrap(title.unwrap_or_default(), TITLE_PX, head_px, TITLE_LINES);
    let legend = Legend::new(series, head_px);

    let mut drawing = Drawing { width_px, height_px: 0.0, marks: Vec::new() };
    let mut top = MARGIN_PX;
    for line in &title {
        drawing.text(Text::new(line, (left_px, top + TITLE_PX), TITLE_PX, Anchor::Start));
        top += TITLE_PX * LINE_PITCH;
    }
    if !title.is_empty() {
        top += GAP_PX / 2.0;
    }
    if legend.height_px > 0.0 {
        legend.draw(&mut drawing, (left_px, top));
        top += legend.height_px + GAP_PX;
    }
    (drawing, top)
}

/// Says in the middle of an empty plot area that it is empty.
pub(crate) fn say_no_data(drawing: &mut Drawing, plot: Rect) {
    drawing.text(Text::new("no data", plot.centre(), TITLE_PX, Anchor::Middle));
}
