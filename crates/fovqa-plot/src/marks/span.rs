//! Shaded stretches behind the curves of a chart, such as the frames of a saccade.

use crate::canvas::drawing::{Drawing, Rect};
use crate::canvas::look::SPAN;
use crate::marks::legend::Key;
use crate::scales::scale::{AxisPlace, Scale};

/// The narrowest span that is still seen, and not taken for a line of the grid.
const LEAST_PX: f64 = 3.0;

/// A stretch of the horizontal axis, shaded in gray over the full height behind all else.
///
/// All spans have the same gray: a figure says one thing with them. They do not widen the axis; of
/// a span the part within it is drawn, and none at ends that are not finite.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Span {
    /// Its name in the legend, which shows each name once.
    pub name: String,
    /// Where it begins, in units of the axis.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl Span {
    /// Its lower and upper end on an axis, which it may reach beyond; none where nothing of it is
    /// to be seen.
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

/// Shades a plot area from one place along it to another, widened where that would not be seen.
pub(crate) fn draw(drawing: &mut Drawing, plot: Rect, (from_px, to_px): (f64, f64)) {
    let middle = from_px.midpoint(to_px);
    let left = from_px.min(middle - LEAST_PX / 2.0).clamp(plot.left, plot.right - LEAST_PX);
    let right = to_px.max(middle + LEAST_PX / 2.0).clamp(plot.left + LEAST_PX, plot.right);
    drawing.area(Rect { left, right, ..plot }.corners().to_vec(), SPAN);
}
