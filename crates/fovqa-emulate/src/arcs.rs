//! How many samples of a circle around the gaze are in the frame, without looking at each of them.

use std::f64::consts::TAU;

use fovqa_methods::Setting;

/// Distances from the gaze to the right, lower, left and upper side of a rectangle in pixels: in the order
/// of directions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sides([f64; 4]);

impl Sides {
    /// Those of the frame.
    pub(crate) fn of_frame(setting: &Setting) -> Self {
        let ([gx, gy], [width, height]) = (setting.gaze_px(), setting.size_px());
        Self([width - gx, height - gy, gx, gy])
    }

    /// Of `n` samples on a circle, in the directions (j + 0.5) / n of a turn, how many are inside. Rounding
    /// decides on samples on a side itself.
    pub(crate) fn count_inside(&self, radius_px: f64, n: usize) -> usize {
        // Beyond a side is an arc of the circle, centred at the side's own direction; its half in turns.
        let beyond = |side: f64| {
            if radius_px > side { libm::acos(side / radius_px) / TAU } else { 0.0 }
        };
        let beyond = self.0.map(beyond);
        let count = n as f64;
        let before = |turn: f64| (turn * count - 0.5).ceil().clamp(0.0, count) as usize;
        let in_quarter = |quarter: usize| {
            let turn = quarter as f64 / 4.0;
            let from = before(turn + beyond[quarter]);
            before(turn + 0.25 - beyond[(quarter + 1) % 4]).saturating_sub(from)
        };
        (0..4).map(in_quarter).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_are_found_one_by_one() {
        for sides_px in
            [[40.0, 30.0, 24.0, 18.5], [64.0, 24.0, 1e-3, 24.0], [1e-3, 1e-3, 64.0, 48.0], [9.0; 4]]
        {
            for radius_px in [0.3, 8.0, 9.5, 20.1, 31.0, 39.7, 45.3, 52.0, 79.0, 90.0] {
                for n in [1, 2, 3, 17, 100, 1001] {
                    let inside = |j: &usize| {
                        let (sin, cos) = (TAU * (*j as f64 + 0.5) / n as f64).sin_cos();
                        let [right, lower, left, upper] = sides_px;
                        (-left..right).contains(&(radius_px * cos))
                            && (-upper..lower).contains(&(radius_px * sin))
                    };
                    let expected = (0..n).filter(inside).count();
                    let found = Sides(sides_px).count_inside(radius_px, n);
                    assert_eq!(found, expected, "{sides_px:?} {radius_px} {n}");
                }
            }
        }
    }
}
