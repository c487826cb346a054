//! The Kruskal-Wallis test (Kruskal and Wallis 1952).

use serde::Serialize;

use super::mid_ranks::mid_ranks;
use crate::distributions::chi_squared_upper;

/// The Kruskal-Wallis test of independent groups.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Kruskal {
    /// H, corrected for ties.
    pub h: Option<f64>,
    /// The number of groups minus 1.
    pub df: usize,
    /// The upper tail of χ².
    pub p: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// H = \[12/(N(N+1)) ΣR_j²/n_j - 3(N+1)\]/(1 - Σ(t³-t)/(N³-N)).
pub(super) fn kruskal(groups: &[&[f64]]) -> Kruskal {
    let groups: Vec<&[f64]> = groups.iter().copied().filter(|group| !group.is_empty()).collect();
    let df = groups.len().saturating_sub(1);
    let all: Vec<f64> = groups.concat();
    let ranked = mid_ranks(&all);
    let undefined = if df == 0 {
        Some("there is one method")
    } else if ranked.is_all_tied {
        Some("all values are equal")
    } else {
        None
    };
    if let Some(reason) = undefined {
        return Kruskal { h: None, df, p: None, reason: Some(reason.to_owned()) };
    }
    let n = all.len() as f64;
    let mut start = 0;
    let mut sum = 0.0;
    for group in groups {
        // Deviations from the mean rank lose fewer digits than squares of rank sums.
        let ranks = &ranked.ranks[start..start + group.len()];
        let deviation: f64 = ranks.iter().map(|rank| rank - 0.5 * (n + 1.0)).sum();
        sum += deviation * deviation / group.len() as f64;
        start += group.len();
    }
    let h = 12.0 / (n * (n + 1.0)) * sum / (1.0 - ranked.tie_sum / (n * n * n - n));
    Kruskal { h: Some(h), df, p: chi_squared_upper(h, df as f64), reason: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separate_groups_have_the_largest_statistic() {
        // R: kruskal.test(list(1:3, 4:6)): H = 3.857143, p = 0.04953461
        let test = kruskal(&[&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]]);
        assert!((test.h.unwrap() - 27.0 / 7.0).abs() < 1e-12);
        assert!((test.p.unwrap() - 0.049_534_613).abs() < 1e-8);
        assert_eq!(kruskal(&[&[1.0], &[1.0]]).h, None);
        assert_eq!(kruskal(&[&[1.0, 2.0]]).df, 0);
        assert_eq!(kruskal(&[]).h, None);
    }
}
