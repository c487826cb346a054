//! Positions along a line of straight parts.

use crate::canvas::drawing::Point;

/// The length of a line in pixels.
pub(crate) fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|ends| (ends[1].0 - ends[0].0).hypot(ends[1].1 - ends[0].1)).sum()
}

/// The point at a distance along a line. Beyond the end of the line it is the end.
pub(crate) fn place(line: &[Point], along: f64) -> Option<Point> {
    let mut left = along;
    for ends in line.windows(2) {
        let length = length(ends);
        if left <= length {
            let share = if length > 0.0 { left / length } else { 0.0 };
            let ((x0, y0), (x1, y1)) = (ends[0], ends[1]);
            return Some((x0 + (x1 - x0) * share, y0 + (y1 - y0) * share));
        }
        left -= length;
    }
    line.last().copied()
}
