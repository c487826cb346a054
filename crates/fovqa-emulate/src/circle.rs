//! Directions around the gaze at equal angles, many at once.

use std::f64::consts::TAU;

use crate::taps::PLACES;

/// Unit vectors in the directions (j + η) / n of a turn, [`PLACES`] at a time. Each lot is the one
/// before it, turned; of ten thousand directions rounding has added up to 1e-13.
#[derive(Debug, Clone)]
pub(crate) struct Circle {
    pub(crate) x: [f64; PLACES],
    pub(crate) y: [f64; PLACES],
    /// Cosine and sine of the turn from lot to lot.
    turn: [f64; 2],
}

impl Circle {
    /// From direction `first` of `n` on; `within` is η, 0.5 without jitter.
    pub(crate) fn new(first: i64, n: usize, within: f64) -> Self {
        let step = TAU / n as f64;
        let (sin, cos) = libm::sincos((first as f64 + within) * step);
        let (mut x, mut y) = ([cos; PLACES], [sin; PLACES]);
        let (sin, cos) = libm::sincos(step);
        let mut turn = [cos, sin];
        let mut filled = 1;
        // Those there are, turned by as many steps: twice as many.
        while filled < PLACES {
            for i in 0..filled {
                [x[filled + i], y[filled + i]] = turned([x[i], y[i]], turn);
            }
            turn = turned(turn, turn);
            filled *= 2;
        }
        Self { x, y, turn }
    }

    /// The next ones.
    #[inline]
    pub(crate) fn advance(&mut self) {
        for (x, y) in self.x.iter_mut().zip(&mut self.y) {
            [*x, *y] = turned([*x, *y], self.turn);
        }
    }
}

/// A vector, turned by an angle whose cosine and sine are given.
#[inline(always)]
fn turned([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> [f64; 2] {
    [x * cos - y * sin, x * sin + y * cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_stay_on_the_circle() {
        for n in [1, 2, 7, 2000, 20_000] {
            for (first, within) in [(0, 0.5), (n / 3, 0.5), (n / 3, 0.125)] {
                let mut circle = Circle::new(first as i64, n, within);
                for from in (first..n).step_by(PLACES) {
                    for j in from..(from + PLACES).min(n) {
                        let angle = TAU * (j as f64 + within) / n as f64;
                        let [x, y] = [circle.x[j - from], circle.y[j - from]];
                        assert!((x - angle.cos()).abs() < 1e-12, "{j} of {n}");
                        assert!((y - angle.sin()).abs() < 1e-12, "{j} of {n}");
                    }
                    circle.advance();
                }
            }
        }
    }
}
