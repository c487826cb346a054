//! Adjustment of p-values for several tests, and stars.
//!
//! Holm 1979, *Scandinavian Journal of Statistics* 6: the smallest of m p-values is multiplied by m, the
//! next one by m - 1, and so on. An adjusted p-value is never below that of a smaller p-value. The tests
//! need not be independent.

use fovqa_params::words;

words! {
    /// How p-values are adjusted for the number of tests.
    #[derive(Default)]
    pub enum Adjustment {
        /// Holm's step-down procedure (Holm 1979).
        #[default]
        Holm "holm" "Holm's step-down procedure";
        /// Bonferroni: p-values are multiplied by the number of tests.
        Bonferroni "bonferroni" "p-values times the number of tests";
        /// No adjustment.
        None "none" "no adjustment";
    }
}

/// The adjusted p-values, in the order of `p`.
///
/// Holm: `max_{j≤i} min(1, (m-j+1) p_(j))`; Bonferroni: `min(1, m p)`.
pub fn adjusted(p: &[f64], adjustment: Adjustment) -> Vec<f64> {
    let tests = p.len() as f64;
    match adjustment {
        Adjustment::None => p.to_vec(),
        Adjustment::Bonferroni => p.iter().map(|p| (tests * p).min(1.0)).collect(),
        Adjustment::Holm => {
            let mut adjusted = vec![0.0; p.len()];
            let mut highest = 0.0_f64;
            for (rank, index) in ranked(p).into_iter().enumerate() {
                highest = highest.max(((tests - rank as f64) * p[index]).min(1.0));
                adjusted[index] = highest;
            }
            adjusted
        }
    }
}

/// The adjusted p-values of a table, in the order of `p`. Only the defined p-values count as tests; an
/// undefined one remains undefined.
pub fn adjusted_where_defined(p: &[Option<f64>], adjustment: Adjustment) -> Vec<Option<f64>> {
    let defined: Vec<f64> = p.iter().flatten().copied().collect();
    let mut adjusted = adjusted(&defined, adjustment).into_iter();
    p.iter().map(|p| p.and_then(|_| adjusted.next())).collect()
}

/// The share of `alpha` at which each test would reject, in the order of `p`. With Holm's correction, a
/// test is reached only if all tests with smaller p-values reject, so the share of the first one that
/// does not reject also applies to all later ones.
pub fn shares(alpha: f64, p: &[f64], adjustment: Adjustment) -> Vec<f64> {
    let tests = p.len() as f64;
    match adjustment {
        Adjustment::None => vec![alpha; p.len()],
        Adjustment::Bonferroni => vec![alpha / tests; p.len()],
        Adjustment::Holm => {
            let ranked = ranked(p);
            let share = |rank: usize| alpha / (tests - rank as f64);
            let stops = |(rank, index): &(usize, &usize)| p[**index] > share(*rank);
            let last = ranked.iter().enumerate().find(stops).map_or(p.len(), |(rank, _)| rank);
            let mut shares = vec![alpha; p.len()];
            for (rank, index) in ranked.into_iter().enumerate() {
                shares[index] = share(rank.min(last));
            }
            shares
        }
    }
}

/// The indices of p-values, the smallest first.
fn ranked(p: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    order
}

/// The stars of an adjusted p-value: `*` below .05, `**` below .01, `***` below .001.
pub fn stars(p_adjusted: Option<f64>) -> &'static str {
    match p_adjusted {
        Some(p) if p < 0.001 => "***",
        Some(p) if p < 0.01 => "**",
        Some(p) if p < 0.05 => "*",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: &[f64], known: &[f64]) {
        assert_eq!(found.len(), known.len());
        let near = found.iter().zip(known).all(|(found, known)| (found - known).abs() < 1e-12);
        assert!(near, "{found:?} {known:?}");
    }

    /// R: `p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm")`, and the same with "bonferroni".
    #[test]
    fn adjusted_values_are_those_of_r() {
        let p = [0.01, 0.04, 0.03, 0.005];
        close(&adjusted(&p, Adjustment::Holm), &[0.03, 0.06, 0.06, 0.02]);
        close(&adjusted(&p, Adjustment::Bonferroni), &[0.04, 0.16, 0.12, 0.02]);
        close(&adjusted(&p, Adjustment::None), &p);
        close(&adjusted(&[0.9, 0.8], Adjustment::Holm), &[1.0, 1.0]);
        close(&adjusted(&[], Adjustment::Holm), &[]);
    }

    #[test]
    fn undefined_values_are_no_tests() {
        // R: p.adjust(c(.01, .04, .03), "holm") = .03 .06 .06
        let p = [Some(0.01), None, Some(0.04), Some(0.03)];
        let expected = [Some(0.03), None, Some(0.06), Some(0.06)];
        assert_eq!(adjusted_where_defined(&p, Adjustment::Holm), expected);
        let expected = [Some(0.03), None, Some(0.12), Some(0.09)];
        assert_eq!(adjusted_where_defined(&p, Adjustment::Bonferroni), expected);
        assert_eq!(adjusted_where_defined(&p, Adjustment::None), p);
        assert_eq!(adjusted_where_defined(&[None], Adjustment::Holm), [None]);
    }

    #[test]
    fn a_test_rejects_at_its_share() {
        for p in [&[0.01, 0.04, 0.03, 0.005][..], &[0.02, 0.025], &[0.5], &[0.0, 1.0, 1.0], &[]] {
            for adjustment in [Adjustment::Holm, Adjustment::Bonferroni, Adjustment::None] {
                for alpha in [0.001, 0.03, 0.05, 0.5] {
                    let adjusted = adjusted(p, adjustment);
                    let shares = shares(alpha, p, adjustment);
                    for ((p, adjusted), share) in p.iter().zip(adjusted).zip(shares) {
                        assert_eq!(
                            adjusted <= alpha,
                            *p <= share,
                            "{p} {adjusted} {share} {alpha}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn stars_are_strictly_below() {
        assert_eq!([0.05, 0.01, 0.001, 1e-9].map(|p| stars(Some(p))), ["", "*", "**", "***"]);
        assert_eq!(stars(None), "");
    }
}
