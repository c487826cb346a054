//! Rings of equal eccentricity, as lines in a frame.
//!
//! With angular eccentricity, a ring is where a cone around the gaze ray meets the image plane; with
//! planar eccentricity it is an ellipse around the gaze. Both are conic sections, traced in
//! homogeneous pixel coordinates: h(t) = centre + cosine cos t + sine sin t.

use std::f64::consts::TAU;

use crate::eccentricity::{Eccentricity, EccentricityKind};

/// How far the lines go beyond the frame, in pixels. The end of a line with a width is then outside.
const MARGIN_PX: f64 = 16.0;

/// The largest distance of a line from the ring between two of its points, in pixels.
const TOLERANCE_PX: f64 = 0.05;

/// The smallest number of parts of a line.
const LEAST_PARTS: usize = 8;

/// The largest number of times that each of them is halved.
const MOST_HALVINGS: usize = 12;

/// The homogeneous coordinates X, Y, W of a point in pixels: x = X / W and y = Y / W. A direction
/// with W of 0 or less points away from the image plane.
type Homogeneous = [f64; 3];

/// A conic section in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Conic {
    centre: Homogeneous,
    cosine: Homogeneous,
    sine: Homogeneous,
}

impl Eccentricity {
    /// The lines on which the eccentricity is `deg`, in pixels, x to the right and y down. They end
    /// in a margin of 16 pixels around the frame; a line that ends where it starts is closed. Each
    /// point has the eccentricity within 1e-6°, and between two points a line is within a tenth of
    /// a pixel of the ring. There are no lines if no pixel of the frame or of its margin can have
    /// the eccentricity.
    pub fn ring(&self, deg: f64) -> Vec<Vec<[f64; 2]>> {
        let Some(conic) = self.conic(deg) else { return Vec::new() };
        let (width, height) = (self.view().width as f64, self.view().height as f64);
        let sides = [
            // In front of the eye, and within each side of the margin.
            [0.0, 0.0, 1.0],
            [1.0, 0.0, MARGIN_PX],
            [-1.0, 0.0, width + MARGIN_PX],
            [0.0, 1.0, MARGIN_PX],
            [0.0, -1.0, height + MARGIN_PX],
        ];
        conic.arcs(&sides).into_iter().map(|arc| conic.line(arc)).collect()
    }

    /// The conic on which the eccentricity is `deg`. At t = 0 it is to the right of the gaze.
    fn conic(&self, deg: f64) -> Option<Conic> {
        let [gx, gy] = self.gaze_px();
        match self.kind() {
            EccentricityKind::Planar => {
                let [rx, ry] = self.planar_radii_px(deg)?;
                Some(Conic { centre: [gx, gy, 1.0], cosine: [rx, 0.0, 0.0], sine: [0.0, ry, 0.0] })
            }
            EccentricityKind::Angular if deg > 0.0 && deg < 180.0 => {
                let ([fx, fy], [cx, cy]) = (self.view().focal_px, self.view().principal_px);
                let gaze = unit([(gx - cx) / fx, (gy - cy) / fy, 1.0]);
                // Orthogonal to the gaze, to the right and then down.
                let right = unit([gaze[2], 0.0, -gaze[0]]);
                let down = cross(gaze, right);
                let (sine, cosine) = libm::sincos(deg.to_radians());
                let projected = |[x, y, z]: [f64; 3], by: f64| {
                    [(x * fx + z * cx) * by, (y * fy + z * cy) * by, z * by]
                };
                Some(Conic {
                    centre: projected(gaze, cosine),
                    cosine: projected(right, sine),
                    sine: projected(down, sine),
                })
            }
            EccentricityKind::Angular => None,
        }
    }
}

impl Conic {
    fn at(&self, t: f64) -> Homogeneous {
        let (sine, cosine) = libm::sincos(t);
        std::array::from_fn(|i| self.centre[i] + self.cosine[i] * cosine + self.sine[i] * sine)
    }

