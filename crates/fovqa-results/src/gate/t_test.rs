//! Tests whether the values of a build's repeated runs are worse than those of a baseline.
//!
//! With at least two runs of each, this is Welch's t-test (Welch 1947, *Biometrika* 34, equations 28
//! and 29), which does not assume that both vary alike: t = (m₁ - m₂) / √(s₁²/n₁ + s₂²/n₂), with the
//! degrees of freedom of Welch and Satterthwaite. A single run is compared with the n runs of the
//! baseline: t = (x - m) / (s √(1 + 1/n)) with n - 1 degrees of freedom, which assumes that it varies as
//! they do.

use fovqa_metrics::Better;
use fovqa_statistics::distributions::{t_upper, t_upper_quantile};

use super::noise::variance;

/// The comparison of two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TTest {
    /// Mean of this build's runs.
    pub(super) value: f64,
    /// Mean of the baseline's runs.
    pub(super) baseline: f64,
    /// Standard error of the difference; 0 if no run varies.
    pub(super) error: f64,
    /// Degrees of freedom of the standard error.
    pub(super) freedom: f64,
    /// Number of this build's runs.
    pub(super) runs: usize,
    /// The largest difference that counts as rounding noise.
    noise: f64,
    better: Better,
}

impl TTest {
    /// Compares the values of this build's runs with those of the baseline. `noise` returns the largest
    /// difference that counts as rounding noise for a given value.
    ///
    /// `None` if there is no value, the baseline has fewer than two values, or values or their squares
    /// are infinite.
    pub(super) fn new(
        new: &[f64],
        old: &[f64],
        better: Better,
        noise: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        if new.is_empty() || old.len() < 2 {
            return None;
        }
        let (runs, count) = (new.len() as f64, old.len() as f64);
        let (value, baseline) = (new.iter().sum::<f64>() / runs, old.iter().sum::<f64>() / count);
        let of_old = variance(old.iter().copied(), old.len());
        let (squared, freedom) = if new.len() == 1 {
            (of_old * (1.0 + 1.0 / count), count - 1.0)
        } else {
            let (a, b) = (variance(new.iter().copied(), new.len()) / runs, of_old / count);
            (a + b, welch_satterthwaite(a, runs, b, count))
        };
        let noise = noise(value.abs().max(baseline.abs()));
        let error = squared.sqrt();
        let finite = value.is_finite() && baseline.is_finite() && error.is_finite();
        let test = Self { value, baseline, error, freedom, runs: new.len(), noise, better };
        finite.then_some(test)
    }

    fn difference(&self) -> f64 {
        self.value - self.baseline
    }

    /// The difference of the means in standard errors; infinite if no run varies.
    pub(super) fn t(&self) -> f64 {
        self.difference() / self.error
    }

    /// The probability of a difference at least as bad as this one if the build is unchanged. It is
    /// two-sided if no direction is better. A difference within rounding noise has the probability 1.
    pub(super) fn p(&self) -> f64 {
        if self.difference().abs() <= self.noise {
            return 1.0;
        }
        // Without any spread, t is infinite, and p is 0 or 1.
        match self.better {
            Better::Higher => t_upper(-self.t(), self.freedom),
            Better::Lower => t_upper(self.t(), self.freedom),
            Better::Neither => (2.0 * t_upper(self.t().abs(), self.freedom)).min(1.0),
        }
    }

    /// The mean of this build's runs at which p would be `share`, with the observed spread, and
    /// whether it is a minimum rather than a maximum.
    pub(super) fn limit(&self, share: f64) -> (f64, bool) {
        let is_minimum = match self.better {
            Better::Higher => true,
            Better::Lower => false,
            Better::Neither => self.difference() < 0.0,
        };
        let one_sided = if self.better == Better::Neither { 0.5 * share } else { share };
        let margin = (t_upper_quantile(one_sided, self.freedom) * self.error).max(self.noise);
        let sign = if is_minimum { -1.0 } else { 1.0 };
        (self.baseline + sign * margin, is_minimum)
    }
}

