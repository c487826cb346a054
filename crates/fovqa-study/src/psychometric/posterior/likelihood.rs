//! The beta-binomial log-likelihood of one level.
//!
//! The probability of a correct answer varies from block to block around ψ with the share η² of the
//! largest possible variance (Schütt, Harmeling, Macke and Wichmann 2016). With δ = η²/(1-η²), the
//! log-likelihood of k of n is Σ_{i<k} ln(ψ+iδ) + Σ_{i<n-k} ln(1-ψ+iδ) - Σ_{i<n} ln(1+iδ). The
//! differences of ln Γ that other sources give lose all digits at small η.

/// Factors that are multiplied before the rest is summed by the formula of Euler and Maclaurin, whose
/// error is then below 1e-7.
const DIRECT: u32 = 8;
/// The least probability, so that no logarithm is infinite and no product underflows.
const LEAST_PROBABILITY: f64 = 1e-35;

/// δ of η, from 0 up to but not 1.
pub(super) fn dispersion(eta: f64) -> f64 {
    eta * eta / ((1.0 - eta) * (1.0 + eta))
}

/// The log-likelihood of `correct` of `trials`, for the probabilities ψ = `right` and
/// 1 - ψ = `wrong`, without the binomial coefficient.
pub(super) fn level(correct: f64, trials: f64, right: f64, wrong: f64, delta: f64) -> f64 {
    log_rising(right.max(LEAST_PROBABILITY), delta, correct)
        + log_rising(wrong.max(LEAST_PROBABILITY), delta, trials - correct)
}

/// Σ_{i<n} ln(1+iδ), which the log-likelihood of a level has to be reduced by.
pub(super) fn normaliser(trials: f64, delta: f64) -> f64 {
    log_rising(1.0, delta, trials)
}

/// Σ_{r<count} ln(a + rδ) for a whole number `count`.
fn log_rising(a: f64, delta: f64, count: f64) -> f64 {
    if delta == 0.0 {
        return count * libm::log(a);
    }
    let direct = count.min(f64::from(DIRECT));
    let mut product = 1.0;
    let mut r = 0.0;
    while r < direct {
        product *= a + r * delta;
        r += 1.0;
    }
    let sum = libm::log(product);
    if count <= direct {
        return sum;
    }
    let (low, high) = (a + direct * delta, a + count * delta);
    let terms = count - direct;
    let growth = terms * delta / low;
    let log_growth = libm::log1p(growth);
    // The integral of ln over the terms, relative to its lower end.
    let integral = if growth < 1e-3 {
        growth * (0.5 - growth * (1.0 / 6.0 - growth / 12.0))
    } else {
        ((1.0 + growth) * log_growth - growth) / growth
    };
    let (first, last) = (delta / low, delta / high);
    sum + terms * (libm::log(low) + integral) - 0.5 * log_growth + (last - first) / 12.0
        - (last * last * last - first * first * first) / 360.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_logarithms_are_those_of_their_terms() {
        for a in [1e-9, 0.2, 0.97, 1.0] {
            for delta in [0.0, 1e-14, 1e-6, 0.01, 0.5, 40.0] {
                for count in [0_u32, 1, 7, 8, 9, 30, 1000] {
                    let exact: f64 = (0..count).map(|r| (a + f64::from(r) * delta).ln()).sum();
                    let fast = log_rising(a, delta, f64::from(count));
                    let close = (fast - exact).abs() < 1e-7 + 1e-12 * exact.abs();
                    assert!(close, "{a} {delta} {count}: {fast} is not {exact}");
                }
            }
        }
    }

    #[test]
    fn probabilities_of_all_counts_add_up_to_one() {
        let delta = dispersion(0.4);
        let choose = |k: u32| (0..k).map(|i| f64::from(6 - i) / f64::from(i + 1)).product::<f64>();
        let total: f64 = (0..=6)
            .map(|k| {
                choose(k)
                    * (level(f64::from(k), 6.0, 0.7, 0.3, delta) - normaliser(6.0, delta)).exp()
            })
            .sum();
        assert!((total - 1.0).abs() < 1e-12, "{total}");
    }
}
