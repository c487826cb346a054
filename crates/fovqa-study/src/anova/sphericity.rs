//! Sphericity: corrections of degrees of freedom, and Mauchly's test.

use serde::Serialize;

use super::contrasts::Matrix;
use crate::distributions::chi_squared_upper;

/// A pivot below this share of the mean variance is rounding alone.
const SINGULAR: f64 = 1e-12;

/// An F test with corrected degrees of freedom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Corrected {
    /// The factor of the degrees of freedom, from 1/p to 1.
    pub epsilon: Option<f64>,
    /// The corrected degrees of freedom.
    pub df: Option<f64>,
    /// The corrected degrees of freedom of the error.
    pub df_error: Option<f64>,
    /// The upper tail of F with them.
    pub p: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Mauchly's test of sphericity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mauchly {
    /// |E|/(tr E/p)^p, from 0 to 1.
    pub w: Option<f64>,
    /// The statistic.
    pub chi2: Option<f64>,
    /// Its degrees of freedom, p(p+1)/2 - 1.
    pub df: usize,
    /// The upper tail, with the second-order term of Anderson (2003, section 10.7.4).
    pub p: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

fn trace(error: &Matrix) -> f64 {
    (0..error.len()).map(|k| error[k][k]).sum()
}

/// ε = (tr E)²/(p tr E²).
pub(super) fn greenhouse_geisser(error: &Matrix) -> f64 {
    let trace = trace(error);
    // Scaled, so that no square overflows.
    let squares: f64 = error.iter().flatten().map(|e| (e / trace) * (e / trace)).sum();
    (1.0 / (error.len() as f64 * squares)).min(1.0)
}

/// min(1, (npε-2)/(p(n-1-pε))) with ε of Greenhouse and Geisser; 1 if the denominator is not above 0.
pub(super) fn huynh_feldt(epsilon: f64, df: usize, participants: usize) -> f64 {
    let (n, p) = (participants as f64, df as f64);
    let rest = n - 1.0 - p * epsilon;
    if rest <= 1e-9 {
        return 1.0;
    }
    ((n * p * epsilon - 2.0) / (p * rest)).min(1.0)
}

impl Mauchly {
    /// A test that cannot be made.
    pub(super) fn undefined(p: usize, reason: &str) -> Self {
        let df = (p * (p + 1) / 2).saturating_sub(1);
        Self { w: None, chi2: None, df, p: None, reason: Some(reason.to_owned()) }
    }

    /// The test of the error matrix of `n` participants.
    pub(super) fn of(error: &Matrix, n: usize) -> Self {
        let dimension = error.len();
        let freedom = n - 1;
        if dimension == 1 {
            return Self::undefined(dimension, "two levels are always spherical");
        }
        if freedom < dimension {
            return Self::undefined(
                dimension,
                "there are too few participants for the number of levels",
            );
        }
        let Some(log_w) = log_w(error) else {
            return Self::undefined(dimension, "the error matrix is singular");
        };
        let (p, f) = (dimension as f64, freedom as f64);
        let rho = 1.0 - (2.0 * p * p + p + 2.0) / (6.0 * p * f);
        let chi2 = -f * rho * log_w;
        let df = dimension * (dimension + 1) / 2 - 1;
        let cubic = 2.0 * p * p * p + 6.0 * p * p + 3.0 * p + 2.0;
        let omega =
            (p + 2.0) * (p - 1.0) * (p - 2.0) * cubic / (288.0 * (f * p * rho) * (f * p * rho));
        let tail = |df: f64| chi_squared_upper(chi2, df);
        let first = tail(df as f64);
        let second = tail(df as f64 + 4.0);
        let upper = first.zip(second).map(|(first, second)| first + omega * (second - first));
        let upper = upper.filter(|upper| upper.is_finite()).map(|upper| upper.clamp(0.0, 1.0));
        let reason = upper.is_none().then(|| "the approximation has no value here".to_owned());
        Self { w: Some(libm::exp(log_w)), chi2: Some(chi2), df, p: upper, reason }
    }
}

/// ln(|E|/(tr E/p)^p), by Cholesky's method; `None` if E is singular.
fn log_w(error: &Matrix) -> Option<f64> {
    let p = error.len();
    let mean = trace(error) / p as f64;
    let mut root = vec![vec![0.0; p]; p];
    let mut log = 0.0;
    for i in 0..p {
        for j in 0..=i {
            let before: f64 = (0..j).map(|k| root[i][k] * root[j][k]).sum();
            let rest = error[i][j] / mean - before;
            if i > j {
                root[i][j] = rest / root[j][j];
            } else if rest > SINGULAR {
                root[i][i] = libm::sqrt(rest);
                log += libm::log(rest);
            } else {
                return None;
            }
        }
    }
    Some(log.min(0.0))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn spherical_errors_need_no_correction() {
        let sphere = vec![vec![2.0, 0.0], vec![0.0, 2.0]];
        assert_eq!(greenhouse_geisser(&sphere), 1.0);
        let test = Mauchly::of(&sphere, 10);
        assert_eq!((test.w, test.p, test.df), (Some(1.0), Some(1.0), 2));
    }

    #[test]
    fn unequal_variances_are_corrected() {
        // ε = 16/(2·10), W = 3/4.
        let error = vec![vec![3.0, 0.0], vec![0.0, 1.0]];
        assert!((greenhouse_geisser(&error) - 0.8).abs() < 1e-15);
        assert!((huynh_feldt(0.8, 2, 10) - 14.0 / 14.8).abs() < 1e-15);
        let test = Mauchly::of(&error, 10);
        assert!((test.w.unwrap() - 0.75).abs() < 1e-15);
        // ρ = 1 - 12/(12·9) = 8/9; two degrees of freedom: p = W⁴ for f = 9.
        assert!((test.p.unwrap() - 0.75_f64.powi(4)).abs() < 1e-12);
    }

    #[test]
    fn singular_errors_have_no_test() {
        let singular = vec![vec![1.0, 1.0], vec![1.0, 1.0]];
        assert!(Mauchly::of(&singular, 10).reason.is_some());
        assert!(Mauchly::of(&[vec![1.0, 0.0], vec![0.0, 1.0]].to_vec(), 2).w.is_none());
        assert_eq!(huynh_feldt(0.5, 2, 2), 1.0);
    }
}
