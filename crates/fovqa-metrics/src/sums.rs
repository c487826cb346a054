//! Sums of `f32` rows in `f64`, in one fixed order for every vector width.

use multiversion::multiversion;

use crate::regions::clipped;
use fovqa_vision::Run;

/// The number of accumulators of a sum: two vectors of the widest kind.
const LANES: usize = 16;

/// The sum of the lanes, added in halves.
#[inline(always)]
fn total(mut lanes: [f64; LANES]) -> f64 {
    let mut width = LANES;
    while width > 1 {
        width /= 2;
        for i in 0..width {
            lanes[i] += lanes[i + width];
        }
    }
    lanes[0]
}

/// The sum of a row, added lane by lane in the same order for any vector width.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn sum(values: &[f32]) -> f64 {
    let mut lanes = [0.0f64; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, &value) in lanes.iter_mut().zip(chunk) {
            *lane += f64::from(value);
        }
    }
    for (lane, &value) in lanes.iter_mut().zip(rest) {
        *lane += f64::from(value);
    }
    total(lanes)
}

/// The sum of the products of two rows.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn sum_of_products(a: &[f32], b: &[f32]) -> f64 {
    let mut lanes = [0.0f64; LANES];
    let (chunks_a, rest_a) = a.as_chunks::<LANES>();
    let (chunks_b, rest_b) = b.as_chunks::<LANES>();
    for (a, b) in chunks_a.iter().zip(chunks_b) {
        for ((lane, &a), &b) in lanes.iter_mut().zip(a).zip(b) {
            *lane += f64::from(a) * f64::from(b);
        }
    }
    for ((lane, &a), &b) in lanes.iter_mut().zip(rest_a).zip(rest_b) {
        *lane += f64::from(a) * f64::from(b);
    }
    total(lanes)
}

/// Adds a row, which starts in column `x`, to the sums of the bands that it crosses.
pub(crate) fn add_by_band(values: &[f32], x: usize, runs: &[Run], sums: &mut [f64]) {
    for (from, to, band) in clipped(runs, x..x + values.len()) {
        sums[usize::from(band)] += sum(&values[from - x..to - x]);
    }
}

/// The sum of values times weights, and the sum of weights, over the values of the row that are in
/// any region.
pub(crate) fn weighted(values: &[f32], weights: &[f32], x: usize, runs: &[Run]) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    // Without a mask the whole row is one stretch, whatever its bands are.
    if !runs.iter().any(|run| run.band == crate::regions::LEFT_OUT) {
        return (sum_of_products(values, weights), sum(weights));
    }
    for (from, to, _) in clipped(runs, x..x + values.len()) {
        let stretch = from - x..to - x;
        sums.0 += sum_of_products(&values[stretch.clone()], &weights[stretch.clone()]);
        sums.1 += sum(&weights[stretch]);
    }
    sums
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "whole numbers add up exactly")]
mod tests {
    use super::*;
    use crate::regions::LEFT_OUT;

    #[test]
    fn bands_share_a_row_without_loss() {
        let values: Vec<f32> = (0..100).map(|i| (i * i) as f32).collect();
        let run = |end, band| Run { end, band };
        let runs = [run(13, 1), run(40, 0), run(41, LEFT_OUT), run(90, 1), run(130, 2)];
        let mut sums = [0.0; 3];
        add_by_band(&values[10..], 10, &runs, &mut sums);
        let literal = |range: std::ops::Range<usize>| range.map(|i| (i * i) as f64).sum::<f64>();
        assert_eq!(sums, [literal(13..40), literal(10..13) + literal(41..90), literal(90..100)]);
        let ones = vec![2.0; 90];
        let (weighted_sum, weight) = weighted(&values[10..], &ones, 10, &runs);
        assert_eq!(weighted_sum, 2.0 * (literal(10..100) - 1600.0));
        assert_eq!(weight, 178.0);
    }
}
