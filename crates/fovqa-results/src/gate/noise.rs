//! How values vary between repeated runs of one build, and how far a limit must therefore be from
//! their mean.
//!
//! With n runs, standard deviation s and Student's t with n - 1 degrees of freedom, a new run of the
//! same build is above mean + t(1 - a, n - 1) · s · √(1 + 1/n) with the probability a (the one-sided
//! prediction limit of a normal distribution; Hahn and Meeker 1991, *Statistical Intervals*, section
//! 4.7). The difference between two new runs is above t(1 - a, n - 1) · s · √2.

use fovqa_metrics::Metric;
use fovqa_plan::Quantity;
use fovqa_statistics::distributions::{normal_quantile, t_upper_quantile};

/// The variation of a value, or of the values of several frames, between repeated runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    /// Number of runs, at least 2.
    pub(super) runs: usize,
    /// Number of frames; 1 for a value of the whole sequence.
    pub(super) frames: usize,
    /// Standard deviation between runs.
    pub(super) deviation: f64,
    /// Degrees of freedom of the standard deviation.
    pub(super) freedom: usize,
}

impl Spread {
    /// The variation of the values of frames. There is one row per run, with one value per frame.
    ///
    /// If all frames vary alike, their pooled standard deviation has F(n - 1) degrees of freedom,
    /// with F frames and n runs. A frame may vary more than the others, so the largest standard
    /// deviation of a single frame, which is never below the pooled one, takes its place. The rate of
    /// false alarms is then at most the stated one if frames vary alike. If a single frame varies
    /// much more than all others, few runs may show too little of it.
    ///
    /// `None` if there are fewer than two runs, or no frames, or the runs have different numbers of
    /// frames, or a value is infinite or its square is.
    pub(super) fn of_frames(rows: &[Vec<f64>]) -> Option<Self> {
        let (runs, frames) = (rows.len(), rows.first()?.len());
        if runs < 2 || frames == 0 || rows.iter().any(|row| row.len() != frames) {
            return None;
        }
        let variances = (0..frames).map(|frame| variance(rows.iter().map(|row| row[frame]), runs));
        // The variance of infinite values is not a number, which must not disappear in a maximum.
        let finite: Option<Vec<f64>> =
            variances.map(|variance| Some(variance).filter(|v| v.is_finite())).collect();
        let deviation = finite?.into_iter().fold(0.0, f64::max).sqrt();
        Some(Self { runs, frames, deviation, freedom: frames * (runs - 1) })
    }

    /// How far a new run is from the mean at most, on one side, except with a probability of
    /// `share`. The share is divided among the frames.
    pub(super) fn of_new_run(&self, share: f64) -> f64 {
        self.quantile(share) * self.deviation * (1.0 + 1.0 / self.runs as f64).sqrt()
    }

    /// How far a new run is from another new run at most, on one side, except with a probability of
    /// `share`. The share is divided among the frames.
    pub(super) fn of_two_new_runs(&self, share: f64) -> f64 {
        self.quantile(share) * self.deviation * std::f64::consts::SQRT_2
    }

    fn quantile(&self, share: f64) -> f64 {
        t_upper_quantile(share / self.frames as f64, self.freedom as f64)
    }
}

/// The variance with divisor n - 1.
pub(super) fn variance(values: impl Iterator<Item = f64> + Clone, count: usize) -> f64 {
    let mean = values.clone().sum::<f64>() / count as f64;
    values.map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count as f64 - 1.0)
}

/// The largest difference that counts as rounding noise: 0.001 for decibels and JOD; for other
/// values, 1e-5 of their magnitude, but at least 1e-9.
pub(super) fn rounding_noise(quantity: &Quantity, magnitude: f64) -> f64 {
    let metric = Metric::find(&quantity.metric);
    let own = matches!(quantity.statistic.as_str(), "" | "pooled");
    let is_decibel = own && metric.is_some_and(Metric::is_decibel);
    let is_jod = matches!(quantity.statistic.as_str(), "jod" | "frame_jod");
    if is_decibel || is_jod { 1e-3 } else { (1e-5 * magnitude.abs()).max(1e-9) }
}

