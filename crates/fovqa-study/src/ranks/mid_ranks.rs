//! Ranks with ties.

use std::cmp::Ordering;

/// Ranks of values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ranked {
    /// The rank of each value, from 1; equal values have the mean of their ranks.
    pub(crate) ranks: Vec<f64>,
    /// Σ(t³-t) over the sets of t equal values.
    pub(crate) tie_sum: f64,
    /// Whether all values are equal.
    pub(crate) is_all_tied: bool,
}

/// Ranks values.
pub(crate) fn mid_ranks(values: &[f64]) -> Ranked {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut tie_sum = 0.0;
    let mut start = 0;
    while start < order.len() {
        let is_equal = |index: &&usize| is_tied(values[**index], values[order[start]]);
        // A NaN equals nothing, not even itself.
        let length = order[start..].iter().take_while(is_equal).count().max(1);
        let rank = start as f64 + 0.5 * (length as f64 + 1.0);
        for &index in &order[start..start + length] {
            ranks[index] = rank;
        }
        let t = length as f64;
        tie_sum += t * t * t - t;
        start += length;
    }
    let is_all_tied = values.iter().all(|value| is_tied(*value, values[0]));
    Ranked { ranks, tie_sum, is_all_tied }
}

/// Whether two values are equal; 0 and -0 are.
fn is_tied(a: f64, b: f64) -> bool {
    a.partial_cmp(&b) == Some(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_share_their_mean_rank() {
        let ranked = mid_ranks(&[3.0, 1.0, 3.0, -0.0, 0.0, 3.0]);
        assert_eq!(ranked.ranks, [5.0, 3.0, 5.0, 1.5, 1.5, 5.0]);
        assert_eq!((ranked.tie_sum, ranked.is_all_tied), (30.0, false));
        assert!(mid_ranks(&[2.0, 2.0]).is_all_tied && mid_ranks(&[]).is_all_tied);
    }
}
