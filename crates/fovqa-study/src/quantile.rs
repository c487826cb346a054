//! Quantiles of samples.

/// The quantile of a sorted sample (type 7 of Hyndman and Fan 1996): `h = (N-1)p`, linear between
/// the values at `⌊h⌋` and `⌊h⌋+1`. `None` if the sample is empty or the quantile is not finite.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let h = last as f64 * p.clamp(0.0, 1.0);
    let below = (h.floor() as usize).min(last);
    let (low, high) = (sorted[below], sorted[(below + 1).min(last)]);
    let share = h - below as f64;
    // Without the test, an infinite neighbour with weight 0 would give NaN.
    let value = if share == 0.0 { low } else { low + share * (high - low) };
    value.is_finite().then_some(value)
}

/// Sorts values, which may be infinite, in ascending order.
pub fn sort(values: &mut [f64]) {
    values.sort_by(f64::total_cmp);
}

/// The median of values in any order.
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sort(&mut sorted);
    quantile(&sorted, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_of_type_7() {
        // R: quantile(c(1, 2, 4, 8), c(.1, .5, .9))
        let close = |p, expected: f64| {
            (quantile(&[1.0, 2.0, 4.0, 8.0], p).unwrap() - expected).abs() < 1e-12
        };
        assert!(close(0.1, 1.3) && close(0.5, 3.0) && close(0.9, 6.8));
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[7.0], 0.975), Some(7.0));
    }

    #[test]
    fn infinite_quantiles_are_undefined() {
        let values = [f64::NEG_INFINITY, 1.0, f64::INFINITY];
        assert_eq!(
            [0.0, 0.25, 0.5, 0.75].map(|p| quantile(&values, p)),
            [None, None, Some(1.0), None]
        );
    }
}
