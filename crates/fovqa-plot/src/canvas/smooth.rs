//! The markers along a curve that is a densely sampled function. They identify the curve; its
//! points are not single data values.

use crate::canvas::drawing::{Point, Rect};
use crate::canvas::look::Look;
use crate::canvas::path::{length, place};

/// Distance between two markers.
const PITCH_PX: f64 = 64.0;
/// The positions of the markers between two steps, as shares, for the looks of one turn of the
/// palette. A marker is no wider than an eighth of a step, and markers of the first few looks are
/// farther apart.
const PHASES: [f64; 7] = [0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375];
/// The additional offset of the markers in every second turn.
const TURN_PHASE: f64 = 0.0625;

/// The positions of markers along a part of a curve in a plot area.
///
/// They are at fixed horizontal steps where the curve is rather flat, and at fixed vertical steps
/// where it is rather steep. Curves that coincide have the same steps, however they got there, so
/// that their markers keep their distances.
pub(crate) fn markers(piece: &[Point], plot: Rect, look: Look) -> Vec<Point> {
    let phase = PHASES[look.index % PHASES.len()] + (look.turn() % 2) as f64 * TURN_PHASE;
    let origin = (plot.left + phase * PITCH_PX, plot.top + phase * PITCH_PX);
    let mut stops: Vec<f64> = Vec::new();
    let mut done = 0.0;
    for ends in piece.windows(2) {
        let length = length(ends);
        for share in steps(ends[0], ends[1], origin) {
            let stop = done + length * share;
            // Leaves out a marker too close to the one before, where the curve turns from flat to
            // steep.
            if stops.last().is_none_or(|last| stop - last > PITCH_PX / 2.0) {
                stops.push(stop);
            }
        }
        done += length;
    }
    if stops.is_empty() {
        stops.push(done / 2.0);
    }
    stops.into_iter().filter_map(|along| place(piece, along)).collect()
}

/// The positions at which a straight line crosses steps, as shares of the line. Its end belongs to
/// the next line.
fn steps(a: Point, b: Point, origin: Point) -> Vec<f64> {
    let level = (b.0 - a.0).abs() >= (b.1 - a.1).abs();
    let (from, to) =
        if level { (a.0 - origin.0, b.0 - origin.0) } else { (a.1 - origin.1, b.1 - origin.1) };
    let (from, to) = (from / PITCH_PX, to / PITCH_PX);
    let share = |step: i64| (step as f64 - from) / (to - from);
    if from < to {
        (from.ceil() as i64..to.ceil() as i64).map(share).collect()
    } else {
        (to.floor() as i64 + 1..=from.floor() as i64).rev().map(share).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(curve: impl Fn(f64) -> f64) -> Vec<Point> {
        (0..=400).map(|x| (50.0 + f64::from(x), curve(f64::from(x)))).collect()
    }

    fn all(curve: &[Point], look: usize) -> Vec<Point> {
        let plot = Rect { left: 50.0, top: 0.0, right: 450.0, bottom: 300.0 };
        markers(curve, plot, Look::new(look))
    }

    #[test]
    fn markers_keep_their_distance_along_a_curve() {
        for curve in
            [sampled(|_| 100.0), sampled(|x| 200.0 - x / 2.0), sampled(|x| 9e3 / (x + 40.0))]
        {
            for look in 0..14 {
                let found = all(&curve, look);
                assert!((5..=12).contains(&found.len()), "{}", found.len());
                for pair in found.windows(2) {
                    let apart = (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
                    assert!((32.0..=128.0).contains(&apart), "{apart}");
                }
            }
        }
    }

    #[test]
    fn of_curves_on_each_other_do_not_hide_each_other() {
        // One line comes from far above, the other from far below.
        let pairs = [
            (sampled(|_| 100.0), sampled(|x| 100.0 - (150.0 - x).max(0.0))),
            (sampled(|x| x * 3.0), sampled(|x| x.max(30.0) * 3.0)),
        ];
        for (a, b) in (0..7).flat_map(|a| (0..a).map(move |b| (a, b))) {
            for (one, other) in &pairs {
                for (x, y) in all(one, a) {
                    let near = |p: &Point| (p.0 - x).hypot(p.1 - y) < 7.9;
                    assert!(!all(other, b).iter().any(near), "{a} and {b}");
                }
            }
        }
    }

    #[test]
    fn every_curve_has_one() {
        assert_eq!(all(&[(60.0, 5.0), (70.0, 5.0)], 0), [(65.0, 5.0)]);
        assert_eq!(all(&[(60.0, 200.0), (60.0, 150.0)], 0), [(60.0, 192.0)], "steep");
        assert_eq!(all(&[(400.0, 5.0), (100.0, 5.0)], 0).len(), 5, "backwards");
    }
}
