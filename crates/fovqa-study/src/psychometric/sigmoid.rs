//! The sigmoid F of a psychometric function, on the scale z = (x - m) / w.
//!
//! Every sigmoid has F(0) = ½ and rises from .05 to .95 over one unit of z. `logistic` and `gaussian` are symmetric; `weibull` is the Gumbel function of the
//! logarithm of the level, whose .05 and .95 are one unit apart but not centred.

use crate::distributions::{normal_cdf, normal_density, normal_quantile};
use crate::options::Sigmoid;

/// 2 ln 19: the slope that puts .05 and .95 one unit apart.
const LOGISTIC_SLOPE: f64 = 5.888_877_958_332_880_5;
/// 2 Φ⁻¹(.95), the same for the normal distribution.
const GAUSSIAN_SLOPE: f64 = 3.289_707_253_902_944_5;
/// ln(-ln .05) - ln(-ln .95), the same for the Weibull function.
const WEIBULL_SLOPE: f64 = 4.067_383_949_407_112_5;
/// ln ln 2: puts F = ½ at z = 0.
const LN_LN_2: f64 = -0.366_512_920_581_664_35;

/// A sigmoid at one point: its value, one minus its value without cancellation, and its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// F(z).
    pub(crate) below: f64,
    /// 1 - F(z).
    pub(crate) above: f64,
    /// F'(z).
    pub(crate) slope: f64,
}

impl Sigmoid {
    /// True if the function is one of the logarithm of the level.
    pub(crate) fn is_logarithmic(self) -> bool {
        self == Self::Weibull
    }

    /// The level on the scale on which the function is fitted.
    pub(crate) fn scale(self, level: f64) -> f64 {
        if self.is_logarithmic() { libm::log(level) } else { level }
    }

    /// The level of a position on the scale of the fit.
    pub(crate) fn level(self, x: f64) -> f64 {
        if self.is_logarithmic() && x.is_finite() { libm::exp(x) } else { x }
    }

    /// F(z).
    pub(crate) fn value(self, z: f64) -> f64 {
        match self {
            Self::Logistic => 1.0 / (1.0 + libm::exp(-LOGISTIC_SLOPE * z)),
            Self::Gaussian => normal_cdf(GAUSSIAN_SLOPE * z),
            Self::Weibull => -libm::expm1(-libm::exp(WEIBULL_SLOPE * z + LN_LN_2)),
        }
    }

    /// F, 1 - F and F' at z.
    pub(crate) fn at(self, z: f64) -> Point {
        match self {
            Self::Logistic => {
                let e = libm::exp(-LOGISTIC_SLOPE * z.abs());
                let (large, small) = (1.0 / (1.0 + e), e / (1.0 + e));
                let (below, above) = if z >= 0.0 { (large, small) } else { (small, large) };
                Point { below, above, slope: LOGISTIC_SLOPE * large * small }
            }
            Self::Gaussian => {
                let t = GAUSSIAN_SLOPE * z;
                let slope = GAUSSIAN_SLOPE * normal_density(t);
                Point { below: normal_cdf(t), above: normal_cdf(-t), slope }
            }
            Self::Weibull => {
                let hazard = libm::exp(WEIBULL_SLOPE * z + LN_LN_2);
                let above = libm::exp(-hazard);
                // An infinite hazard times zero is zero.
                let slope = if above > 0.0 { WEIBULL_SLOPE * hazard * above } else { 0.0 };
                Point { below: -libm::expm1(-hazard), above, slope }
            }
        }
    }

    /// z at which F(z) = `p`; infinite at 0 and 1 and beyond.
    pub(crate) fn inverse(self, p: f64) -> f64 {
        if p <= 0.0 {
            return f64::NEG_INFINITY;
        }
        if p >= 1.0 {
            return f64::INFINITY;
        }
        match self {
            Self::Logistic => (libm::log(p) - libm::log1p(-p)) / LOGISTIC_SLOPE,
            Self::Gaussian => normal_quantile(p) / GAUSSIAN_SLOPE,
            Self::Weibull => (libm::log(-libm::log1p(-p)) - LN_LN_2) / WEIBULL_SLOPE,
        }
    }

    /// The range of z outside of which the function is 0 or 1 for every purpose of a posterior: F is
    /// below e⁻³⁵ or above 1 - 1e-12.
    pub(crate) fn effective_range(self) -> (f64, f64) {
        match self {
            Self::Logistic => (-6.0, 6.0),
            Self::Gaussian => (-2.5, 2.5),
            Self::Weibull => (-8.6, 1.1),
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    const ALL: [Sigmoid; 3] = [Sigmoid::Logistic, Sigmoid::Gaussian, Sigmoid::Weibull];

    #[test]
    fn half_is_at_zero_and_one_unit_spans_the_width() {
        for sigmoid in ALL {
            assert!((sigmoid.at(0.0).below - 0.5).abs() < 1e-14, "{sigmoid:?}");
            let width = sigmoid.inverse(0.95) - sigmoid.inverse(0.05);
            assert!((width - 1.0).abs() < 1e-12, "{sigmoid:?}: {width}");
        }
    }

    #[test]
    fn the_inverse_undoes_the_function_and_the_slope_is_its_derivative() {
        for sigmoid in ALL {
            for p in [1e-6, 0.1, 0.5, 0.9, 0.999] {
                let z = sigmoid.inverse(p);
                let point = sigmoid.at(z);
                assert!((point.below - p).abs() < 1e-12 * (1.0 + p));
                assert!((point.above - (1.0 - p)).abs() < 1e-12);
                assert!((sigmoid.value(z) - p).abs() < 1e-12);
                let step = 1e-6;
                let slope = (sigmoid.value(z + step) - sigmoid.value(z - step)) / (2.0 * step);
                assert!((point.slope - slope).abs() < 1e-7, "{sigmoid:?} at {p}");
            }
        }
    }

    #[test]
    fn far_tails_stay_finite() {
        for sigmoid in ALL {
            for z in [-1e6, -50.0, 50.0, 1e6] {
                let point = sigmoid.at(z);
                assert!(point.below.is_finite() && point.above.is_finite());
                assert!(point.slope.is_finite());
            }
        }
        assert_eq!(Sigmoid::Logistic.inverse(0.0), f64::NEG_INFINITY);
        assert_eq!(Sigmoid::Logistic.inverse(1.0), f64::INFINITY);
    }

    #[test]
    fn the_effective_range_holds_what_it_says() {
        for sigmoid in ALL {
            let (low, high) = sigmoid.effective_range();
            assert!(sigmoid.at(low).below < (-34.5_f64).exp());
            assert!(sigmoid.at(high).above < 1e-12);
        }
    }
}
