//! Bootstrap replicates and their intervals.

use rayon::prelude::*;

use crate::Settings;
use crate::quantile::{quantile, sort};
use crate::random::Replicate;

/// An interval. A limit that is not finite is undefined.
pub type Interval = [Option<f64>; 2];

/// The values of all replicates, in their order, whatever the number of threads.
pub fn replicates<T: Send>(
    settings: &Settings,
    replicate: impl Fn(&mut Replicate) -> T + Sync,
) -> Vec<T> {
    let of = |b: usize| replicate(&mut Replicate::new(settings.seed, b as u64));
    (0..settings.bootstrap).into_par_iter().map(of).collect()
}

/// The bootstrap interval: the quantiles (1 ∓ c)/2 of the replicates, which may be infinite.
/// `None` without replicates.
pub fn interval(mut values: Vec<f64>, confidence: f64) -> Option<Interval> {
    if values.is_empty() {
        return None;
    }
    sort(&mut values);
    Some([0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence].map(|p| quantile(&values, p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replicates_keep_their_order() {
        let settings = Settings { bootstrap: 100, ..Settings::default() };
        let first = replicates(&settings, Replicate::next_u64);
        let again: Vec<u64> = (0..100).map(|b| Replicate::new(1, b).next_u64()).collect();
        assert_eq!(first, again);
    }

    #[test]
    fn intervals_are_quantiles() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let [low, high] = interval(values, 0.9).unwrap().map(Option::unwrap);
        assert!((low - 5.0).abs() < 1e-9 && (high - 95.0).abs() < 1e-9);
        assert_eq!(interval(Vec::new(), 0.9), None);
        assert_eq!(interval(vec![1.0, f64::INFINITY], 0.9), Some([None, None]));
    }
}
