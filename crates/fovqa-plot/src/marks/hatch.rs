//! Parallel lines within an area, which tell fills apart in print without colour.

use crate::canvas::drawing::{Drawing, Point, Stroke};
use crate::canvas::look::Hatch;

/// A line shorter than this is not visible.
const LEAST_PX: f64 = 0.45;

/// The direction of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Rising,
    Falling,
    Level,
    Upright,
}

/// Draws a hatch over an area.
pub(crate) fn draw(
    drawing: &mut Drawing,
    corners: &[Point],
    hatch: Hatch,
    (pitch_px, stroke): (f64, Stroke),
) {
    let directions: &[Direction] = match hatch {
        Hatch::Plain => &[],
        Hatch::Rising => &[Direction::Rising],
        Hatch::Falling => &[Direction::Falling],
        Hatch::Level => &[Direction::Level],
        Hatch::Upright => &[Direction::Upright],
        Hatch::Crossed => &[Direction::Rising, Direction::Falling],
        Hatch::Grid => &[Direction::Level, Direction::Upright],
    };
    for line in directions.iter().flat_map(|direction| lines(corners, *direction, pitch_px)) {
        drawing.line(&line, stroke);
    }
}

/// Lines within an area at a distance along the axes. Their positions are the same in the whole
/// picture, so that two adjacent areas look like one.
pub(crate) fn lines(corners: &[Point], direction: Direction, pitch_px: f64) -> Vec<[Point; 2]> {
    let along = |(x, y): Point| {
        let across = match direction {
            Direction::Rising => x + y,
            Direction::Falling => x - y,
            Direction::Level => y,
            Direction::Upright => x,
        };
        across / pitch_px
    };
    let (first, last) =
        corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
            (low.min(along(*p)), high.max(along(*p)))
        });
    if first > last {
        return Vec::new();
    }
    let line = |count: i64| {
        let off = |p: Point| along(p) - count as f64;
        let mut crossings: Vec<Point> = Vec::new();
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (before, after) = (off(*a), off(*b));
            if (before < 0.0) != (after < 0.0) {
                let share = before / (before - after);
                crossings.push((a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share));
            }
        }
        crossings.sort_by(|a, b| (a.0.total_cmp(&b.0)).then(a.1.total_cmp(&b.1)));
        let pairs = crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
        let long = |[from, to]: &[Point; 2]| (to.0 - from.0).hypot(to.1 - from.1) > LEAST_PX;
        pairs.filter(long).collect::<Vec<_>>()
    };
    (first.ceil() as i64..=last.floor() as i64).flat_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stay_within_and_keep_their_direction() {
        let triangle = [(10.0, 10.0), (90.0, 10.0), (10.0, 90.0)];
        for (direction, across) in [
            (Direction::Rising, (1.0, 1.0)),
            (Direction::Falling, (1.0, -1.0)),
            (Direction::Level, (0.0, 1.0)),
            (Direction::Upright, (1.0, 0.0)),
        ] {
            let lines = lines(&triangle, direction, 6.0);
            assert!(lines.len() > 10, "{direction:?}");
            for (x, y) in lines.concat() {
                assert!(x >= 10.0 - 1e-9 && y >= 10.0 - 1e-9 && x + y <= 100.0 + 1e-9);
                let count = (x * across.0 + y * across.1) / 6.0;
                assert!((count - count.round()).abs() < 1e-6, "{direction:?} {x} {y}");
            }
        }
        assert!(lines(&[], Direction::Rising, 6.0).is_empty());
    }
}
