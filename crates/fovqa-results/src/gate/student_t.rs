//! Student's t distribution: its upper tail and its quantiles.
//!
//! The tail is P(T > t) = I_x(ν/2, 1/2) / 2 with x = ν / (ν + t²) for t ≥ 0 (Abramowitz and Stegun
//! 1964, equations 26.5.27 and 26.7.1), where I is the regularised incomplete beta function of the
//! crate statrs. It uses `ln` and `exp` of the platform, so that the last digits of a result may
//! differ between machines. Limits are rounded to two digits of their margin, which hides this; p-values
//! are not.

use statrs::function::beta::beta_reg;
use statrs::function::erf::erfc_inv;

/// Above this number of degrees of freedom, the series of [`beta_reg`] no longer converges, and the
/// difference from the normal distribution is small enough for two terms.
const MANY: f64 = 5000.0;

/// The probability that a value is above `t`. The degrees of freedom must be above 0.
pub(super) fn upper_tail(t: f64, freedom: f64) -> f64 {
    let above = 0.5 * beta_reg(0.5 * freedom.min(MANY), 0.5, share_of_freedom(t, freedom));
    if t >= 0.0 { above } else { 1.0 - above }
}

/// ν / (ν + t²), without overflow.
fn share_of_freedom(t: f64, freedom: f64) -> f64 {
    let freedom = freedom.min(MANY);
    let ratio = t / freedom.sqrt();
    1.0 / (1.0 + ratio * ratio)
}

/// The value that is exceeded with a probability of `share`, which must be above 0 and at most 0.5.
/// The degrees of freedom must be above 0.
pub(super) fn upper_quantile(share: f64, freedom: f64) -> f64 {
    if freedom > MANY {
        return expanded(normal_quantile(share), freedom);
    }
    let (mut below, mut above) = (0.0, 1.0);
    while upper_tail(above, freedom) > share && above < f64::MAX / 4.0 {
        (below, above) = (above, 2.0 * above);
    }
    loop {
        let middle = below + 0.5 * (above - below);
        if middle <= below || middle >= above {
            return above;
        }
        if upper_tail(middle, freedom) > share {
            below = middle;
        } else {
            above = middle;
        }
    }
}

/// The value that a normally distributed value exceeds with a probability of `share`, in standard
/// deviations.
pub(super) fn normal_quantile(share: f64) -> f64 {
    std::f64::consts::SQRT_2 * erfc_inv(2.0 * share)
}

/// The quantile for many degrees of freedom from that of the normal distribution (Abramowitz and
/// Stegun 1964, equation 26.7.5).
fn expanded(z: f64, freedom: f64) -> f64 {
    let cubed = z * z * z;
    let first = (cubed + z) / 4.0;
    let second = (5.0 * cubed * z * z + 16.0 * cubed + 3.0 * z) / 96.0;
    z + first / freedom + second / (freedom * freedom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        for (share, freedom, known) in [
            (0.01, 1.0, 31.820_515_953_773_96),
            (0.001, 2.0, 22.327_124_770_119_875),
            (0.025, 10.0, 2.228_138_851_964_938_5),
        ] {
            let found = upper_quantile(share, freedom);
            assert!((found / known - 1.0).abs() < 1e-9, "{share} {freedom}: {found}");
        }
    }

    #[test]
    fn one_and_two_degrees_of_freedom_have_closed_forms() {
        for share in [0.5f64, 0.3, 0.01, 1e-4, 1e-8] {
            let cauchy = 1.0 / (std::f64::consts::PI * share).tan();
            let two = (1.0 - 2.0 * share) / (2.0 * share * (1.0 - share)).sqrt();
            for (freedom, known) in [(1.0, cauchy), (2.0, two)] {
                let found = upper_quantile(share, freedom);
                assert!(
                    (found - known).abs() <= 1e-9 * known.max(1e-6),
                    "{share}: {found} {known}"
                );
            }
        }
    }

    #[test]
    fn many_degrees_of_freedom_come_near_the_normal_distribution() {
        assert!((normal_quantile(0.025) - 1.959_963_984_540_054).abs() < 1e-9);
        for share in [0.4, 0.05, 1e-3, 1e-6, 1e-9] {
            let known = expanded(normal_quantile(share), MANY);
            let found = upper_quantile(share, MANY);
            assert!((found / known - 1.0).abs() < 1e-7, "{share}: {found} {known}");
        }
    }

    #[test]
    fn the_tail_of_a_quantile_is_its_share() {
        for share in [0.49, 0.05, 1e-3, 1e-7] {
            for freedom in [1.0, 1.5, 3.0, 8.0, 40.0, 999.0] {
                let tail = upper_tail(upper_quantile(share, freedom), freedom);
                assert!((tail / share - 1.0).abs() < 1e-9, "{share} {freedom}: {tail}");
            }
        }
        let (above, below) = (upper_tail(1.3, 4.5), upper_tail(-1.3, 4.5));
        assert!((above + below - 1.0).abs() < 1e-12);
        assert!(upper_tail(f64::INFINITY, 3.0).abs() < 1e-300);
    }
}
