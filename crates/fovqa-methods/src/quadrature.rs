//! Integrals by Gauss-Legendre quadrature.

use std::f64::consts::PI;
use std::sync::LazyLock;

const NODES: usize = 24;

/// Nodes in (-1, 1) and their weights.
static RULE: LazyLock<[(f64, f64); NODES]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let n = NODES as f64;
        let mut x = libm::cos(PI * (i as f64 + 0.75) / (n + 0.5));
        let mut slope = 1.0;
        // Newton's method for a root of the Legendre polynomial.
        for _ in 0..100 {
            let (mut p, mut before) = (1.0, 0.0);
            for k in 0..NODES {
                let k = k as f64;
                (p, before) = (((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0), p);
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            let next = x - p / slope;
            if (next - x).abs() <= f64::EPSILON {
                break;
            }
            x = next;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
});

/// The integral of a smooth function.
pub(crate) fn smooth(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (from.midpoint(to), (to - from) / 2.0);
    RULE.iter().map(|&(x, weight)| weight * f(middle + half * x)).sum::<f64>() * half
}

/// The integral of a function that may behave like a square root at its start. The substitution x =
/// from + (to - from) s² makes it smooth in s.
pub(crate) fn rooted(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let length = to - from;
    smooth(0.0, 1.0, |s| f(from + length * s * s) * 2.0 * s) * length
}

/// The integral of a function that may behave like a square root at its start and at its end.
pub(crate) fn rooted_at_both(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let half = (to - from) / 2.0;
    let turned = |t: f64| f(from + half * (1.0 - libm::cos(t))) * libm::sin(t);
    smooth(0.0, PI, turned) * half
}

/// The sum of the integrals between breaks, which rise.
pub(crate) fn pieces(breaks: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    breaks.windows(2).map(|ends| smooth(ends[0], ends[1], &f)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_what_is_known() {
        assert!((smooth(0.0, PI, f64::sin) - 2.0).abs() < 1e-14);
        assert!(
            (smooth(-1.0, 2.0, |x| x.powi(40)) * 41.0 / (2f64.powi(41) + 1.0) - 1.0).abs() < 1e-12
        );
        assert!((rooted(1.0, 3.0, |x| (x - 1.0).sqrt()) - 2.0f64.powf(1.5) / 1.5).abs() < 1e-14);
        let arc = |x: f64| (1.0 - x * x).sqrt();
        assert!((rooted_at_both(-1.0, 1.0, arc) - PI / 2.0).abs() < 1e-14);
        assert!((pieces(&[0.0, 1.0, 3.0], |x| (x - 1.0).abs()) - 2.5).abs() < 1e-14);
    }
}