    fn point(&self, t: f64) -> [f64; 2] {
        let [x, y, w] = self.at(t);
        [x / w, y / w]
    }

    /// The parts of the conic on the inner side of all lines, as ranges of t. A line [a, b, c] has a
    /// point on its inner side if a X + b Y + c W > 0.
    fn arcs(&self, sides: &[Homogeneous]) -> Vec<(f64, f64)> {
        let crossings = sides.iter().flat_map(|side| self.crossings(*side));
        let mut crossings: Vec<f64> = crossings.map(|t| t.rem_euclid(TAU)).collect();
        crossings.sort_by(f64::total_cmp);
        let is_inside = |t: f64| {
            let at = self.at(t);
            sides.iter().all(|side| dot(*side, at) > 0.0)
        };
        let Some(&first) = crossings.first() else {
            return if is_inside(0.0) { vec![(0.0, TAU)] } else { Vec::new() };
        };
        let ends = crossings.iter().skip(1).copied().chain([first + TAU]);
        let parts: Vec<(f64, f64, bool)> = crossings
            .iter()
            .zip(ends)
            .map(|(&from, to)| (from, to, is_inside(f64::midpoint(from, to))))
            .collect();
        let Some(outside) = parts.iter().position(|(.., inside)| !inside) else {
            return vec![(0.0, TAU)];
        };
        // From a part outside on, so that no arc goes over the end of the list.
        let around = parts.iter().map(|(from, to, inside)| (from + TAU, to + TAU, *inside));
        let around = parts.iter().copied().skip(outside).chain(around.take(outside));
        let mut arcs: Vec<(f64, f64)> = Vec::new();
        let mut goes_on = false;
        for (from, to, inside) in around {
            match arcs.last_mut() {
                // A line that is only touched does not interrupt an arc.
                Some(arc) if inside && goes_on => arc.1 = to,
                _ if inside => arcs.push((from, to)),
                _ => {}
            }
            goes_on = inside;
        }
        arcs
    }

    /// Where the conic crosses a line: up to two values of t.
    fn crossings(&self, side: Homogeneous) -> Vec<f64> {
        let [level, cosine, sine] =
            [self.centre, self.cosine, self.sine].map(|part| dot(side, part));
        // level + cosine cos t + sine sin t = 0
        let reach = libm::hypot(cosine, sine);
        if level.abs() >= reach {
            return Vec::new();
        }
        let (middle, half) = (libm::atan2(sine, cosine), libm::acos(-level / reach));
        vec![middle - half, middle + half]
    }

    /// The line along an arc.
    fn line(&self, (from, to): (f64, f64)) -> Vec<[f64; 2]> {
        let part = |i: usize| from + (to - from) * (i as f64 / LEAST_PARTS as f64);
        let mut points = vec![self.point(from)];
        for i in 0..LEAST_PARTS {
            self.extend(&mut points, (part(i), part(i + 1)), MOST_HALVINGS);
        }
        if to - from >= TAU {
            // A closed line ends exactly where it starts.
            let first = points[0];
            points.pop();
            points.push(first);
        }
        points
    }

    /// Adds the points of a part after its start.
    fn extend(&self, points: &mut Vec<[f64; 2]>, (from, to): (f64, f64), halvings: usize) {
        let middle = f64::midpoint(from, to);
        let (a, m, b) = (self.point(from), self.point(middle), self.point(to));
        let (chord, offset) = ([b[0] - a[0], b[1] - a[1]], [m[0] - a[0], m[1] - a[1]]);
        let length = libm::hypot(chord[0], chord[1]);
        let distance = if length > 0.0 {
            (chord[0] * offset[1] - chord[1] * offset[0]).abs() / length
        } else {
            libm::hypot(offset[0], offset[1])
        };
        if halvings == 0 || distance <= TOLERANCE_PX {
            points.push(b);
            return;
        }
        self.extend(points, (from, middle), halvings - 1);
        self.extend(points, (middle, to), halvings - 1);
    }
}

