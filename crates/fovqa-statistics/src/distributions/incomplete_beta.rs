//! The regularised incomplete beta function.

use super::binomial::binomial_density;

/// A number that stands for 0 in a denominator.
const TINY: f64 = 1e-300;

/// I_x(a, b) for a, b > 0, with y = 1 - x. The caller gives both, so that neither loses digits.
/// Modified Lentz's method with the continued fraction DLMF 8.17.22.
pub fn incomplete_beta(a: f64, b: f64, x: f64, y: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if y <= 0.0 {
        return 1.0;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - lower(b, a, y, x);
    }
    lower(a, b, x, y)
}

fn lower(a: f64, b: f64, x: f64, y: f64) -> f64 {
    // x^a y^b / (a B(a, b))
    let front = binomial_density(a, a + b, x, y) * b / (a + b);
    if front == 0.0 {
        return 0.0;
    }
    // The fraction needs about as many terms as the square root of the larger parameter.
    let most = 1000 + (20.0 * a.max(b).sqrt()).min(1e7) as u32;
    let mut c = 1.0;
    let mut d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = d;
    for m in 1..most {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / nonzero(1.0 + even * d);
        c = nonzero(1.0 + even / c);
        fraction *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / nonzero(1.0 + odd * d);
        c = nonzero(1.0 + odd / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-16 {
            break;
        }
    }
    (front * fraction).clamp(0.0, 1.0)
}

fn nonzero(value: f64) -> f64 {
    if value.abs() < TINY { TINY } else { value }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn simple_parameters_have_closed_forms() {
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * b, "{a:e} is not {b:e}");
        close(incomplete_beta(1.0, 1.0, 0.3, 0.7), 0.3);
        close(incomplete_beta(2.0, 1.0, 0.3, 0.7), 0.09);
        close(incomplete_beta(1.0, 3.0, 1e-9, 1.0 - 1e-9), 3e-9 - 3e-18);
        // The arcsine distribution.
        close(incomplete_beta(0.5, 0.5, 0.25, 0.75), 1.0 / 3.0);
        assert_eq!(incomplete_beta(3.0, 2.0, 0.0, 1.0), 0.0);
        assert_eq!(incomplete_beta(3.0, 2.0, 1.0, 0.0), 1.0);
    }
}
