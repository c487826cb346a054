//! Tails of the distributions behind the papers' tests.

use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, FisherSnedecor};

use fovqa_report::{Printed, PrintedVerdict as Verdict};

/// One-sided binomial test: the chance of at least `votes` of `trials`, each as likely as not.
pub(super) fn at_least(votes: u64, trials: u64) -> f64 {
    match (Binomial::new(0.5, trials), votes.checked_sub(1)) {
        (Ok(binomial), Some(fewer)) => binomial.sf(fewer),
        (Ok(_), None) => 1.0,
        (Err(_), _) => f64::NAN,
    }
}

/// Two-sided binomial test: the chance of being at least as far from the half as `votes` of `trials`,
/// each as likely as not.
pub(super) fn two_sided(votes: u64, trials: u64) -> f64 {
    (2.0 * at_least(votes.max(trials.saturating_sub(votes)), trials)).min(1.0)
}

/// The whole numbers of votes that a printed percentage of `trials` can be.
pub(super) fn whole_votes(percentage: &Printed, trials: u64) -> Vec<u64> {
    let fits = |votes: &u64| {
        percentage.verdict(100.0 * *votes as f64 / trials as f64) == Verdict::Reproduced
    };
    (0..=trials).filter(fits).collect()
}

/// The chance of an F of at least this, with these degrees of freedom.
pub(super) fn f_tail(f: f64, [above, below]: [u32; 2]) -> f64 {
    FisherSnedecor::new(above.into(), below.into()).map_or(f64::NAN, |fisher| fisher.sf(f))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum over the binomial coefficients themselves.
    fn summed(votes: u64, trials: u64) -> f64 {
        let mut chance = 0.5f64.powi(trials as i32);
        let mut sum = 0.0;
        for k in 0..=trials {
            if k >= votes {
                sum += chance;
            }
            chance *= (trials - k) as f64 / (k + 1) as f64;
        }
        sum
    }

    #[test]
    fn binomial_tails_are_sums_of_coefficients() {
        for votes in 0..=72 {
            assert!((at_least(votes, 72) / summed(votes, 72) - 1.0).abs() < 1e-9, "{votes}");
            assert!((two_sided(votes, 72) - two_sided(72 - votes, 72)).abs() < 1e-12);
        }
        for votes in 37..=72 {
            assert!((two_sided(votes, 72) / summed(votes, 72) - 2.0).abs() < 1e-9, "{votes}");
        }
        assert!((two_sided(36, 72) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn percentages_of_whole_votes() {
        assert_eq!(whole_votes(&Printed::new("68.1 %"), 72), [49]);
        assert_eq!(whole_votes(&Printed::new("68.2 %"), 72), [0; 0]);
        assert_eq!(whole_votes(&Printed::new("50 %"), 200), [99, 100, 101]);
    }

    /// Closed forms: with 2 above, (1 + 2f/n)^(-n/2); with 1 above and 1 below, an arc tangent.
    #[test]
    fn f_tails_have_closed_forms() {
        for below in [1_u32, 12, 30, 285] {
            for f in [0.2, 3.8, 6.5] {
                let n = f64::from(below);
                let closed = (1.0 + 2.0 * f / n).powf(-n / 2.0);
                assert!((f_tail(f, [2, below]) / closed - 1.0).abs() < 1e-9, "{f} {below}");
            }
        }
        let closed = 1.0 - 2.0 / std::f64::consts::PI * 0.229f64.sqrt().atan();
        assert!((f_tail(0.229, [1, 1]) / closed - 1.0).abs() < 1e-9);
        // Against R's pf and SciPy's f.sf.
        assert!((f_tail(0.229, [1, 12]) - 0.640_867_003_666).abs() < 1e-9);
        assert!((f_tail(0.229, [1, 24]) - 0.636_597_030_443).abs() < 1e-9);
        assert!(f_tail(1.0, [0, 12]).is_nan());
    }
}
