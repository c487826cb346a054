//! Correlations of two samples of the same length.

use crate::distributions::{normal_quantile, t_two_sided};
use crate::moments::mean;
use crate::ranks::mid_ranks;

/// Pearson's product-moment correlation, from -1 to 1; `None` if a sample is constant.
pub(super) fn pearson(x: &[f64], y: &[f64]) -> Option<f64> {
    let (mean_x, mean_y) = (mean(x)?, mean(y)?);
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (x, y) = (x - mean_x, y - mean_y);
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    if is_constant(x) || is_constant(y) {
        return None;
    }
    // The roots are taken before the product, which may underflow.
    let r = xy / (libm::sqrt(xx) * libm::sqrt(yy));
    r.is_finite().then(|| r.clamp(-1.0, 1.0))
}

/// True if all values are equal. The sum of squares around their mean need not be 0 then.
pub(super) fn is_constant(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0].total_cmp(&pair[1]).is_eq())
}

/// Spearman's rank correlation: Pearson's correlation of the mid-ranks.
pub(super) fn spearman(x: &[f64], y: &[f64]) -> Option<f64> {
    pearson(&mid_ranks(x).ranks, &mid_ranks(y).ranks)
}

/// Kendall's τ_b, from -1 to 1; `None` if a sample is constant. By Knight's algorithm (1966), in
/// n log n steps.
pub(super) fn kendall(x: &[f64], y: &[f64]) -> Option<f64> {
    let mut pairs: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let tied_x = tied_pairs(&pairs, |a, b| a.0.total_cmp(&b.0).is_eq());
    let tied_both =
        tied_pairs(&pairs, |a, b| a.0.total_cmp(&b.0).is_eq() && a.1.total_cmp(&b.1).is_eq());
    let mut second: Vec<f64> = pairs.iter().map(|pair| pair.1).collect();
    let exchanges = sort_counting(&mut second);
    let tied_y = tied_pairs(&second, |a, b| a.total_cmp(b).is_eq());
    let n = pairs.len() as f64;
    let all = 0.5 * n * (n - 1.0);
    let difference = all - tied_x - tied_y + tied_both - 2.0 * exchanges;
    let scale = libm::sqrt(all - tied_x) * libm::sqrt(all - tied_y);
    (scale > 0.0).then(|| (difference / scale).clamp(-1.0, 1.0))
}

/// The number of pairs of equal values in a sorted sample.
fn tied_pairs<T>(sorted: &[T], is_equal: impl Fn(&T, &T) -> bool) -> f64 {
    let runs = sorted.chunk_by(is_equal).map(|run| run.len() as f64);
    runs.map(|run| 0.5 * run * (run - 1.0)).sum()
}

/// Sorts, and returns the number of pairs that were in descending order.
fn sort_counting(values: &mut [f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let (left, right) = values.split_at_mut(values.len() / 2);
    let mut exchanges = sort_counting(left) + sort_counting(right);
    let mut merged = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while i < left.len() && j < right.len() {
        if right[j].total_cmp(&left[i]).is_lt() {
            exchanges += (left.len() - i) as f64;
            merged.push(right[j]);
            j += 1;
        } else {
            merged.push(left[i]);
            i += 1;
        }
    }
    merged.extend_from_slice(&left[i..]);
    merged.extend_from_slice(&right[j..]);
    values.copy_from_slice(&merged);
    exchanges
}

/// The two-sided p-value of a correlation of `n` pairs, by t with n - 2 degrees of freedom; `None` with
/// fewer than 3 pairs.
pub(super) fn p_value(r: f64, n: usize) -> Option<f64> {
    if n < 3 {
        return None;
    }
    let df = (n - 2) as f64;
    let rest = (1.0 - r) * (1.0 + r);
    if rest <= 0.0 {
        return Some(0.0);
    }
    t_two_sided(r * libm::sqrt(df / rest), df)
}

/// Fisher's interval of a correlation of `n` pairs; `None` with fewer than 4 pairs, or at ±1.
pub(super) fn fisher_interval(r: f64, n: usize, confidence: f64) -> Option<[f64; 2]> {
    if n < 4 || r.abs() >= 1.0 {
        return None;
    }
    let half = normal_quantile(0.5 + 0.5 * confidence) / libm::sqrt((n - 3) as f64);
    let centre = libm::atanh(r);
    Some([libm::tanh(centre - half), libm::tanh(centre + half)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correlations_are_those_of_r() {
        // R: x <- c(1, 2, 2, 4, 5); y <- c(2, 1, 3, 3, 6); cor(x, y, method = …)
        let (x, y) = ([1.0, 2.0, 2.0, 4.0, 5.0], [2.0, 1.0, 3.0, 3.0, 6.0]);
        let close = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-12, "{a:?}");
        close(pearson(&x, &y), 10.0 / (10.8_f64 * 14.0).sqrt());
        close(spearman(&x, &y), 7.25 / 9.5);
        close(kendall(&x, &y), 6.0 / 9.0);
    }

    #[test]
    fn kendall_counts_pairs() {
        // Against the definition.
        let x: Vec<f64> = (0..40).map(|i| f64::from(i * 7 % 11)).collect();
        let y: Vec<f64> = (0..40).map(|i| f64::from(i * 5 % 13)).collect();
        let (mut sum, mut has_x, mut has_y) = (0.0, 0.0, 0.0);
        for i in 0..40 {
            for j in 0..i {
                let sign = |d: f64| if d == 0.0 { 0.0 } else { d.signum() };
                let (a, b) = (sign(x[i] - x[j]), sign(y[i] - y[j]));
                sum += a * b;
                has_x += a * a;
                has_y += b * b;
            }
        }
        let expected = sum / f64::sqrt(has_x * has_y);
        assert!((kendall(&x, &y).unwrap() - expected).abs() < 1e-14);
    }

    #[test]
    fn constant_samples_have_no_correlation() {
        let (x, y) = ([0.1; 3], [1.0, 2.0, 3.0]);
        assert_eq!((pearson(&x, &y), spearman(&x, &y), kendall(&y, &x)), (None, None, None));
    }

    #[test]
    fn p_values_and_intervals_have_their_limits() {
        assert_eq!((p_value(1.0, 5), p_value(0.5, 2)), (Some(0.0), None));
        // df = 1: p = 2 acos(r)/π for r ≥ 0.
        let expected = 2.0 * 0.5_f64.acos() / std::f64::consts::PI;
        assert!((p_value(0.5, 3).unwrap() - expected).abs() < 1e-12);
        assert_eq!(fisher_interval(0.5, 3, 0.95), None);
        let [low, high] = fisher_interval(0.0, 12, 0.95).unwrap();
        assert!(
            (low + high).abs() < 1e-14
                && (high - (1.959_963_984_540_054_f64 / 3.0).tanh()).abs() < 1e-12
        );
    }
}
