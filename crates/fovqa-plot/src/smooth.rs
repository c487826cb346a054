//! Where markers stand along a curve that is a function sampled densely: they name the curve, and
//! its points are no data of their own.

use crate::drawing::Point;
use crate::look::Look;

/// From a marker to the next.
const PITCH_PX: f64 = 64.0;
/// Where between two steps the markers of the looks of one turn of the palette stand, as shares: a
/// marker is no wider than an eighth, and those of the first few looks are farther apart.
const PHASES: [f64; 7] = [0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375];
/// How much farther along those of every other turn stand.
const TURN_PHASE: f64 = 0.0625;

/// The places of markers along a part of a curve.
///
/// They stand at level steps of the plot area, which begins at `left_px`, so that those of two
/// curves on each other keep their distance, however the curves came there. Where a curve is so
/// steep that they would be far apart, others stand between them.
pub(crate) fn markers(piece: &[Point], left_px: f64, look: Look) -> Vec<Point> {
    let phase = PHASES[look.index % PHASES.len()] + (look.turn() % 2) as f64 * TURN_PHASE;
    let stops = steps(piece, left_px + phase * PITCH_PX);
    let total = length(piece);
    let mut all = stops.clone();
    for (from, to) in [0.0].iter().chain(&stops).zip(stops.iter().chain([&total])) {
        let room = ((to - from) / PITCH_PX).floor();
        all.extend((1..room as usize).map(|i| from + (to - from) * i as f64 / room));
    }
    if all.is_empty() {
        all.push(total / 2.0);
    }
    all.sort_by(f64::total_cmp);
    all.into_iter().filter_map(|along| place(piece, along)).collect()
}

/// How far along a curve it crosses each step of the plot area.
fn steps(piece: &[Point], origin_px: f64) -> Vec<f64> {
    let mut found = Vec::new();
    let mut done = 0.0;
    for ends in piece.windows(2) {
        let (from, to) = ((ends[0].0 - origin_px) / PITCH_PX, (ends[1].0 - origin_px) / PITCH_PX);
        let length = length(ends);
        let along = |step: i64| done + length * (step as f64 - from) / (to - from);
        // The end of a piece is the beginning of the next.
        if from < to {
            found.extend((from.ceil() as i64..to.ceil() as i64).map(along));
        } else {
            found.extend((to.floor() as i64 + 1..=from.floor() as i64).rev().map(along));
        }
        done += length;
    }
    found
}

fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|ends| (ends[1].0 - ends[0].0).hypot(ends[1].1 - ends[0].1)).sum()
}

/// The place so far along a line.
fn place(line: &[Point], along: f64) -> Option<Point> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(curve: impl Fn(f64) -> f64) -> Vec<Point> {
        (0..=400).map(|x| (50.0 + f64::from(x), curve(f64::from(x)))).collect()
    }

    fn all(curve: &[Point], look: usize) -> Vec<Point> {
        markers(curve, 50.0, Look::new(look))
    }

    #[test]
    fn stand_apart_along_a_curve() {
        for curve in
            [sampled(|_| 100.0), sampled(|x| 200.0 - x / 2.0), sampled(|x| 9e3 / (x + 40.0))]
        {
            for look in 0..14 {
                let found = all(&curve, look);
                assert!((5..=12).contains(&found.len()), "{}", found.len());
                for pair in found.windows(2) {
                    let apart = (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
                    assert!((50.0..=130.0).contains(&apart), "{apart}");
                }
            }
        }
    }

    #[test]
    fn of_curves_on_each_other_do_not_hide_each_other() {
        // One comes from high above, one is level all along.
        let level = sampled(|_| 100.0);
        let falling = sampled(|x| 100.0 - (150.0 - x).max(0.0));
        for (a, b) in (0..7).flat_map(|a| (0..a).map(move |b| (a, b))) {
            for (x, y) in all(&level, a) {
                let near = |p: &Point| (p.0 - x).hypot(p.1 - y) < 7.9;
                assert!(!all(&falling, b).iter().any(near), "{a} and {b}");
            }
        }
    }

    #[test]
    fn every_curve_has_one() {
        assert_eq!(all(&[(60.0, 5.0), (70.0, 5.0)], 0), [(65.0, 5.0)]);
        assert_eq!(all(&[(60.0, 0.0), (60.0, 150.0)], 0), [(60.0, 75.0)]);
        assert_eq!(all(&[(400.0, 5.0), (100.0, 5.0)], 0).len(), 5, "backwards");
    }
}
