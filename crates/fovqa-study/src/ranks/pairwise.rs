//! Tests of each pair of methods.

use serde::Serialize;

use super::kruskal::kruskal;
use super::mid_ranks::mid_ranks;
use super::signed_rank::signed_rank;
use super::units::Units;
use crate::adjust::{Adjustment, adjusted_where_defined};
use crate::distributions::normal_two_sided;
use crate::options::PairwiseTest;

/// The test of two methods.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pairwise {
    /// One method.
    pub method: String,
    /// The other method.
    pub opponent: String,
    /// The test.
    pub test: PairwiseTest,
    /// H of Kruskal and Wallis, z of Dunn, or W⁺ of Wilcoxon.
    pub statistic: Option<f64>,
    /// The two-sided p-value.
    pub p: Option<f64>,
    /// `p`, adjusted for the number of pairs.
    pub p_adjusted: Option<f64>,
    /// The number of values of both methods; for the signed-rank test, that of differences that are
    /// not 0.
    pub n: usize,
    /// For the signed-rank test, the number of differences of 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zeros: Option<usize>,
    /// For the signed-rank test, (W⁺-W⁻)/(W⁺+W⁻).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effect: Option<Option<f64>>,
    /// The distribution of the statistic: `chi2`, `normal` or `exact`.
    pub distribution: Option<&'static str>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The tests of all pairs, in the order of the methods.
pub(super) fn pairwise(units: &Units, test: PairwiseTest, adjust: Adjustment) -> Vec<Pairwise> {
    let names = units.methods.names();
    let values = units.values();
    let dunn = Dunn::new(&values);
    let mut tests = Vec::new();
    for a in 0..names.len() {
        for b in a + 1..names.len() {
            let mut entry = Pairwise {
                method: names[a].clone(),
                opponent: names[b].clone(),
                test,
                statistic: None,
                p: None,
                p_adjusted: None,
                n: values[a].len() + values[b].len(),
                zeros: None,
                effect: None,
                distribution: None,
                reason: None,
            };
            match test {
                PairwiseTest::Kruskal => {
                    let test = kruskal(&[&values[a], &values[b]]);
                    entry.distribution = test.h.map(|_| "chi2");
                    (entry.statistic, entry.p, entry.reason) = (test.h, test.p, test.reason);
                }
                PairwiseTest::Dunn => entry.add_dunn(dunn.z(a, b)),
                PairwiseTest::SignedRank => entry.add_signed_rank(&units.both(a, b)),
            }
            tests.push(entry);
        }
    }
    let p: Vec<Option<f64>> = tests.iter().map(|test| test.p).collect();
    for (test, p) in tests.iter_mut().zip(adjusted_where_defined(&p, adjust)) {
        test.p_adjusted = p;
    }
    tests
}

impl Pairwise {
    fn add_dunn(&mut self, z: Option<f64>) {
        self.statistic = z;
        self.p = z.map(normal_two_sided);
        self.distribution = z.map(|_| "normal");
        if z.is_none() {
            self.reason = Some("all values are equal, or a method has none".to_owned());
        }
    }

    fn add_signed_rank(&mut self, pairs: &[(f64, f64)]) {
        let test = signed_rank(pairs);
        self.statistic = test.statistic;
        self.p = test.p;
        self.n = test.n;
        self.zeros = Some(test.zeros);
        self.effect = Some(test.effect);
        self.distribution = test.distribution;
        if pairs.is_empty() {
            self.reason = Some("no unit has values of both methods".to_owned());
        } else if test.n == 0 {
            self.reason = Some("all differences are 0".to_owned());
        }
    }
}

/// Dunn's test (Dunn 1964), with the ranks of all values.
struct Dunn {
    /// Mean rank and number of values of each method.
    means: Vec<(f64, f64)>,
    /// N(N+1)/12 - Σ(t³-t)/(12(N-1)); `None` if all values are equal.
    variance: Option<f64>,
}

impl Dunn {
    fn new(values: &[Vec<f64>]) -> Self {
        let ranked = mid_ranks(&values.concat());
        let n = ranked.ranks.len() as f64;
        let mut start = 0;
        let mut means = Vec::new();
        for values in values {
            let count = values.len() as f64;
            let sum: f64 = ranked.ranks[start..start + values.len()].iter().sum();
            means.push((sum / count, count));
            start += values.len();
        }
        let variance = (!ranked.is_all_tied)
            .then(|| n * (n + 1.0) / 12.0 - ranked.tie_sum / (12.0 * (n - 1.0)));
        Self { means, variance }
    }

    /// z = (R̄_a - R̄_b)/√(variance (1/n_a + 1/n_b)).
    fn z(&self, a: usize, b: usize) -> Option<f64> {
        let [(mean_a, n_a), (mean_b, n_b)] = [self.means[a], self.means[b]];
        let z = (mean_a - mean_b) / libm::sqrt(self.variance? * (1.0 / n_a + 1.0 / n_b));
        z.is_finite().then_some(z)
    }
}
