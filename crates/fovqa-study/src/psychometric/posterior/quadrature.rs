//! Nodes and weights of Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes, ascending, and weights that integrate over [low, high] exactly up to degree 2n - 1.
pub(super) fn gauss_legendre(count: usize, low: f64, high: f64) -> (Vec<f64>, Vec<f64>) {
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    let n = count as f64;
    (0..count)
        .map(|i| {
            // A good first guess, improved by Newton's method.
            let mut x = -libm::cos(PI * (i as f64 + 0.75) / (n + 0.5));
            let mut derivative = 1.0;
            for _ in 0..8 {
                let (value, before) = legendre(count, x);
                derivative = n * (x * value - before) / (x * x - 1.0);
                x -= value / derivative;
            }
            (centre + half * x, half * 2.0 / ((1.0 - x * x) * derivative * derivative))
        })
        .unzip()
}

/// The Legendre polynomials of degree `count` and of one less at x.
fn legendre(count: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=count {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        let (nodes, weights) = gauss_legendre(5, 1.0, 3.0);
        let integral: f64 = nodes.iter().zip(&weights).map(|(x, w)| w * x.powi(9)).sum();
        assert!((integral - (3.0_f64.powi(10) - 1.0) / 10.0).abs() < 1e-9);
        assert!((weights.iter().sum::<f64>() - 2.0).abs() < 1e-14);
        assert!(nodes.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
