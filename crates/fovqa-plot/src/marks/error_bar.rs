//! Error bars: an upright line with two caps, from the lower to the upper end of an interval.

use crate::canvas::colour::Colour;
use crate::canvas::drawing::{Drawing, Stroke};

/// Width of the line.
const LINE_PX: f64 = 1.0;
/// Half the length of a cap.
pub(crate) const CAP_PX: f64 = 3.0;

/// Draws an error bar at a horizontal position, between two vertical positions.
pub(crate) fn draw(drawing: &mut Drawing, x: f64, (low, high): (f64, f64), colour: Colour) {
    let stroke = Stroke { colour, width_px: LINE_PX };
    drawing.line(&[(x, low), (x, high)], stroke);
    for y in [low, high] {
        drawing.line(&[(x - CAP_PX, y), (x + CAP_PX, y)], stroke);
    }
}
