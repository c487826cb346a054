//! Flat patterns that turn about the centre of the frame by 10° in each frame, as in Fig. 12 of RMFR,
//! and stripes, as in its Figs. 4 and 7. The paper prints no formulas: the patterns are ours, of the
//! same kinds.

use fovqa_vision::View;

use crate::frame_scene::{FrameScene, Surface};

/// A pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pattern {
    A,
    B,
    C,
    /// Stripes stand still.
    Stripes,
}

/// Degrees by which a pattern turns in each frame.
const STEP_DEG: f64 = 10.0;

/// A pattern that turns.
#[derive(Debug)]
pub(crate) struct Turning {
    pattern: Pattern,
    view: View,
}

impl Turning {
    pub(crate) fn new(pattern: Pattern, view: View) -> Self {
        Self { pattern, view }
    }

    pub(crate) fn frame(&self, frame: usize) -> TurningFrame<'_> {
        let turn = |steps: f64| {
            if self.pattern == Pattern::Stripes {
                (1.0, 0.0)
            } else {
                let angle = (steps * STEP_DEG).to_radians();
                (libm::cos(angle), libm::sin(angle))
            }
        };
        TurningFrame { of: self, turn: turn((frame % 36) as f64), step: turn(1.0) }
    }
}

/// A frame of a pattern.
#[derive(Debug)]
pub(crate) struct TurningFrame<'a> {
    of: &'a Turning,
    /// Cosine and sine of the angle of this frame.
    turn: (f64, f64),
    /// Those of one step.
    step: (f64, f64),
}

impl TurningFrame<'_> {
    /// A position relative to the centre, in half heights of the frame.
    fn place(&self, x: f64, y: f64) -> [f64; 2] {
        let View { width, height, .. } = self.of.view;
        let half = height as f64 / 2.0;
        [(x - width as f64 / 2.0) / half, (y - half) / half]
    }
}

fn turned([x, y]: [f64; 2], (cos, sin): (f64, f64)) -> [f64; 2] {
    [x * cos + y * sin, y * cos - x * sin]
}

impl FrameScene for TurningFrame<'_> {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        let place = self.place(x, y);
        let [u, v] = turned(place, self.turn);
        let half = self.of.view.height as f64 / 2.0;
        let odd = |value: f64| (value.floor() as i64).rem_euclid(2) == 1;
        let r = (u * u + v * v).sqrt();
        let inked = match self.of.pattern {
            Pattern::A => {
                let spokes = libm::atan2(v, u) * 18.0 / std::f64::consts::PI;
                odd(r * 12.0) != odd(spokes)
            }
            Pattern::B => {
                let squares = if r < 0.35 {
                    24.0
                } else if r < 0.8 {
                    12.0
                } else {
                    30.0
                };
                odd(u * squares) != odd(v * squares)
            }
            Pattern::C => {
                let sector = (libm::atan2(v, u) / std::f64::consts::PI * 4.0).floor();
                let along = if odd(sector) { u } else { v };
                odd(along * (10.0 + 6.0 * (sector + 4.0)))
            }
            // Eight pixels wide across the upper half, and high across the lower one.
            Pattern::Stripes => odd(if v < 0.0 { u * half / 8.0 } else { v * half / 8.0 }),
        };
        if inked { [0.04, 0.04, 0.05] } else { [0.86, 0.85, 0.82] }
    }

    fn surface(&self, x: f64, y: f64) -> Surface {
        let place = self.place(x, y);
        let (cos, sin) = self.step;
        let [u, v] = turned(place, (cos, sin));
        let half = self.of.view.height as f64 / 2.0;
        Surface { depth_m: 1.0, motion_px: Some([(u - place[0]) * half, (v - place[1]) * half]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_keeps_its_colour_as_the_pattern_turns() {
        let view =
            View { width: 300, height: 200, focal_px: [100.0; 2], principal_px: [150.0, 100.0] };
        for pattern in [Pattern::A, Pattern::B, Pattern::C, Pattern::Stripes] {
            let turning = Turning::new(pattern, view);
            let (now, then) = (turning.frame(5), turning.frame(4));
            let (mut same, mut dark) = (0, 0);
            for i in 0..2000 {
                let (x, y) = (f64::from(i % 50) * 6.0 + 1.3, f64::from(i / 50) * 5.0 + 0.7);
                let [dx, dy] = now.surface(x, y).motion_px.unwrap();
                let [now, then] =
                    [now.light(x, y), then.light(x + dx, y + dy)].map(|light| light[0] < 0.1);
                same += usize::from(now == then);
                dark += usize::from(now);
            }
            // Rounding decides at edges.
            assert!(same > 1990, "{pattern:?} {same}");
            assert!((600..1400).contains(&dark), "{pattern:?} {dark}");
        }
    }
}
