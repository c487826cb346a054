//! The binomial distribution, and intervals of a share.

use std::f64::consts::TAU;

use super::normal::normal_quantile;

/// ln √(2π).
const LN_SQRT_TAU: f64 = 0.918_938_533_204_672_8;

/// The error of Stirling's formula: ln Γ(n+1) - (n+½) ln n + n - ln √(2π), for n > 0.
fn stirling_error(n: f64) -> f64 {
    if n < 16.0 {
        return libm::lgamma(n + 1.0) - (n + 0.5) * libm::log(n) + n - LN_SQRT_TAU;
    }
    let r = 1.0 / (n * n);
    (1.0 / 12.0 - r * (1.0 / 360.0 - r * (1.0 / 1260.0 - r * (1.0 / 1680.0 - r / 1188.0)))) / n
}

/// x ln(x/m) + m - x, without cancellation where x is near m.
fn deviance_part(x: f64, m: f64) -> f64 {
    let d = x - m;
    if d.abs() < 0.1 * (x + m) {
        let v = d / (x + m);
        let mut sum = d * v;
        let mut term = 2.0 * x * v;
        for j in 1..1000 {
            term *= v * v;
            let next = sum + term / f64::from(2 * j + 1);
            if (next - sum).abs() <= 1e-17 * sum.abs() {
                break;
            }
            sum = next;
        }
        return sum;
    }
    x * libm::log(x / m) - d
}

/// Γ(n+1)/(Γ(k+1)Γ(n-k+1)) pᵏ qⁿ⁻ᵏ with q = 1-p, for real 0 ≤ k ≤ n, by the saddle-point expansion of
/// Loader (2000), "Fast and accurate computation of binomial probabilities".
pub(super) fn binomial_density(k: f64, n: f64, p: f64, q: f64) -> f64 {
    if p <= 0.0 || q <= 0.0 {
        let certain = if p <= 0.0 { 0.0 } else { n };
        return if (k - certain).abs() < 0.5 { 1.0 } else { 0.0 };
    }
    if k <= 0.0 {
        return libm::exp(n * if p < 0.5 { libm::log1p(-p) } else { libm::log(q) });
    }
    if k >= n {
        return libm::exp(n * if q < 0.5 { libm::log1p(-q) } else { libm::log(p) });
    }
    let log = stirling_error(n)
        - stirling_error(k)
        - stirling_error(n - k)
        - deviance_part(k, n * p)
        - deviance_part(n - k, n * q);
    libm::exp(log) * libm::sqrt(n / (TAU * k * (n - k)))
}

/// P(X = k) of n trials with probability p.
pub fn binomial_probability(k: u64, n: u64, p: f64) -> f64 {
    if k > n { 0.0 } else { binomial_density(k as f64, n as f64, p, 1.0 - p) }
}

/// P(X ≤ k) of n trials with probability p.
pub fn binomial_at_most(k: u64, n: u64, p: f64) -> f64 {
    lower(k, n, p, 1.0 - p)
}

/// P(X ≥ k) of n trials with probability p.
pub fn binomial_at_least(k: u64, n: u64, p: f64) -> f64 {
    if k > n { 0.0 } else { lower(n - k, n, 1.0 - p, p) }
}

/// P(X ≤ k). Probabilities are added from the largest of the smaller tail, until they vanish.
fn lower(k: u64, n: u64, p: f64, q: f64) -> f64 {
    if k >= n {
        return 1.0;
    }
    if k as f64 <= n as f64 * p {
        return descending(k, n, p, q).min(1.0);
    }
    (1.0 - descending(n - k - 1, n, q, p)).max(0.0)
}

/// P(k) + P(k-1) + … + P(0) for k of at most about the mean.
fn descending(k: u64, n: u64, p: f64, q: f64) -> f64 {
    let first = binomial_density(k as f64, n as f64, p, q);
    if first == 0.0 || p <= 0.0 {
        return first;
    }
    let (mut sum, mut term) = (1.0, 1.0);
    let mut j = k as f64;
    while j > 0.0 {
        term *= j * q / ((n as f64 - j + 1.0) * p);
        sum += term;
        if term < 1e-18 * sum {
            break;
        }
        j -= 1.0;
    }
    first * sum
}