/// The degrees of freedom of a + b, the squared standard errors of two means of `m` and `n` values.
fn welch_satterthwaite(a: f64, m: f64, b: f64, n: f64) -> f64 {
    let sum = a + b;
    if sum == 0.0 {
        return m + n - 2.0;
    }
    // Shares of the sum, whose squares neither overflow nor vanish.
    let (a, b) = (a / sum, b / sum);
    1.0 / (a * a / (m - 1.0) + b * b / (n - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, known: f64, relative: f64) {
        assert!((found / known - 1.0).abs() < relative, "{found} {known}");
    }

    fn test(new: &[f64], old: &[f64], better: Better) -> TTest {
        TTest::new(new, old, better, |_| 1e-9).unwrap()
    }

    /// The p-values of R's `t.test` for the samples of the task "Welch's t-test" of rosettacode.org.
    #[test]
    fn p_values_are_those_of_r() {
        let a = [
            27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1, 21.9, 22.6, 23.1, 19.6, 19.0, 21.7,
            21.4,
        ];
        let b = [
            27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0, 24.8, 20.2, 21.9, 22.1, 22.9, 20.5,
            24.4,
        ];
        let c = [17.2, 20.9, 22.6, 18.1, 21.7, 21.4, 23.5, 24.2, 14.7, 21.8];
        let d = [
            21.5, 22.8, 21.0, 23.0, 21.6, 23.6, 22.5, 20.7, 23.4, 21.8, 20.7, 21.7, 21.5, 22.5,
            23.6, 21.5, 22.5, 23.5, 21.5, 21.8,
        ];
        let e = [30.02, 29.99, 30.11, 29.97, 30.01, 29.99];
        let f = [29.89, 29.93, 29.72, 29.98, 30.02, 29.98];
        let cases: [(&[f64], &[f64], f64); 4] = [
            (&a, &b, 0.021_378_001_462_867),
            (&c, &d, 0.148_841_696_605_327),
            (&e, &f, 0.090_773_324_285_671),
            (&[3.0, 4.0, 1.0, 2.1], &[490.2, 340.0, 433.9], 0.010_751_561_149_784_5),
        ];
        for (new, old, p) in cases {
            close(test(new, old, Better::Neither).p(), p, 1e-10);
            close(test(old, new, Better::Neither).p(), p, 1e-10);
        }
        // The statistic of the third pair, as R prints it.
        close(test(&e, &f, Better::Neither).t(), 1.959_005_808_108_07, 1e-10);
    }

    /// Two samples of two values with the same variance: t has two degrees of freedom, whose tail has a
    /// closed form.
    #[test]
    fn two_pairs_have_a_closed_form() {
        let found = test(&[5.0, 7.0], &[0.0, 2.0], Better::Lower);
        close(found.t(), 5.0 / 2.0f64.sqrt(), 1e-14);
        close(found.freedom, 2.0, 1e-14);
        let t = found.t();
        let tail = 0.5 - t / (2.0 * (2.0 + t * t).sqrt());
        close(found.p(), tail, 1e-11);
        close(test(&[5.0, 7.0], &[0.0, 2.0], Better::Neither).p(), 2.0 * tail, 1e-11);
        close(test(&[5.0, 7.0], &[0.0, 2.0], Better::Higher).p(), 1.0 - tail, 1e-11);
        close(test(&[-5.0, -7.0], &[0.0, -2.0], Better::Higher).p(), tail, 1e-11);
    }

    #[test]
    fn a_single_run_is_predicted() {
        // s = 1, so t = 2 / √(4/3) with 2 degrees of freedom.
        let found = test(&[4.0], &[1.0, 2.0, 3.0], Better::Lower);
        close(found.t(), 3.0f64.sqrt(), 1e-14);
        assert!((found.freedom - 2.0).abs() < 1e-14);
        let tail = 0.5 - 3.0f64.sqrt() / (2.0 * 5.0f64.sqrt());
        close(found.p(), tail, 1e-11);
    }

    #[test]
    fn the_test_rejects_at_its_limit() {
        for better in [Better::Higher, Better::Lower, Better::Neither] {
            for shift in [-3.0, 3.0] {
                let new = [1.0 + shift, 1.5 + shift, 2.2 + shift];
                let found = test(&new, &[1.1, 2.0, 1.9, 1.3], better);
                let (limit, is_minimum) = found.limit(0.03);
                let moved: Vec<f64> = new.iter().map(|v| v + limit - found.value).collect();
                close(test(&moved, &[1.1, 2.0, 1.9, 1.3], better).p(), 0.03, 1e-9);
                assert_eq!(
                    is_minimum,
                    better == Better::Higher || better == Better::Neither && shift < 0.0
                );
            }
        }
    }

    #[test]
    fn without_spread_only_rounding_noise_passes() {
        for (value, p) in [(2.0, 1.0), (2.0 - 5e-10, 1.0), (2.0 - 2e-9, 0.0), (3.0, 1.0)] {
            for new in [vec![value; 3], vec![value]] {
                let found = test(&new, &[2.0; 3], Better::Higher);
                assert!((found.p() - p).abs() < 1e-15, "{value} {}", found.p());
                let (limit, _) = found.limit(0.01);
                assert!((limit - (2.0 - 1e-9)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn infinite_or_missing_values_have_no_test() {
        for (new, old) in [
            (&[][..], &[1.0, 2.0][..]),
            (&[1.0], &[1.0]),
            (&[f64::INFINITY, 1.0], &[1.0, 2.0]),
            (&[1.0], &[f64::INFINITY, f64::INFINITY]),
            (&[1e200, -1e200], &[1.0, 2.0]),
        ] {
            assert_eq!(TTest::new(new, old, Better::Higher, |_| 1e-9), None, "{new:?} {old:?}");
        }
    }
}
