//! Combines several values into one.

use fovqa_plan::Aggregate;

/// The aggregate of values; `None` if there are none. The mean of decibels uses only finite values,
/// and is infinite if there are none, so that an identical frame does not raise the mean of all
/// frames.
pub(super) fn aggregate(kind: Aggregate, values: &[f64], decibels: bool) -> Option<f64> {
    match kind {
        Aggregate::Mean => {
            let finite: Vec<f64> =
                values.iter().copied().filter(|value| !decibels || value.is_finite()).collect();
            match finite.len() {
                0 => values.first().copied(),
                count => Some(finite.iter().sum::<f64>() / count as f64),
            }
        }
        Aggregate::Min => values.iter().copied().reduce(f64::min),
        Aggregate::Max => values.iter().copied().reduce(f64::max),
        Aggregate::Percentile(percent) => percentile(f64::from(percent) / 100.0, values),
    }
}

/// The percentile of the values at `share` (0 to 1), interpolated linearly between the two nearest
/// values.
fn percentile(share: f64, values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = share * (sorted.len().checked_sub(1)?) as f64;
    let (below, rest) = (at as usize, at.fract());
    let from = sorted[below];
    match sorted.get(below + 1) {
        // Between two equal infinities there is nothing to interpolate.
        Some(to) if rest > 0.0 && to.to_bits() != from.to_bits() => Some(from + (to - from) * rest),
        _ => Some(from),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_values() {
        let values = [4.0, 1.0, 3.0, 2.0, 5.0];
        let p = |percent| aggregate(Aggregate::Percentile(percent), &values, true).unwrap();
        assert!((p(50) - 3.0).abs() < 1e-12 && (p(25) - 2.0).abs() < 1e-12);
        assert!((p(10) - 1.4).abs() < 1e-12 && (p(99) - 4.96).abs() < 1e-12);
        let infinite = [f64::INFINITY; 3];
        assert_eq!(aggregate(Aggregate::Percentile(10), &infinite, true), Some(f64::INFINITY));
        let mixed = [1.0, f64::INFINITY];
        assert_eq!(aggregate(Aggregate::Percentile(1), &mixed, true), Some(f64::INFINITY));
        assert_eq!(aggregate(Aggregate::Percentile(50), &[], true), None);
    }

    #[test]
    fn the_mean_of_decibels_leaves_out_identical_frames() {
        let values = [30.0, f64::INFINITY, 20.0];
        assert_eq!(aggregate(Aggregate::Mean, &values, true), Some(25.0));
        assert_eq!(aggregate(Aggregate::Mean, &values, false), Some(f64::INFINITY));
        assert_eq!(aggregate(Aggregate::Mean, &[f64::INFINITY], true), Some(f64::INFINITY));
        assert_eq!(aggregate(Aggregate::Min, &values, true), Some(20.0));
        assert_eq!(aggregate(Aggregate::Max, &values, true), Some(f64::INFINITY));
    }
}
