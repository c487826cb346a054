//! Newton's method for the concave log-likelihood of scores.

use crate::distributions::{normal_density, normal_log_cdf};

/// ln 3: with this factor, 1 JOD is a share of 75 % in the logistic model.
const LN_3: f64 = 1.098_612_288_668_109_8;
/// Φ⁻¹(0.75): with this factor, 1 JOD is a share of 75 % in the normal model.
pub(crate) const PROBIT_75: f64 = 0.674_489_750_196_081_7;
/// More steps than any data need.
const MOST_STEPS: usize = 200;

/// A model of the share of votes at a difference of scores.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Model {
    /// P(d) = 1/(1 + 3^-d) (Bradley and Terry 1952).
    BradleyTerry,
    /// P(d) = Φ(Φ⁻¹(0.75) d), Thurstone's case V.
    Thurstone,
}

impl Model {
    /// ln P(d) and its first two derivatives.
    fn log_share(self, difference: f64) -> [f64; 3] {
        match self {
            Model::BradleyTerry => {
                let z = LN_3 * difference;
                let loses = logistic(-z);
                let log = if z > 0.0 {
                    -libm::log1p(libm::exp(-z))
                } else {
                    z - libm::log1p(libm::exp(z))
                };
                [log, LN_3 * loses, -LN_3 * LN_3 * loses * logistic(z)]
            }
            Model::Thurstone => {
                let z = PROBIT_75 * difference;
                let log = normal_log_cdf(z);
                let mills = hazard(z, log);
                [log, PROBIT_75 * mills, -PROBIT_75 * PROBIT_75 * mills * (mills + z)]
            }
        }
    }

    /// Σ w_ij ln P(q_i - q_j) over the cells with votes, without binomial coefficients.
    pub(super) fn log_likelihood(self, wins: &[f64], scores: &[f64]) -> f64 {
        let t = scores.len();
        cells(wins, t).map(|(i, j, w)| w * self.log_share(scores[i] - scores[j])[0]).sum()
    }

    /// The scores with the largest likelihood, and 0 for the first method. Wins have to link all
    /// methods ([`super::linked::is_linked`]).
    pub(super) fn scores(self, wins: &[f64], methods: usize) -> Vec<f64> {
        let mut scores = vec![0.0; methods];
        let mut best = self.log_likelihood(wins, &scores);
        for _ in 0..MOST_STEPS {
            let Some(step) = self.step(wins, &scores) else { break };
            let size = step.iter().fold(0.0_f64, |size, s| size.max(s.abs()));
            // A whole step may go too far; the likelihood is concave, so some part of it does not.
            let mut part = 1.0;
            let next = loop {
                let next: Vec<f64> = scores.iter().zip(&step).map(|(q, s)| q + part * s).collect();
                let value = self.log_likelihood(wins, &next);
                if value >= best - 1e-14 * best.abs() {
                    best = value;
                    break Some(next);
                }
                part *= 0.5;
                if part < 1e-12 {
                    break None;
                }
            };
            let Some(next) = next else { break };
            scores = next;
            if size < 1e-11 {
                break;
            }
        }
        scores
    }

    /// The step of Newton's method, 0 for the first method.
    fn step(self, wins: &[f64], scores: &[f64]) -> Option<Vec<f64>> {
        let t = scores.len();
        let n = t - 1;
        let mut gradient = vec![0.0; n];
        let mut curvature = vec![0.0; n * n];
        for (i, j, w) in cells(wins, t) {
            let [_, first, second] = self.log_share(scores[i] - scores[j]);
            let (first, second) = (w * first, -w * second);
            if i > 0 {
                gradient[i - 1] += first;
                curvature[(i - 1) * n + i - 1] += second;
            }
            if j > 0 {
                gradient[j - 1] -= first;
                curvature[(j - 1) * n + j - 1] += second;
            }
            if i > 0 && j > 0 {
                curvature[(i - 1) * n + j - 1] -= second;
                curvature[(j - 1) * n + i - 1] -= second;
            }
        }
        let solved = solve(curvature, gradient)?;
        Some([0.0].into_iter().chain(solved).collect())
    }
}

/// The cells with votes: winner, loser, votes.
pub(super) fn cells(wins: &[f64], t: usize) -> impl Iterator<Item = (usize, usize, f64)> {
    wins.iter()
        .enumerate()
        .filter(|(_, w)| **w > 0.0)
        .map(move |(cell, w)| (cell / t, cell % t, *w))
}

fn logistic(z: f64) -> f64 {
    if z >= 0.0 {
        1.0 / (1.0 + libm::exp(-z))
    } else {
        let e = libm::exp(z);
        e / (1.0 + e)
    }
}

/// φ(z)/Φ(z), with ln Φ(z) known.
fn hazard(z: f64, log_cdf: f64) -> f64 {
    if z > -30.0 {
        return normal_density(z) / libm::exp(log_cdf);
    }
    // The asymptotic series of Mills' ratio, inverted.
    let r = 1.0 / (z * z);
    -z * (1.0 + r * (1.0 - r * (2.0 - 10.0 * r)))
}

/// Solves A x = b for a symmetric, positive definite A, by Cholesky's method.
fn solve(mut a: Vec<f64>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for i in 0..n {
        for j in 0..=i {
            let before: f64 = (0..j).map(|k| a[i * n + k] * a[j * n + k]).sum();
            let rest = a[i * n + j] - before;
            if i == j {
                if !(rest.is_finite() && rest > 0.0) {
                    return None;
                }
                a[i * n + i] = libm::sqrt(rest);
            } else {
                a[i * n + j] = rest / a[j * n + j];
            }
        }
    }
    for i in 0..n {
        let before: f64 = (0..i).map(|k| a[i * n + k] * b[k]).sum();
        b[i] = (b[i] - before) / a[i * n + i];
    }
    for i in (0..n).rev() {
        let after: f64 = (i + 1..n).map(|k| a[k * n + i] * b[k]).sum();
        b[i] = (b[i] - after) / a[i * n + i];
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_methods_have_closed_forms() {
        // 3 of 4 votes are 1 JOD in both models.
        for model in [Model::BradleyTerry, Model::Thurstone] {
            let scores = model.scores(&[0.0, 3.0, 1.0, 0.0], 2);
            assert!((scores[0] - scores[1] - 1.0).abs() < 1e-12, "{scores:?}");
        }
    }

    #[test]
    fn one_sided_votes_converge() {
        for model in [Model::BradleyTerry, Model::Thurstone] {
            let scores = model.scores(&[0.0, 1e9, 1e-3, 0.0], 2);
            let share = libm::exp(model.log_share(scores[1] - scores[0])[0]);
            assert!((share / 1e-12 - 1.0).abs() < 1e-6, "{model:?} {scores:?} {share:e}");
        }
    }

    #[test]
    fn derivatives_are_differences() {
        for model in [Model::BradleyTerry, Model::Thurstone] {
            for d in [-60.0, -44.0, -3.0, 0.0, 0.7, 5.0] {
                let [_, first, second] = model.log_share(d);
                let (up, down) = (model.log_share(d + 1e-4), model.log_share(d - 1e-4));
                let numeric = (up[0] - down[0]) / 2e-4;
                assert!((first - numeric).abs() < 1e-5 * (1.0 + first.abs()), "{model:?} {d}");
                let numeric = (up[1] - down[1]) / 2e-4;
                assert!((second - numeric).abs() < 1e-4 * (1.0 + second.abs()), "{model:?} {d}");
            }
        }
    }
}
