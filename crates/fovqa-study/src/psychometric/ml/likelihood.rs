//! The binomial log-likelihood of a psychometric function, with its gradient and information.

use super::super::levels::{Span, Trials};
use super::super::model::{Curve, Model};

/// Probabilities are kept away from 0 by this much, so that no logarithm is infinite.
const LEAST_PROBABILITY: f64 = 1e-290;

/// Where the parameters may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    /// m.
    pub(super) position: [f64; 2],
    /// w.
    pub(super) width: [f64; 2],
    /// λ; both ends are equal if it is fixed.
    pub(super) lapse: [f64; 2],
}

impl Bounds {
    /// m from half a range below the levels to half a range above them, w from the least gap to three
    /// ranges.
    pub(super) fn new(span: &Span, lapse: [f64; 2]) -> Self {
        let half = 0.5 * span.range;
        Self {
            position: [span.first - half, span.last + half],
            width: [span.gap, 3.0 * span.range],
            lapse,
        }
    }

    /// The bounds of m, ln w and λ.
    pub(super) fn of_parameters(&self) -> [[f64; 2]; 3] {
        [self.position, self.width.map(libm::log), self.lapse]
    }

    /// True if m or w is within `tolerance` of a bound.
    pub(super) fn touches(&self, curve: &Curve, tolerance: f64) -> bool {
        let near = |value: f64, bounds: [f64; 2]| {
            value - bounds[0] <= tolerance || bounds[1] - value <= tolerance
        };
        near(curve.position, self.position) || near(curve.width, self.width)
    }
}

/// The log-likelihood at a point, with what a step of Fisher scoring needs. The parameters are m,
/// ln w and λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scored {
    /// Σ k ln ψ + (n-k) ln(1-ψ).
    pub(super) log_likelihood: f64,
    /// Its gradient.
    pub(super) gradient: [f64; 3],
    /// The expected information, symmetric.
    pub(super) information: [[f64; 3]; 3],
}

/// ln ψ and ln(1-ψ) at x.
pub(super) fn log_outcomes(model: &Model, curve: &Curve, x: f64) -> (f64, f64) {
    let z = model.direction.sign() * (x - curve.position) / curve.width;
    let (right, wrong) = model.outcomes(model.sigmoid.at(z), curve.lapse);
    (libm::log(right.max(LEAST_PROBABILITY)), libm::log(wrong.max(LEAST_PROBABILITY)))
}

/// The log-likelihood, without binomial coefficients.
pub(super) fn log_likelihood(model: &Model, trials: &Trials, curve: &Curve) -> f64 {
    let term = |(x, correct, count): (f64, f64, f64)| {
        let (right, wrong) = log_outcomes(model, curve, x);
        correct * right + (count - correct) * wrong
    };
    trials.iter().map(term).sum()
}

/// Twice the distance of a log-likelihood from that of the saturated model, in which every level has
/// its own probability.
pub(super) fn deviance(trials: &Trials, log_likelihood: f64) -> f64 {
    let part = |k: f64, n: f64| if k > 0.0 { k * libm::log(k / n) } else { 0.0 };
    let saturated: f64 = trials.iter().map(|(_, k, n)| part(k, n) + part(n - k, n)).sum();
    (2.0 * (saturated - log_likelihood)).max(0.0)
}

/// The log-likelihood with gradient and information.
pub(super) fn score(model: &Model, trials: &Trials, curve: &Curve) -> Scored {
    let sign = model.direction.sign();
    let range = model.range(curve.lapse);
    let mut out = Scored { log_likelihood: 0.0, gradient: [0.0; 3], information: [[0.0; 3]; 3] };
    for (x, correct, count) in trials.iter() {
        let z = sign * (x - curve.position) / curve.width;
        let point = model.sigmoid.at(z);
        let (right, wrong) = model.outcomes(point, curve.lapse);
        let (right, wrong) = (right.max(LEAST_PROBABILITY), wrong.max(LEAST_PROBABILITY));
        out.log_likelihood += correct * libm::log(right) + (count - correct) * libm::log(wrong);
        let slope = range * point.slope;
        // A slope of 0 far from the position times an infinite z is 0.
        let by_width = if slope == 0.0 { 0.0 } else { -slope * z };
        let by = [-slope * sign / curve.width, by_width, -point.below];
        let residual = correct / right - (count - correct) / wrong;
        for i in 0..3 {
            out.gradient[i] += residual * by[i];
            for j in 0..=i {
                // Divided one after the other: the product of the probabilities may underflow.
                out.information[i][j] += by[i] / right * (by[j] / wrong) * count;
            }
        }
    }
    for i in 0..3 {
        for j in 0..i {
            out.information[j][i] = out.information[i][j];
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::super::levels::Level;
    use super::*;

    #[test]
    fn the_gradient_is_that_of_the_log_likelihood() {
        let level = |level, correct| Level { level, correct, trials: 20 };
        let levels = [level(1.0, 11), level(2.0, 14), level(3.0, 19), level(4.5, 20)];
        let model = Model::default();
        let trials = Trials::new(&levels, model.sigmoid);
        let of = |m: f64, v: f64, lapse| Curve { position: m, width: libm::exp(v), lapse };
        let at = |m, v, lapse| log_likelihood(&model, &trials, &of(m, v, lapse));
        let scored = score(&model, &trials, &of(2.1, 0.3, 0.03));
        let h = 1e-6;
        let numeric = [
            at(2.1 + h, 0.3, 0.03) - at(2.1 - h, 0.3, 0.03),
            at(2.1, 0.3 + h, 0.03) - at(2.1, 0.3 - h, 0.03),
            at(2.1, 0.3, 0.03 + h) - at(2.1, 0.3, 0.03 - h),
        ];
        for (exact, numeric) in scored.gradient.iter().zip(numeric) {
            assert!((exact - numeric / (2.0 * h)).abs() < 1e-6, "{exact}");
        }
        assert!((scored.log_likelihood - at(2.1, 0.3, 0.03)).abs() < 1e-12);
    }

    #[test]
    fn the_saturated_model_has_no_deviance() {
        let levels = [Level { level: 1.0, correct: 3, trials: 4 }];
        let trials = Trials::new(&levels, Model::default().sigmoid);
        let saturated = 3.0 * 0.75_f64.ln() + 0.25_f64.ln();
        assert!(deviance(&trials, saturated) < 1e-14);
        assert!((deviance(&trials, saturated - 1.0) - 2.0).abs() < 1e-14);
    }
}
