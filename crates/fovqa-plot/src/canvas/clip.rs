//! Cuts marks off exactly at the border of the plot area, without drawing anything along the
//! border. Positions are shares of the plot area, from 0 to 1 in each direction.

use crate::canvas::drawing::Point;

/// Larger shares are reduced to this one: it is far outside, but calculations with it stay finite.
pub(crate) const FAR: f64 = 1e6;

/// The parts of a line with `y` from 0 to 1.
pub(crate) fn level(line: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = Vec::new();
    for ends in line.windows(2) {
        let seen = within(ends[0], ends[1]);
        if let Some((from, to)) = seen {
            if piece.is_empty() {
                piece.push(from);
            }
            piece.push(to);
        }
        if seen.is_none_or(|(_, to)| to != ends[1]) && !piece.is_empty() {
            pieces.push(std::mem::take(&mut piece));
        }
    }
    if !piece.is_empty() {
        pieces.push(piece);
    }
    pieces
}

/// The parts of a line with `x` from 0 to 1.
pub(crate) fn upright(line: &[Point]) -> Vec<Vec<Point>> {
    let turned = |line: &[Point]| line.iter().map(|(x, y)| (*y, *x)).collect::<Vec<Point>>();
    level(&turned(line)).iter().map(|piece| turned(piece)).collect()
}

/// The part of a straight line with `y` from 0 to 1, if it is more than one of the line's ends.
fn within(a: Point, b: Point) -> Option<(Point, Point)> {
    let (low, high) = (a.1.min(b.1), a.1.max(b.1));
    let inside = |y: f64| (0.0..=1.0).contains(&y);
    if inside(low) && inside(high) {
        return Some((a, b));
    }
    if low >= 1.0 || high <= 0.0 {
        return None;
    }
    let end = |from: Point, to: Point| {
        if inside(from.1) {
            return from;
        }
        let border = from.1.clamp(0.0, 1.0);
        (from.0 + (to.0 - from.0) * ((border - from.1) / (to.1 - from.1)), border)
    };
    Some((end(a, b), end(b, a)))
}

/// The part of an area with `x` and `y` from 0 to 1; empty if there is none.
pub(crate) fn area(corners: &[Point]) -> Vec<Point> {
    let turned = |corners: Vec<Point>| corners.into_iter().map(|(x, y)| (y, x)).collect::<Vec<_>>();
    turned(strip(&turned(strip(corners))))
}

/// The part of an area with `y` from 0 to 1.
fn strip(corners: &[Point]) -> Vec<Point> {
    let above_zero = keep(corners, 0.0, |y| y >= 0.0);
    keep(&above_zero, 1.0, |y| y <= 1.0)
}

/// The part of an area on one side of a horizontal border (Sutherland and Hodgman, 1974).
fn keep(corners: &[Point], border: f64, inside: impl Fn(f64) -> bool) -> Vec<Point> {
    let mut kept = Vec::new();
    for (i, &to) in corners.iter().enumerate() {
        let from = corners[(i + corners.len() - 1) % corners.len()];
        if inside(from.1) != inside(to.1) {
            let share = (border - from.1) / (to.1 - from.1);
            kept.push((from.0 + (to.0 - from.0) * share, border));
        }
        if inside(to.1) {
            kept.push(to);
        }
    }
    kept
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn lines_end_where_they_cross_the_border() {
        let peak = [(0.0, 0.5), (1.0, 1.5), (2.0, 0.5), (3.0, -0.5), (4.0, -0.5), (5.0, 0.5)];
        let pieces = level(&peak);
        let want = [
            vec![(0.0, 0.5), (0.5, 1.0)],
            vec![(1.5, 1.0), (2.0, 0.5), (2.5, 0.0)],
            vec![(4.5, 0.0), (5.0, 0.5)],
        ];
        assert_eq!(pieces, want);
        assert_eq!(level(&[(0.0, -1.0), (2.0, 3.0)]), [[(0.5, 0.0), (1.0, 1.0)]], "across");
    }

    #[test]
    fn lines_on_the_border_are_kept_and_touching_ones_are_not() {
        let along = [(0.0, 1.0), (1.0, 1.0)];
        assert_eq!(level(&along), [along]);
        assert!(level(&[(0.0, 2.0), (1.0, 1.0), (2.0, 2.0)]).is_empty());
        assert!(level(&[(0.0, 2.0), (1.0, 3.0)]).is_empty());
        assert!(level(&[(0.0, 0.5)]).is_empty());
    }

    #[test]
    fn areas_are_cut_on_all_sides() {
        let size = |corners: &[Point]| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<f64>().abs() / 2.0
        };
        let around = [(-1.0, -1.0), (2.0, -1.0), (2.0, 2.0), (-1.0, 2.0)];
        assert_eq!(size(&area(&around)), 1.0);
        let half = [(-FAR, 0.25), (FAR, 0.25), (FAR, 0.75), (-FAR, 0.75)];
        assert!((size(&area(&half)) - 0.5).abs() < 1e-9);
        assert!(area(&[(2.0, 0.0), (3.0, 0.0), (3.0, 1.0)]).is_empty());
    }
}
