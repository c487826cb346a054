//! Shaded stretches behind the curves of a chart, such as the frames of a saccade.

use crate::canvas::colour::SPAN;
use crate::canvas::drawing::{Drawing, Rect};
use crate::marks::legend::Key;
use crate::scales::scale::{AxisPlace, Scale};

/// The smallest visible width of a span, which also distinguishes it from a line of the grid.
const LEAST_PX: f64 = 3.0;

/// A stretch of the horizontal axis that is shaded in gray over the full height, behind everything
/// else.
///
/// All spans have the same gray, since a figure uses them for a single purpose. They do not widen
/// the axis. Only the part within the axis is drawn, and a span with ends that are not finite is
/// not drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Span {
    /// Its name in the legend, which shows each name once.
    pub name: String,
    /// Its start in units of the axis.
    pub from: f64,
    /// Its end in units of the axis.
    pub to: f64,
}

impl Span {
    /// Its lower and upper end on an axis, which may be beyond the axis; `None` if no part of it is
    /// visible.
    pub(crate) fn ends(&self, scale: Scale) -> Option<(f64, f64)> {
        let finite = |x| AxisPlace::of(x).and_then(AxisPlace::finite);
        let (from, to) = (finite(self.from)?, finite(self.to)?);
        let (low, high) = (from.min(to), from.max(to));
        (low <= scale.high && high >= scale.low).then_some((low, high))
    }

    pub(crate) fn key(&self) -> (&str, Key) {
        (self.name.as_str(), Key::Span)
    }
}

/// Shades a plot area between two horizontal positions. A span too narrow to be visible is widened.
pub(crate) fn draw(drawing: &mut Drawing, plot: Rect, (from_px, to_px): (f64, f64)) {
    let middle = from_px.midpoint(to_px);
    let left = from_px.min(middle - LEAST_PX / 2.0).clamp(plot.left, plot.right - LEAST_PX);
    let right = to_px.max(middle + LEAST_PX / 2.0).clamp(plot.left + LEAST_PX, plot.right);
    drawing.area(Rect { left, right, ..plot }.corners().to_vec(), SPAN);
}
