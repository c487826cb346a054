//! The borders between the layers or rates of a method, as lines on the frame.

use std::f64::consts::TAU;
use std::ops::Range;

/// A line of points in pixels of the frame. A border is closed: its last point is its first one.
pub type Border = Vec<[f64; 2]>;

/// Number of sides of the polygon that stands for a circle.
const SIDES: usize = 128;

/// The border of a box of whole pixels.
pub(crate) fn box_of([xs, ys]: [&Range<usize>; 2]) -> Border {
    let [left, right, top, bottom] = [xs.start, xs.end, ys.start, ys.end].map(|at| at as f64);
    vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]]
}

/// A circle; `None` if it has no finite radius.
pub(crate) fn circle([x, y]: [f64; 2], radius_px: f64) -> Option<Border> {
    let point = |side: usize| {
        let angle = TAU * (side % SIDES) as f64 / SIDES as f64;
        [x + radius_px * libm::cos(angle), y + radius_px * libm::sin(angle)]
    };
    radius_px.is_finite().then(|| (0..=SIDES).map(point).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_closed_and_lie_where_they_should() {
        let rectangle = box_of([&(2..5), &(1..9)]);
        assert_eq!(rectangle, [[2.0, 1.0], [5.0, 1.0], [5.0, 9.0], [2.0, 9.0], [2.0, 1.0]]);
        let circle = circle([3.0, 4.0], 2.0).unwrap();
        assert_eq!(circle.first(), circle.last());
        for [x, y] in circle {
            assert!((libm::hypot(x - 3.0, y - 4.0) - 2.0).abs() < 1e-12);
        }
        assert_eq!(super::circle([0.0; 2], f64::INFINITY), None);
    }
}