/// How many times as wide as from very many runs a margin is.
pub(super) fn widening(runs: usize, share: f64) -> f64 {
    let runs = runs as f64;
    let very_many = -normal_quantile(share);
    t_upper_quantile(share, runs - 1.0) * (1.0 + 1.0 / runs).sqrt() / very_many
}

/// The smallest number of runs whose margins are at most twice as wide as those from very many runs.
pub(super) fn enough_runs(share: f64) -> usize {
    // With more runs the margin shrinks. Twice the width is always reached before 1000 runs.
    (2..1000).find(|runs| widening(*runs, share) <= 2.0).unwrap_or(1000)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_plan::Aggregate;

    #[test]
    fn one_frame_has_the_prediction_limit_of_a_normal_distribution() {
        let spread = Spread::of_frames(&[vec![1.0], vec![2.0], vec![3.0]]).unwrap();
        assert_eq!((spread.runs, spread.frames, spread.freedom), (3, 1, 2));
        assert!((spread.deviation - 1.0).abs() < 1e-15);
        // t(0.99, 2) = 6.964556734283273
        assert!((spread.of_new_run(0.01) - 6.964_556_734_283 * (4.0f64 / 3.0).sqrt()).abs() < 1e-9);
        assert!((spread.of_two_new_runs(0.01) - 6.964_556_734_283 * 2.0f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn frames_pool_their_degrees_of_freedom() {
        // Variances 2 and 8: the largest counts.
        let rows = [vec![1.0, 10.0], vec![3.0, 14.0]];
        let spread = Spread::of_frames(&rows).unwrap();
        assert_eq!((spread.frames, spread.freedom), (2, 2));
        assert!((spread.deviation - 8.0f64.sqrt()).abs() < 1e-12);
        // The share is divided between both frames.
        let margin = t_upper_quantile(0.005, 2.0) * 12.0f64.sqrt();
        assert!((spread.of_new_run(0.01) - margin).abs() < 1e-9);
        let alike = Spread::of_frames(&[vec![0.0; 50], vec![2.0; 50]]).unwrap();
        assert!((alike.deviation - 2.0f64.sqrt()).abs() < 1e-12);
        assert_eq!(alike.freedom, 50);
    }

    #[test]
    fn rows_must_be_a_finite_matrix_of_two_runs() {
        let unlike = vec![vec![1.0], vec![1.0, 2.0]];
        let infinite = vec![vec![1.0, f64::INFINITY], vec![2.0, f64::INFINITY]];
        let large = vec![vec![1e200], vec![-1e200]];
        for rows in [vec![], vec![vec![1.0]], vec![vec![], vec![]], unlike, infinite, large] {
            assert_eq!(Spread::of_frames(&rows), None, "{rows:?}");
        }
    }

    #[test]
    fn rounding_noise_has_the_unit_of_the_value() {
        let noise = |metric, value| rounding_noise(&Quantity::of(metric, Aggregate::Mean), value);
        let near = |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-12, "{found}");
        near(noise(Metric::Psnr, 30.0), 1e-3);
        near(noise(Metric::Ssim, -0.5), 5e-6);
        near(noise(Metric::Mse, 0.0), 1e-9);
        near(rounding_noise(&Quantity::jod(), 9.0), 1e-3);
        let share = Quantity { statistic: "share".to_owned(), ..Quantity::jod() };
        near(rounding_noise(&share, 0.25), 2.5e-6);
    }

    #[test]
    fn few_runs_widen_a_margin() {
        // t(0.99, 1) √1.5 / 2.3263
        assert!(
            (widening(2, 0.01) - 31.820_515_953_774 * 1.5f64.sqrt() / 2.326_347_874).abs() < 1e-6
        );
        assert_eq!(enough_runs(0.01), 5);
        assert!(widening(5, 0.01) <= 2.0 && widening(4, 0.01) > 2.0);
    }
}
