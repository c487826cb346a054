//! The layout of a figure: title and legend at the top, the plot area below them, and axes in
//! margins that are as wide as their labels.
//!
//! Unless a height was asked for, the plot area has the same height in every figure of a width, and
//! the picture grows with the parts around it, so that equal steps look equal beside a short legend
//! and a long one.

use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{LINE_PITCH, TITLE_PX};
use crate::canvas::wrap::wrap;
use crate::marks::legend::{Key, Legend};

/// Space left free along the border of a picture.
pub(crate) const MARGIN_PX: f64 = 8.0;
/// The largest number of lines of a title.
pub(crate) const TITLE_LINES: usize = 3;
/// Distance between the parts of the head, and from them to the plot area.
const GAP_PX: f64 = 6.0;

/// The space that the axes need on each side of the plot area, including the margin of the picture
/// on the left, on the right and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sides {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) above: f64,
    pub(crate) below: f64,
}

/// Starts a picture with its title and legend, and returns it with its plot area.
pub(crate) fn begin(
    title: Option<&str>,
    series: &[(&str, Key)],
    sides: Sides,
    (plot_width_px, plot_height_px): (f64, f64),
) -> (Drawing, Rect) {
    let right = sides.left + plot_width_px;
    let width_px = (right + sides.right).ceil();
    let (mut drawing, top) = head(title, series, sides.left, width_px);
    let top = top + sides.above;
    let bottom = top + plot_height_px;
    drawing.height_px = (bottom + sides.below).ceil();
    (drawing, Rect { left: sides.left, top, right, bottom })
}

/// Starts a picture of a width with its title and legend, drawn from `left_px` on, and returns it
/// with the position of their end. The picture has no height yet.
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

/// Writes in the middle of an empty plot area that there is no data.
pub(crate) fn write_no_data(drawing: &mut Drawing, plot: Rect) {
    drawing.text(Text::new("no data", plot.centre(), TITLE_PX, Anchor::Middle));
}
