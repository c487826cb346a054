//! Friedman's test (Friedman 1937) and Kendall's W.

use serde::Serialize;

use super::mid_ranks::mid_ranks;
use crate::distributions::chi_squared_upper;

/// Friedman's test of methods within units that have a value of each method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Friedman {
    /// The statistic, corrected for ties.
    pub chi2: Option<f64>,
    /// The number of methods minus 1.
    pub df: usize,
    /// The upper tail of χ².
    pub p: Option<f64>,
    /// Kendall's coefficient of concordance, from 0 to 1.
    pub kendall_w: Option<f64>,
    /// The number of units.
    pub n: usize,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// χ² = \[12/(nk(k+1)) ΣR_j² - 3n(k+1)\]/\[1 - Σ(t³-t)/(nk(k²-1))\], W = χ²/(n(k-1)). The units have
/// values of all methods.
pub(super) fn friedman(units: &[Vec<f64>], methods: usize) -> Friedman {
    let df = methods.saturating_sub(1);
    let (n, k) = (units.len() as f64, methods as f64);
    let mut sums = vec![0.0; methods];
    let mut tie_sum = 0.0;
    let mut is_all_tied = true;
    for unit in units {
        let ranked = mid_ranks(unit);
        tie_sum += ranked.tie_sum;
        is_all_tied &= ranked.is_all_tied;
        for (sum, rank) in sums.iter_mut().zip(&ranked.ranks) {
            *sum += rank - 0.5 * (k + 1.0);
        }
    }
    let undefined = if df == 0 {
        Some("there is one method")
    } else if units.len() < 2 {
        Some("fewer than two units have a value of each method")
    } else if is_all_tied {
        Some("all values of each unit are equal")
    } else {
        None
    };
    if let Some(reason) = undefined {
        let reason = Some(reason.to_owned());
        return Friedman { chi2: None, df, p: None, kendall_w: None, n: units.len(), reason };
    }
    let squares: f64 = sums.iter().map(|sum| sum * sum).sum();
    let chi2 = 12.0 / (n * k * (k + 1.0)) * squares / (1.0 - tie_sum / (n * k * (k * k - 1.0)));
    Friedman {
        chi2: Some(chi2),
        df,
        p: chi_squared_upper(chi2, df as f64),
        kendall_w: Some(chi2 / (n * (k - 1.0))),
        n: units.len(),
        reason: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_orders_are_concordant() {
        let test = friedman(&[vec![1.0, 2.0, 3.0], vec![0.1, 0.2, 0.3]], 3);
        assert_eq!((test.chi2, test.kendall_w, test.df), (Some(4.0), Some(1.0), 2));
        assert!((test.p.unwrap() - (-2.0_f64).exp()).abs() < 1e-12);
        assert_eq!(friedman(&[vec![1.0, 2.0]], 2).chi2, None);
        assert_eq!(friedman(&[vec![1.0, 1.0], vec![2.0, 2.0]], 2).p, None);
        assert_eq!(friedman(&[], 3).n, 0);
    }
}
