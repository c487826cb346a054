//! Mean, standard deviation and t interval of a sample.

use serde::Serialize;

use crate::distributions::t_quantile;

/// The arithmetic mean; `None` without values.
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The standard deviation with n - 1; `None` with fewer than two values.
pub fn sd(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    if values.len() < 2 {
        return None;
    }
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    Some(libm::sqrt(squares / (values.len() - 1) as f64))
}

/// Mean, spread and t interval of a sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moments {
    /// The number of values.
    pub n: usize,
    /// The arithmetic mean.
    pub mean: Option<f64>,
    /// The standard deviation with n - 1.
    pub sd: Option<f64>,
    /// The standard error of the mean.
    pub se: Option<f64>,
    /// The t interval of the mean.
    pub ci: Option<[f64; 2]>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Moments {
    /// The moments of values, with the t interval of this coverage.
    pub fn of(values: &[f64], confidence: f64) -> Self {
        let n = values.len();
        let (mean, sd) = (mean(values), sd(values));
        let se = sd.map(|sd| sd / libm::sqrt(n as f64));
        let ci = match (mean, se, t_quantile(confidence, n as f64 - 1.0)) {
            (Some(mean), Some(se), Some(t)) => Some([mean - t * se, mean + t * se]),
            _ => None,
        };
        let reason = match n {
            0 => Some("there are no values".to_owned()),
            1 => Some("one value has no standard deviation".to_owned()),
            _ => None,
        };
        Self { n, mean, sd, se, ci, reason }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_that_of_r() {
        // R: t.test(c(1, 2, 4, 8))$conf.int
        let moments = Moments::of(&[1.0, 2.0, 4.0, 8.0], 0.95);
        assert_eq!(moments.mean, Some(3.75));
        let [low, high] = moments.ci.unwrap();
        assert!((low + 1.175_943).abs() < 1e-6 && (high - 8.675_943).abs() < 1e-6, "{low} {high}");
        assert_eq!(Moments::of(&[1.0], 0.95).ci, None);
        assert!(Moments::of(&[], 0.95).reason.is_some());
    }
}
