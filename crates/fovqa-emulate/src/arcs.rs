//! Which samples of a circle around the gaze stand in the frame, or so close to it that a pixel reads
//! them.

use std::f64::consts::TAU;
use std::ops::Range;

use fovqa_methods::Setting;

/// A rectangle around the gaze.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings {
    /// Distances from the gaze to the right, lower, left and upper side in pixels: in the order of
    /// directions.
    sides_px: [f64; 4],
}

impl Surroundings {
    /// The frame.
    pub(crate) fn frame(setting: &Setting) -> Self {
        let ([gx, gy], [width, height]) = (setting.gaze_px(), setting.size_px());
        Self { sides_px: [width - gx, height - gy, gx, gy] }
    }

    /// Of `n` samples on a circle, in the directions (j + 0.5) / n of a turn, those inside: up to four
    /// ranges that do not touch. Rounding decides on samples on a side itself.
    pub(crate) fn arcs(&self, radius_px: f64, n: usize) -> Vec<Range<usize>> {
        // Beyond a side there is an arc around the side's own direction.
        let beyond = self
            .sides_px
            .map(|side| if radius_px > side { libm::acos(side / radius_px) / TAU } else { 0.0 });
        let count = n as f64;
        let up_to = |turn: f64| (turn * count - 0.5).ceil().clamp(0.0, count) as usize;
        let mut arcs: Vec<Range<usize>> = Vec::with_capacity(4);
        for quarter in 0..4 {
            let turn = quarter as f64 / 4.0;
            let from = up_to(turn + beyond[quarter]);
            let to = up_to(turn + 0.25 - beyond[(quarter + 1) % 4]);
            match arcs.last_mut() {
                Some(last) if last.end == from && from < to => last.end = to,
                _ if from < to => arcs.push(from..to),
                _ => {}
            }
        }
        arcs
    }

    /// How many of the samples of a circle are inside.
    pub(crate) fn count(&self, radius_px: f64, n: usize) -> usize {
        self.arcs(radius_px, n).iter().map(ExactSizeIterator::len).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_hold_the_samples_inside_and_no_other() {
        for sides_px in
            [[40.0, 30.0, 24.0, 18.5], [64.0, 24.0, 1e-3, 24.0], [1e-3, 1e-3, 64.0, 48.0], [9.0; 4]]
        {
            let around = Surroundings { sides_px };
            for radius_px in [0.3, 8.0, 9.5, 20.1, 31.0, 39.7, 45.3, 52.0, 79.0, 90.0] {
                for n in [1, 2, 3, 17, 100, 1001] {
                    let inside = |j: &usize| {
                        let (sin, cos) = (TAU * (*j as f64 + 0.5) / n as f64).sin_cos();
                        let [right, lower, left, upper] = sides_px;
                        (-left..right).contains(&(radius_px * cos))
                            && (-upper..lower).contains(&(radius_px * sin))
                    };
                    let expected: Vec<usize> = (0..n).filter(inside).collect();
                    let found: Vec<usize> =
                        around.arcs(radius_px, n).into_iter().flatten().collect();
                    assert_eq!(found, expected, "{sides_px:?} {radius_px} {n}");
                    assert_eq!(around.count(radius_px, n), expected.len());
                }
            }
        }
    }
}
