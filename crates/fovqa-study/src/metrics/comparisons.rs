//! Tests of the difference of two correlations with the same scores: Meng, Rosenthal and Rubin (1992),
//! and Williams (1959), as in Steiger (1980).

use serde::Serialize;

use crate::adjust::{Adjustment, adjusted_where_defined};
use crate::distributions::{normal_two_sided, t_two_sided};

/// Metrics whose correlation is nearer to 1 are equal.
const EQUAL: f64 = 1e-12;
/// The fewest conditions of the tests.
const LEAST_CONDITIONS: usize = 4;

/// The comparison of two metrics.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// The first metric.
    pub metric: String,
    /// The other one.
    pub other: String,
    /// The correlation of the first metric with the mean opinion scores.
    pub r: Option<f64>,
    /// That of the other one.
    pub r_other: Option<f64>,
    /// The correlation of the two metrics.
    pub r_between: Option<f64>,
    /// Meng's z; positive if the first metric correlates better.
    pub meng_z: Option<f64>,
    /// Its two-sided p-value.
    pub meng_p: Option<f64>,
    /// The p-value, adjusted for all comparisons.
    pub meng_p_adjusted: Option<f64>,
    /// Williams' t.
    pub williams_t: Option<f64>,
    /// Its degrees of freedom.
    pub williams_df: Option<usize>,
    /// Its two-sided p-value.
    pub williams_p: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The correlations of two metrics with the scores, and with each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Correlations {
    pub(super) r: Option<f64>,
    pub(super) r_other: Option<f64>,
    pub(super) r_between: Option<f64>,
}

/// Compares two metrics over `n` conditions.
pub(super) fn compare(names: [&str; 2], of: Correlations, n: usize) -> Comparison {
    let mut comparison = Comparison {
        metric: names[0].to_owned(),
        other: names[1].to_owned(),
        r: of.r,
        r_other: of.r_other,
        r_between: of.r_between,
        meng_z: None,
        meng_p: None,
        meng_p_adjusted: None,
        williams_t: None,
        williams_df: None,
        williams_p: None,
        reason: None,
    };
    let reason = match (of.r, of.r_other, of.r_between) {
        _ if n < LEAST_CONDITIONS => "fewer than 4 conditions",
        (Some(r), Some(other), Some(between)) if between < 1.0 - EQUAL => {
            let z = meng(r, other, between, n);
            comparison.meng_z = z;
            comparison.meng_p = z.map(normal_two_sided);
            let t = williams(r, other, between, n);
            comparison.williams_t = t;
            comparison.williams_df = t.map(|_| n - 3);
            comparison.williams_p = t.and_then(|t| t_two_sided(t, (n - 3) as f64));
            "a correlation is 1 or -1"
        }
        (Some(_), Some(_), Some(_)) => "the metrics are equal but for their scale",
        _ => "a metric or the mean opinion scores are constant",
    };
    if comparison.meng_z.is_none() || comparison.williams_t.is_none() {
        comparison.reason = Some(reason.to_owned());
    }
    comparison
}

/// Adjusts the p-values of all comparisons.
pub(super) fn adjust(comparisons: &mut [Comparison], adjustment: Adjustment) {
    let p: Vec<Option<f64>> = comparisons.iter().map(|comparison| comparison.meng_p).collect();
    for (comparison, p) in comparisons.iter_mut().zip(adjusted_where_defined(&p, adjustment)) {
        comparison.meng_p_adjusted = p;
    }
}

fn meng(r: f64, other: f64, between: f64, n: usize) -> Option<f64> {
    let square = 0.5 * (r * r + other * other);
    let f = ((1.0 - between) / (2.0 * (1.0 - square))).min(1.0);
    let h = (1.0 - f * square) / (1.0 - square);
    let variance = 2.0 * (1.0 - between) * h / (n - 3) as f64;
    let z = (libm::atanh(r) - libm::atanh(other)) / libm::sqrt(variance);
    (r.abs() < 1.0 && other.abs() < 1.0 && z.is_finite()).then_some(z)
}

fn williams(r: f64, other: f64, between: f64, n: usize) -> Option<f64> {
    let n = n as f64;
    let determinant = 1.0 - r * r - other * other - between * between + 2.0 * r * other * between;
    let cube = (1.0 - between) * (1.0 - between) * (1.0 - between);
    let sum = r + other;
    let below = 2.0 * (n - 1.0) / (n - 3.0) * determinant.max(0.0) + 0.25 * sum * sum * cube;
    let t = (r - other) * libm::sqrt((n - 1.0) * (1.0 + between) / below);
    t.is_finite().then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meng_reproduces_the_example_of_the_paper() {
        // Meng, Rosenthal and Rubin (1992), p. 173: r .63 and -.03, between -.19, n = 15: z = 1.68.
        let z = meng(0.63, -0.03, -0.19, 15).unwrap();
        assert!((z - 1.68).abs() < 0.01, "{z}");
    }

    #[test]
    fn undefined_comparisons_have_a_reason() {
        let of = |r, r_other, r_between| Correlations { r, r_other, r_between };
        let few = compare(["a", "b"], of(Some(0.5), Some(0.4), Some(0.3)), 3);
        let equal = compare(["a", "b"], of(Some(0.5), Some(0.5), Some(1.0)), 9);
        let perfect = compare(["a", "b"], of(Some(1.0), Some(0.5), Some(0.5)), 9);
        let constant = compare(["a", "b"], of(None, Some(0.5), None), 9);
        for comparison in [few, equal, perfect, constant] {
            assert!(comparison.meng_z.is_none() && comparison.reason.is_some());
        }
    }
}
