//! Fisher scoring within bounds, damped as by Levenberg and Marquardt.

use super::super::levels::Trials;
use super::super::model::{Curve, Model};
use super::likelihood::{Bounds, Scored, log_likelihood, score};

/// The most steps of one maximisation.
const MOST_STEPS: usize = 300;
/// Damping above which no step improves.
const MOST_DAMPING: f64 = 1e12;
/// Log-likelihoods that differ by less, relative to 1 + their size, count as equal.
const EQUAL: f64 = 1e-10;

/// A maximum of the log-likelihood.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Maximum {
    /// The parameters.
    pub(super) curve: Curve,
    /// The log-likelihood, without binomial coefficients.
    pub(super) log_likelihood: f64,
}

/// The best maximum that is found from the starts. Where a bound of m or w is as good, the maximum is
/// at the bound: the likelihood is flat towards it, and the parameter not determined.
pub(super) fn maximum(
    model: &Model,
    trials: &Trials,
    bounds: &Bounds,
    starts: &[Curve],
) -> Option<Maximum> {
    let limits = bounds.of_parameters();
    let best = starts.iter().map(|&start| polish(model, trials, limits, start)).reduce(
        |best, other| if other.log_likelihood > best.log_likelihood { other } else { best },
    )?;
    let enough = best.log_likelihood - EQUAL * (1.0 + best.log_likelihood.abs());
    let mut chosen = best;
    for parameter in 0..2 {
        for end in limits[parameter] {
            let mut fixed = limits;
            fixed[parameter] = [end, end];
            let start = to_curve(clamped(to_parameters(&best.curve), fixed));
            if log_likelihood(model, trials, &start) < enough {
                continue;
            }
            let there = polish(model, trials, fixed, start);
            if there.log_likelihood >= enough && !bounds.touches(&chosen.curve, 0.0) {
                chosen = there;
            }
        }
    }
    // The logarithm of a bound is not exactly that of the bound.
    let [low, high] = bounds.width;
    let near = |value: f64, bound: f64| (value - bound).abs() <= 1e-12 * bound;
    if near(chosen.curve.width, low) {
        chosen.curve.width = low;
    } else if near(chosen.curve.width, high) {
        chosen.curve.width = high;
    }
    Some(chosen)
}

fn to_parameters(curve: &Curve) -> [f64; 3] {
    [curve.position, libm::log(curve.width), curve.lapse]
}

fn to_curve([position, log_width, lapse]: [f64; 3]) -> Curve {
    Curve { position, width: libm::exp(log_width), lapse }
}

fn clamped(parameters: [f64; 3], limits: [[f64; 2]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| parameters[i].clamp(limits[i][0], limits[i][1]))
}

/// The maximum that is reached from a start.
fn polish(model: &Model, trials: &Trials, limits: [[f64; 2]; 3], start: Curve) -> Maximum {
    let mut at = clamped(to_parameters(&start), limits);
    let mut scored = score(model, trials, &to_curve(at));
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let Some(step) = damped_step(&scored, at, limits, damping) else { break };
        let next = clamped([0, 1, 2].map(|i| at[i] + step[i]), limits);
        let there = score(model, trials, &to_curve(next));
        let gain = there.log_likelihood - scored.log_likelihood;
        if gain > 0.0 {
            let moved = moves(at, next, limits);
            (at, scored) = (next, there);
            damping = (damping * 0.1).max(1e-9);
            if gain < 1e-13 * (1.0 + scored.log_likelihood.abs()) && moved < 1e-9 {
                break;
            }
        } else {
            damping = if damping < 1e-6 { 1e-3 } else { damping * 10.0 };
            if damping > MOST_DAMPING || moves(at, next, limits) < 1e-12 {
                break;
            }
        }
    }
    Maximum { curve: to_curve(at), log_likelihood: scored.log_likelihood }
}

/// The largest step, as a share of its bounds.
fn moves(from: [f64; 3], to: [f64; 3], limits: [[f64; 2]; 3]) -> f64 {
    let share = |i: usize| {
        let width = limits[i][1] - limits[i][0];
        if width > 0.0 { (to[i] - from[i]).abs() / width } else { 0.0 }
    };
    share(0).max(share(1)).max(share(2))
}

/// The step of damped Fisher scoring over the parameters that can improve; `None` if none can.
fn damped_step(
    scored: &Scored,
    at: [f64; 3],
    limits: [[f64; 2]; 3],
    damping: f64,
) -> Option<[f64; 3]> {
    let free = |i: usize| {
        let gradient = scored.gradient[i];
        let [low, high] = limits[i];
        gradient != 0.0 && !(at[i] <= low && gradient < 0.0) && !(at[i] >= high && gradient > 0.0)
    };
    let indices: Vec<usize> = (0..3).filter(|&i| free(i)).collect();
    if indices.is_empty() {
        return None;
    }
    let largest = indices.iter().map(|&i| scored.information[i][i]).fold(0.0, f64::max);
    let mut matrix = scored.information;
    for &i in &indices {
        // Parameters without information would have endless steps.
        matrix[i][i] += damping * (matrix[i][i] + 1e-12 * largest) + 1e-300;
    }
    solve(&matrix, &scored.gradient, &indices)
}

/// Solves the symmetric positive definite equations of the chosen rows and columns by Cholesky's
/// method; the other entries of the solution are 0.
fn solve(matrix: &[[f64; 3]; 3], right: &[f64; 3], indices: &[usize]) -> Option<[f64; 3]> {
    let n = indices.len();
    let mut factor = [[0.0; 3]; 3];
    let mut y = [0.0; 3];
    for i in 0..n {
        for j in 0..=i {
            let products: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[indices[i]][indices[j]] - products;
            if i == j {
                // Rounding may leave nothing of a dependent row: it is then not moved.
                factor[i][i] = if rest > 0.0 { libm::sqrt(rest) } else { f64::INFINITY };
            } else {
                factor[i][j] = rest / factor[j][j];
            }
        }
        let products: f64 = (0..i).map(|k| factor[i][k] * y[k]).sum();
        y[i] = (right[indices[i]] - products) / factor[i][i];
    }
    let mut solution = [0.0; 3];
    for i in (0..n).rev() {
        let products: f64 = (i + 1..n).map(|k| factor[k][i] * solution[indices[k]]).sum();
        solution[indices[i]] = (y[i] - products) / factor[i][i];
    }
    solution.iter().all(|value| value.is_finite()).then_some(solution)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn equations_are_solved_for_the_chosen_parameters() {
        let matrix = [[4.0, 1.0, 2.0], [1.0, 3.0, 0.5], [2.0, 0.5, 5.0]];
        let all = solve(&matrix, &[1.0, 2.0, 3.0], &[0, 1, 2]).unwrap();
        for i in 0..3 {
            let product: f64 = (0..3).map(|j| matrix[i][j] * all[j]).sum();
            assert!((product - [1.0, 2.0, 3.0][i]).abs() < 1e-12);
        }
        let two = solve(&matrix, &[1.0, 2.0, 3.0], &[0, 2]).unwrap();
        assert_eq!(two[1], 0.0);
        assert!((4.0 * two[0] + 2.0 * two[2] - 1.0).abs() < 1e-12);
        assert!((2.0 * two[0] + 5.0 * two[2] - 3.0).abs() < 1e-12);
    }
}