/// The two-sided p-value of k successes of n at probability ½: the sum of all P(x) with
/// P(x) ≤ P(k)(1 + 1e-7).
pub fn half_two_sided(k: u64, n: u64) -> f64 {
    let mut last = k.min(n.saturating_sub(k));
    let mut ratio = 1.0;
    // Towards the middle, probabilities grow. In large samples, several are equal within 1e-7.
    while 2 * last < n {
        ratio *= (n - last) as f64 / (last + 1) as f64;
        if ratio > 1.0 + 1e-7 {
            break;
        }
        last += 1;
    }
    if 2 * last >= n {
        return 1.0;
    }
    (2.0 * binomial_at_most(last, n, 0.5)).min(1.0)
}

/// The exact interval of Clopper and Pearson (1934) for a share of k of n with n > 0; 0 at k = 0,
/// and 1 at k = n.
pub fn clopper_pearson(k: u64, n: u64, confidence: f64) -> [f64; 2] {
    let tail = 0.5 - 0.5 * confidence;
    let low = if k == 0 { 0.0 } else { root(|p| binomial_at_least(k, n, p) > tail) };
    let high = if k >= n { 1.0 } else { root(|p| binomial_at_most(k, n, p) <= tail) };
    [low, high]
}

/// The probability at which a condition starts to hold.
fn root(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
        if high - low <= 1e-15 * high {
            break;
        }
    }
    0.5 * (low + high)
}

/// The interval of Wilson (1927) for a share of k of n with n > 0, without continuity correction.
pub fn wilson(k: f64, n: f64, confidence: f64) -> [f64; 2] {
    let z = normal_quantile(0.5 + 0.5 * confidence);
    let share = k / n;
    let scale = 1.0 + z * z / n;
    let centre = (share + z * z / (2.0 * n)) / scale;
    let half = z / scale * libm::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
    let low = if k <= 0.0 { 0.0 } else { (centre - half).max(0.0) };
    let high = if k >= n { 1.0 } else { (centre + half).min(1.0) };
    [low, high]
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-12 * b.abs(), "{a:e} is not {b:e}");
    }

    #[test]
    fn tails_are_those_of_exact_fractions() {
        close(binomial_at_most(1, 3, 0.5), 0.5);
        close(binomial_at_least(49, 72, 0.5), 0.001_471_380_265_062_487);
        close(half_two_sided(49, 72), 0.002_942_760_530_124_974);
        close(half_two_sided(173, 225), 2.227_042_473_228_081e-16);
        close(binomial_probability(0, 10, 0.1), 0.9_f64.powi(10));
        assert_eq!(half_two_sided(10, 20), 1.0);
        assert_eq!((binomial_at_most(20, 20, 0.3), binomial_at_least(21, 20, 0.3)), (1.0, 0.0));
        assert_eq!(half_two_sided(0, 0), 1.0);
    }

    #[test]
    fn large_samples_add_up() {
        let n = 1_000_000;
        let both = binomial_at_most(500_100, n, 0.5) + binomial_at_least(500_101, n, 0.5);
        close(both, 1.0);
        // The normal approximation with continuity correction.
        let z = 100.5 / 500.0;
        let normal = super::super::normal_cdf(z);
        assert!((binomial_at_most(500_100, n, 0.5) - normal).abs() < 1e-7);
        assert!(half_two_sided(500_000_000_000, 1_000_000_000_001) > 0.999);
    }

    #[test]
    fn intervals_are_those_of_r() {
        // R: binom.test(49, 72)$conf.int
        let [low, _] = clopper_pearson(49, 72, 0.95);
        close(low, 0.560_141_563_471_466);
        assert_eq!(clopper_pearson(20, 20, 0.95)[1], 1.0);
        close(clopper_pearson(20, 20, 0.95)[0], 0.025_f64.powf(0.05));
        assert_eq!(wilson(0.0, 20.0, 0.95)[0], 0.0);
        close(wilson(49.0, 72.0, 0.95)[0], 0.566_076_512_678_343_4);
    }
}
