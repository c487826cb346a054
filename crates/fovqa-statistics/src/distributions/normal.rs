//! The standard normal distribution, with the same bits on every platform.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use statrs::function::erf::erfc_inv;

/// 1/√(2π).
const DENSITY_AT_0: f64 = 0.398_942_280_401_432_7;

/// The density φ(z).
pub fn normal_density(z: f64) -> f64 {
    DENSITY_AT_0 * libm::exp(-0.5 * z * z)
}

/// The probability Φ(z) of a value of at most z.
pub fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// ln Φ(z), also where Φ(z) underflows.
pub fn normal_log_cdf(z: f64) -> f64 {
    if z > -30.0 {
        return libm::log(normal_cdf(z));
    }
    // The asymptotic series (Abramowitz and Stegun 26.2.12); its next term is below 1e-12 here.
    let r = 1.0 / (z * z);
    let series = 1.0 - r * (1.0 - r * (3.0 - r * (15.0 - 105.0 * r)));
    libm::log(DENSITY_AT_0) - 0.5 * z * z - libm::log(-z) + libm::log(series)
}

/// The probability 2(1 - Φ(|z|)) of a value at least as far from 0 as z.
pub fn normal_two_sided(z: f64) -> f64 {
    libm::erfc(z.abs() * FRAC_1_SQRT_2)
}

/// The quantile Φ⁻¹(p); infinite for p = 0 and p = 1.
pub fn normal_quantile(p: f64) -> f64 {
    let start = -SQRT_2 * erfc_inv(2.0 * p);
    if !start.is_finite() {
        return start;
    }
    // One step of Halley's method, on the smaller tail, gives the same bits on every platform.
    let (tail, sign) = if p <= 0.5 { (p, 1.0) } else { (1.0 - p, -1.0) };
    let z = start * sign;
    let step = (normal_cdf(z) - tail) / normal_density(z);
    let better = z - step / (1.0 + 0.5 * z * step);
    if better.is_finite() { sign * better } else { start }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-14 * b.abs().max(1.0)
    }

    #[test]
    fn quantiles_are_those_of_r() {
        // R: qnorm(c(.975, .75, .5, 1e-10))
        assert!(close(normal_quantile(0.975), 1.959_963_984_540_054));
        assert!(close(normal_quantile(0.75), 0.674_489_750_196_081_7));
        assert_eq!(normal_quantile(0.5), 0.0);
        assert!(close(normal_quantile(1e-10), -6.361_340_902_404_056));
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
    }

    #[test]
    fn probabilities_are_those_of_r() {
        assert!(close(normal_cdf(-1.0), 0.158_655_253_931_457_05));
        assert!(close(normal_two_sided(3.0), 0.002_699_796_063_260_189));
        // R: pnorm(-40, log.p = TRUE); pnorm(-29, log.p = TRUE)
        assert!((normal_log_cdf(-40.0) + 804.608_442_013_754).abs() < 1e-9);
        assert!((normal_log_cdf(-29.999_999) - normal_log_cdf(-30.000_001)).abs() < 1e-4);
    }
}
