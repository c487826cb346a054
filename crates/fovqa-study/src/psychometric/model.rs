//! The psychometric function ψ(x) = γ + (1 - γ - λ) F(s(x - m)/w).

use super::sigmoid::Point;
use crate::options::{Direction, Sigmoid};

impl Direction {
    /// s: 1, or -1 for a function that falls with the level.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Increasing => 1.0,
            Self::Decreasing => -1.0,
        }
    }
}

/// What is fixed of a psychometric function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model {
    /// The shape.
    pub sigmoid: Sigmoid,
    /// Whether performance grows or falls with the level.
    pub direction: Direction,
    /// γ: the probability of a correct guess, from 0 up to but not 1.
    pub guess: f64,
}

impl Default for Model {
    fn default() -> Self {
        Self { sigmoid: Sigmoid::default(), direction: Direction::default(), guess: 0.5 }
    }
}

/// The parameters of a psychometric function, on the scale of the fit: for `weibull`, position and
/// width are logarithms of levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Curve {
    /// m, where F = ½.
    pub(crate) position: f64,
    /// w, from F = .05 to .95.
    pub(crate) width: f64,
    /// λ.
    pub(crate) lapse: f64,
}

impl Model {
    /// 1 - γ - λ.
    pub(crate) fn range(&self, lapse: f64) -> f64 {
        1.0 - self.guess - lapse
    }

    /// ψ at x, a position on the scale of the fit.
    pub(crate) fn performance(&self, curve: &Curve, x: f64) -> f64 {
        let z = self.direction.sign() * (x - curve.position) / curve.width;
        self.guess + self.range(curve.lapse) * self.sigmoid.value(z)
    }

    /// ψ and 1 - ψ at a point of the sigmoid, neither by subtraction of nearly equal numbers.
    pub(crate) fn outcomes(&self, point: Point, lapse: f64) -> (f64, f64) {
        let range = self.range(lapse);
        (self.guess + range * point.below, lapse + range * point.above)
    }

    /// z at which ψ = `performance`: ∞ if ψ does not reach it, `None` if it is not above γ.
    pub(crate) fn z_of(&self, performance: f64, lapse: f64) -> Option<f64> {
        (performance > self.guess).then(|| {
            let share = (performance - self.guess) / self.range(lapse);
            if self.range(lapse) > 0.0 { self.sigmoid.inverse(share) } else { f64::INFINITY }
        })
    }

    /// x at which ψ = `performance`: s·∞ if ψ does not reach it, `None` if it is not above γ.
    pub(crate) fn x_of(&self, performance: f64, curve: &Curve) -> Option<f64> {
        let z = self.z_of(performance, curve.lapse)?;
        Some(curve.position + self.direction.sign() * curve.width * z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_where_the_performance_is_reached() {
        for direction in [Direction::Increasing, Direction::Decreasing] {
            let model = Model { direction, ..Model::default() };
            let curve = Curve { position: 2.0, width: 1.5, lapse: 0.02 };
            let x = model.x_of(0.75, &curve).unwrap();
            assert!((model.performance(&curve, x) - 0.75).abs() < 1e-14);
            assert_eq!((x > 2.0), direction == Direction::Increasing, "half of F is at .74");
            let easy = 2.0 + 10.0 * direction.sign();
            assert!((model.performance(&curve, easy) - 0.98).abs() < 1e-9);
        }
    }

    #[test]
    fn performance_that_is_not_reached_has_no_finite_threshold() {
        let model = Model { direction: Direction::Decreasing, ..Model::default() };
        let curve = Curve { position: 2.0, width: 1.5, lapse: 0.1 };
        assert_eq!(model.x_of(0.95, &curve), Some(f64::NEG_INFINITY));
        assert_eq!(model.x_of(0.5, &curve), None);
    }
}
