//! Wilcoxon's signed-rank test (Wilcoxon 1945).

use super::mid_ranks::mid_ranks;
use crate::distributions::normal_two_sided;

/// Up to this number of differences, the distribution is exact: its counts, up to 2⁵⁰, are exact in
/// double precision.
const MOST_EXACT: usize = 50;

/// The result of the test.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SignedRank {
    /// W⁺: the sum of the ranks of positive differences.
    pub(super) statistic: Option<f64>,
    /// The two-sided p-value.
    pub(super) p: Option<f64>,
    /// (W⁺-W⁻)/(W⁺+W⁻), from -1 to 1.
    pub(super) effect: Option<f64>,
    /// The number of differences that are not 0.
    pub(super) n: usize,
    /// The number of differences of 0, which are left out.
    pub(super) zeros: usize,
    /// `exact` or `normal`.
    pub(super) distribution: Option<&'static str>,
}

/// The test of paired values. It is exact up to 50 differences, also with ties.
pub(super) fn signed_rank(pairs: &[(f64, f64)]) -> SignedRank {
    let differences: Vec<f64> =
        pairs.iter().map(|(a, b)| a - b).filter(|difference| *difference != 0.0).collect();
    let (n, zeros) = (differences.len(), pairs.len() - differences.len());
    if n == 0 {
        let (statistic, p, effect, distribution) = (None, None, None, None);
        return SignedRank { statistic, p, effect, n, zeros, distribution };
    }
    let sizes: Vec<f64> = differences.iter().map(|difference| difference.abs()).collect();
    let ranked = mid_ranks(&sizes);
    let with_rank = differences.iter().zip(&ranked.ranks);
    let positive: f64 =
        with_rank.filter(|(difference, _)| **difference > 0.0).map(|(_, r)| r).sum();
    let count = n as f64;
    let total = 0.5 * count * (count + 1.0);
    let (p, distribution) = if n <= MOST_EXACT {
        (exact(&ranked.ranks, positive), "exact")
    } else {
        let variance = total * (2.0 * count + 1.0) / 12.0 - ranked.tie_sum / 48.0;
        (normal_two_sided((positive - 0.5 * total) / libm::sqrt(variance)), "normal")
    };
    SignedRank {
        statistic: Some(positive),
        p: Some(p),
        effect: Some((2.0 * positive - total) / total),
        n,
        zeros,
        distribution: Some(distribution),
    }
}

/// min(1, 2 min(P(W ≤ w), P(W ≥ w))) over all 2ⁿ signs of the ranks. Doubled mid-ranks are whole.
fn exact(ranks: &[f64], positive: f64) -> f64 {
    let doubled: Vec<usize> = ranks.iter().map(|rank| (2.0 * rank) as usize).collect();
    let most: usize = doubled.iter().sum();
    let mut ways = vec![0.0; most + 1];
    ways[0] = 1.0;
    let mut reached = 0;
    for rank in doubled {
        reached += rank;
        for sum in (rank..=reached).rev() {
            ways[sum] += ways[sum - rank];
        }
    }
    let w = (2.0 * positive) as usize;
    let below: f64 = ways[..=w].iter().sum();
    let above: f64 = ways[w..].iter().sum();
    let all = libm::exp2(ranks.len() as f64);
    (2.0 * below.min(above) / all).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(differences: &[f64]) -> SignedRank {
        signed_rank(&differences.iter().map(|d| (*d, 0.0)).collect::<Vec<_>>())
    }

    #[test]
    fn small_samples_are_counted() {
        // All of 5 positive: 2/2⁵.
        assert_eq!(of(&[1.0, 2.0, 3.0, 4.0, 5.0]).p, Some(0.0625));
        // R: wilcox.test(c(1, -2, 3, 4)): V = 8, p = 0.375
        let test = of(&[1.0, -2.0, 3.0, 4.0, 0.0]);
        assert_eq!((test.statistic, test.p, test.n, test.zeros), (Some(8.0), Some(0.375), 4, 1));
        assert_eq!(test.effect, Some(0.6));
        // Ties: ranks 1.5, 1.5, 3; W⁺ = 1.5 or less in 3 of 8.
        assert_eq!(of(&[1.0, -1.0, -2.0]).p, Some(0.75));
    }

    #[test]
    fn large_samples_are_approximated_and_zeros_have_no_test() {
        let many: Vec<f64> =
            (1..=51).map(|i| if i % 2 == 0 { -f64::from(i) } else { f64::from(i) }).collect();
        let test = of(&many);
        assert_eq!((test.distribution, test.n), (Some("normal"), 51));
        let exact = of(&many[..50]).p.unwrap();
        assert!((test.p.unwrap() - exact).abs() < 0.2);
        assert_eq!(of(&[0.0, 0.0]).statistic, None);
    }
}