fn dot(a: Homogeneous, b: Homogeneous) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction of length 1.
fn unit(direction: [f64; 3]) -> [f64; 3] {
    let length = dot(direction, direction).sqrt();
    direction.map(|part| part / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bands::{BandEdges, BandMap};
    use crate::view::{View, ViewSpec};
    use proptest::prelude::*;

    const KINDS: [EccentricityKind; 2] = [EccentricityKind::Angular, EccentricityKind::Planar];

    fn view(width: usize, height: usize, focal_px: [f64; 2]) -> View {
        let principal_px = [0.45 * width as f64, 0.6 * height as f64];
        View { width, height, focal_px, principal_px }
    }

    fn in_margin(view: &View, [x, y]: [f64; 2]) -> bool {
        let within = |at: f64, side: usize| {
            (-MARGIN_PX - 1e-6..=side as f64 + MARGIN_PX + 1e-6).contains(&at)
        };
        within(x, view.width) && within(y, view.height)
    }

    /// Checks the points of a ring, and the points half the way between them.
    fn check(eccentricity: &Eccentricity, deg: f64) -> Vec<Vec<[f64; 2]>> {
        let lines = eccentricity.ring(deg);
        for line in &lines {
            assert!(line.len() > 1);
            for at @ [x, y] in line {
                assert!(in_margin(eccentricity.view(), *at), "{at:?}");
                assert!((eccentricity.at_deg(*x, *y) - deg).abs() < 1e-6, "{at:?} for {deg}");
            }
            for ends in line.windows(2) {
                let at: [f64; 2] = std::array::from_fn(|i| f64::midpoint(ends[0][i], ends[1][i]));
                let around = |by: [f64; 2]| eccentricity.at_deg(at[0] + by[0], at[1] + by[1]);
                let slope = libm::hypot(
                    around([0.01, 0.0]) - around([-0.01, 0.0]),
                    around([0.0, 0.01]) - around([0.0, -0.01]),
                ) / 0.02;
                let distance_px = (around([0.0, 0.0]) - deg).abs() / slope;
                assert!(distance_px < 0.1, "{distance_px} px at {at:?} for {deg}");
            }
        }
        lines
    }

    #[test]
    fn a_ring_is_closed_or_ends_beyond_the_frame() {
        let square = view(640, 480, [300.0, 300.0]);
        let rings = |gaze, kind, deg| check(&Eccentricity::new(square, gaze, kind), deg);
        for kind in KINDS {
            let whole = rings([288.0, 288.0], kind, 20.0);
            assert_eq!((whole.len(), whole[0].first()), (1, whole[0].last()), "{kind:?}");
            // Around the principal point, both kinds are circles.
            let radius = 300.0 * libm::tan(20f64.to_radians());
            assert!((whole[0][0][0] - (288.0 + radius)).abs() < 1e-9, "from the right");
            let cut = rings([620.0, 470.0], kind, 20.0);
            assert_eq!(cut.len(), 1, "{kind:?}");
            for end in [cut[0][0], cut[0][cut[0].len() - 1]] {
                assert!(end[0] > 640.0 || end[1] > 480.0, "{end:?}");
            }
            assert!(rings([288.0, 288.0], kind, 0.0).is_empty());
            assert!(rings([288.0, 288.0], kind, 89.9).is_empty());
            assert!(rings([288.0, 288.0], kind, 180.0).is_empty());
            // Both sides of the frame, but not above and below it.
            assert_eq!(rings([288.0, 240.0], kind, 44.0).len(), 2, "{kind:?}");
        }
        // Behind the eye for half of its directions, and seen on one side only.
        assert_eq!(rings([-900.0, 288.0], EccentricityKind::Angular, 75.0).len(), 1);
        assert!(rings([-900.0, 288.0], EccentricityKind::Angular, 150.0).is_empty());
    }

    /// The rings are where the bands change: along each row, between the centres of the same pixels.
    #[test]
    fn bands_change_at_their_rings() {
        let view = view(97, 83, [60.0, 45.0]);
        for (kind, gaze) in KINDS
            .into_iter()
            .flat_map(|kind| [[43.0, 50.0], [90.0, 3.0], [-30.0, 40.0]].map(|gaze| (kind, gaze)))
        {
            let eccentricity = Eccentricity::new(view, gaze, kind);
            let edges: Vec<f64> = (0..=17).map(|i| 5.0 * f64::from(i)).collect();
            let bands = BandMap::new(&eccentricity, &BandEdges::new(edges.clone()).unwrap());
            let rings: Vec<_> = edges.iter().flat_map(|deg| check(&eccentricity, *deg)).collect();
            let parts = || rings.iter().flat_map(|line| line.windows(2));
            for y in 0..view.height {
                let row = y as f64 + 0.5;
                let changes: Vec<f64> =
                    bands.row(y).iter().rev().skip(1).map(|run| f64::from(run.end)).collect();
                // A ring passes between the centres of the two pixels, which are one pixel apart.
                for change in &changes {
                    let found = parts().any(|ends| distance(ends, [*change, row]) < 0.6);
                    assert!(found, "{kind:?} {gaze:?}: a change at {change} {row}");
                }
                for ends in parts() {
                    let (a, b) = (ends[0], ends[1]);
                    let x = a[0] + (b[0] - a[0]) * (row - a[1]) / (b[1] - a[1]);
                    // A ring that is nearly level may pass between two centres twice.
                    let is_steep = (b[1] - a[1]).abs() > 0.5 * (b[0] - a[0]).abs();
                    if is_steep && (a[1] > row) != (b[1] > row) && (1.0..=96.0).contains(&x) {
                        let found = changes.iter().any(|change| (change - x).abs() < 0.8);
                        assert!(found, "{kind:?} {gaze:?}: a ring at {x} {row}");
                    }
                }
            }
        }
    }

    /// The distance of a point from a part of a line.
    fn distance(ends: &[[f64; 2]], at: [f64; 2]) -> f64 {
        let (a, b) = (ends[0], ends[1]);
        let (part, to) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
        let share = (part[0] * to[0] + part[1] * to[1]) / (part[0] * part[0] + part[1] * part[1]);
        let share = share.clamp(0.0, 1.0);
        (to[0] - share * part[0]).hypot(to[1] - share * part[1])
    }

    proptest! {
        #[test]
        fn every_point_has_the_eccentricity(
            fov in 10.0..160.0f64, aspect in 0.5..2.0f64,
            gx in -500.0..1500.0f64, gy in -500.0..1200.0f64, deg in 0.01..179.0f64,
        ) {
            let spec = ViewSpec::Fov { horizontal_deg: Some(fov), vertical_deg: None };
            let mut view = spec.resolve(900, 700).unwrap().view;
            view.focal_px[1] *= aspect;
            for kind in KINDS {
                check(&Eccentricity::new(view, [gx, gy], kind), deg);
                // A ring through a point of the frame is found there.
                let eccentricity = Eccentricity::new(view, [gx, gy], kind);
                let through = eccentricity.at_deg(600.0, 200.0);
                let near = |at: &[f64; 2]| (at[0] - 600.0).hypot(at[1] - 200.0) < 150.0;
                prop_assert!(check(&eccentricity, through).iter().flatten().any(near));
            }
        }

        #[test]
        fn a_scaled_frame_has_scaled_rings(gx in -50.0..150.0f64, deg in 1.0..80.0f64) {
            for kind in KINDS {
                let eccentricity = Eccentricity::new(view(120, 90, [70.0, 50.0]), [gx, 30.0], kind);
                check(&eccentricity.scaled((60, 30), [0.5, 1.0 / 3.0]), deg);
            }
        }
    }
}
