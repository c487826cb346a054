//! Corrects the p-values of several tests, so that the probability of any false alarm stays below a
//! level.
//!
//! Holm 1979, *Scandinavian Journal of Statistics* 6: the smallest of m p-values is multiplied by m, the
//! next one by m - 1, and so on. An adjusted p-value is never below that of a smaller p-value. The tests
//! need not be independent.

use fovqa_plan::Adjust;

/// The adjusted p-values, in the order of `p`.
pub(super) fn adjusted(adjust: Adjust, p: &[f64]) -> Vec<f64> {
    let count = p.len() as f64;
    match adjust {
        Adjust::None => p.to_vec(),
        Adjust::Bonferroni => p.iter().map(|p| (p * count).min(1.0)).collect(),
        Adjust::Holm => {
            let mut adjusted = vec![0.0; p.len()];
            let mut largest = 0.0f64;
            for (rank, index) in ranked(p).into_iter().enumerate() {
                largest = largest.max((p[index] * (count - rank as f64)).min(1.0));
                adjusted[index] = largest;
            }
            adjusted
        }
    }
}

/// The share of `alpha` at which each test would reject, in the order of `p`. With Holm's correction, a
/// test is reached only if all tests with smaller p-values reject, so the share of the first one that
/// does not reject also applies to all later ones.
pub(super) fn shares(adjust: Adjust, alpha: f64, p: &[f64]) -> Vec<f64> {
    let count = p.len() as f64;
    match adjust {
        Adjust::None => vec![alpha; p.len()],
        Adjust::Bonferroni => vec![alpha / count; p.len()],
        Adjust::Holm => {
            let ranked = ranked(p);
            let share = |rank: usize| alpha / (count - rank as f64);
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
        close(&adjusted(Adjust::Holm, &p), &[0.03, 0.06, 0.06, 0.02]);
        close(&adjusted(Adjust::Bonferroni, &p), &[0.04, 0.16, 0.12, 0.02]);
        close(&adjusted(Adjust::None, &p), &p);
        close(&adjusted(Adjust::Holm, &[0.9, 0.8]), &[1.0, 1.0]);
        close(&adjusted(Adjust::Holm, &[]), &[]);
    }

    #[test]
    fn a_test_rejects_at_its_share() {
        for p in [&[0.01, 0.04, 0.03, 0.005][..], &[0.02, 0.025], &[0.5], &[0.0, 1.0, 1.0], &[]] {
            for adjust in [Adjust::Holm, Adjust::Bonferroni, Adjust::None] {
                for alpha in [0.001, 0.03, 0.05, 0.5] {
                    let adjusted = adjusted(adjust, p);
                    let shares = shares(adjust, alpha, p);
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
}
