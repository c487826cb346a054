//! The exact power of the binomial test of one pair, and the trials that a study needs.

use serde::Serialize;

use super::document::Plan;
use crate::Settings;
use crate::distributions::{
    binomial_at_least, binomial_at_most, clopper_pearson, half_two_sided, normal_quantile,
};
use crate::options::Alternative;

/// The most trials that are tried.
const MOST_TRIALS: u64 = 1_000_000;
/// p-values that exceed the level of significance by rounding alone count as equal to it.
const ROUNDING: f64 = 1e-12;
/// Below this many trials, the search starts from 1; above it, from a share of the normal
/// approximation, since power grows almost steadily there.
const EXHAUSTIVE: f64 = 2000.0;
/// That share.
const START: f64 = 0.9;
/// The most numbers of trials in a curve of the power.
const MOST_POINTS: u64 = 300;
/// The trials of a curve if no number of trials has the wanted power.
const LEAST_SHOWN: u64 = 200;

/// What a pairwise comparison is planned for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairsOptions {
    /// The true share of votes, between 0 and 1.
    pub share: f64,
    /// The level of significance, between 0 and 1.
    pub alpha: f64,
    /// The power that the study must have, between 0 and 1.
    pub power: f64,
    /// What the test looks for.
    pub alternative: Alternative,
    /// A number of trials whose power is reported.
    pub trials: Option<u64>,
    /// The width of the interval of the share that is wanted, between 0 and 1.
    pub width: Option<f64>,
}

/// The trials that pairwise comparisons need.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairsPlan {
    /// The least number of trials of a pair with the wanted power.
    pub trials: Option<u64>,
    /// The power with that number.
    pub power: Option<f64>,
    /// The power with the requested number of trials.
    pub power_at_trials: Option<f64>,
    /// The least number of trials with an interval (Clopper and Pearson) that is no wider than
    /// requested.
    pub trials_for_width: Option<u64>,
    /// The power that was asked for, for figures.
    #[serde(skip)]
    pub required: f64,
    /// Numbers of trials and their power, for figures: up to half as many again as are needed.
    #[serde(skip)]
    pub curve: Vec<(u64, f64)>,
    /// The requested number of trials, for figures.
    #[serde(skip)]
    pub requested: Option<u64>,
    /// The requested width, for tables.
    #[serde(skip)]
    pub width: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Plans pairwise comparisons.
pub fn plan_pairs(options: &PairsOptions, settings: &Settings) -> Plan<PairsPlan> {
    let found = least_trials(options);
    let trials_for_width =
        options.width.and_then(|width| trials_for_width(options, width, settings.confidence));
    let mut reasons = Vec::new();
    if found.is_none() {
        reasons.push(format!("the power is not reached with {MOST_TRIALS} trials"));
    }
    if options.trials.is_none() {
        reasons.push("without --trials there is no power_at_trials".to_owned());
    }
    match options.width {
        None => reasons.push("without --width there is no trials_for_width".to_owned()),
        Some(_) if trials_for_width.is_none() => {
            reasons.push(format!("the width is not reached with {MOST_TRIALS} trials"));
        }
        Some(_) => {}
    }
    let result = PairsPlan {
        trials: found.map(|(trials, _)| trials),
        power: found.map(|(_, power)| power),
        power_at_trials: options.trials.map(|trials| power(options, trials, None).0),
        trials_for_width,
        required: options.power,
        curve: curve(options, found.map(|(trials, _)| trials)),
        requested: options.trials,
        width: options.width,
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    };
    Plan::new("pairs", result)
}

/// The power with numbers of trials from 1: up to half as many again as are needed, and as are
/// requested. With many trials, they are equally spaced.
fn curve(options: &PairsOptions, needed: Option<u64>) -> Vec<(u64, f64)> {
    let most = needed.unwrap_or(LEAST_SHOWN).max(options.trials.unwrap_or(0)).max(LEAST_SHOWN / 10);
    let last = (most.saturating_mul(3) / 2).min(MOST_TRIALS);
    let step = last.div_ceil(MOST_POINTS).max(1);
    let all = (1..=last).step_by(step as usize).chain(needed);
    let mut trials: Vec<u64> = all.collect();
    trials.sort_unstable();
    trials.dedup();
    trials.into_iter().map(|n| (n, power(options, n, None).0)).collect()
}

/// The power with n trials, and the least k that is significant on the upper side (n + 1 if none is).
/// The search for k starts at `near`.
fn power(options: &PairsOptions, n: u64, near: Option<u64>) -> (f64, u64) {
    let p_value = |k: u64| match options.alternative {
        Alternative::Greater => binomial_at_least(k, n, 0.5),
        Alternative::TwoSided => half_two_sided(k, n),
    };
    let is_significant =
        |k: u64| 2 * k >= n && k <= n && p_value(k) <= options.alpha * (1.0 + ROUNDING);
    let mut k = near.unwrap_or_else(|| guess(options, n)).min(n + 1);
    while k > 0 && is_significant(k - 1) {
        k -= 1;
    }
    while k <= n && !is_significant(k) {
        k += 1;
    }
    let upper = if k > n { 0.0 } else { binomial_at_least(k, n, options.share) };
    let lower = match options.alternative {
        Alternative::Greater => 0.0,
        Alternative::TwoSided if k > n => 0.0,
        // All counts are significant: none is counted twice.
        Alternative::TwoSided if 2 * k <= n => return (1.0, k),
        Alternative::TwoSided => binomial_at_most(n - k, n, options.share),
    };
    ((upper + lower).min(1.0), k)
}

/// About the least significant count, by the normal approximation.
fn guess(options: &PairsOptions, n: u64) -> u64 {
    let n = n as f64;
    let tail = match options.alternative {
        Alternative::Greater => options.alpha,
        Alternative::TwoSided => 0.5 * options.alpha,
    };
    (0.5 * n - 0.5 * n.sqrt() * normal_quantile(tail)).clamp(0.0, n + 1.0) as u64
}

/// The least number of trials with the wanted power, and its power.
fn least_trials(options: &PairsOptions) -> Option<(u64, f64)> {
    let effect = match options.alternative {
        Alternative::Greater => options.share - 0.5,
        Alternative::TwoSided => (options.share - 0.5).abs(),
    };
    let tail = match options.alternative {
        Alternative::Greater => options.alpha,
        Alternative::TwoSided => 0.5 * options.alpha,
    };
    // Cohen (1988): the normal approximation.
    let spread = libm::sqrt(options.share * (1.0 - options.share));
    let sum = -0.5 * normal_quantile(tail) + spread * normal_quantile(options.power);
    let about = if effect > 0.0 && sum > 0.0 { (sum / effect) * (sum / effect) } else { 0.0 };
    if effect <= 0.0 && options.power > options.alpha || about > 2.0 * MOST_TRIALS as f64 {
        return None;
    }
    let start = if about > EXHAUSTIVE { (START * about) as u64 } else { 1 };
    let mut near = None;
    for n in start..=MOST_TRIALS {
        let (power, k) = power(options, n, near);
        if power >= options.power {
            return Some((n, power));
        }
        near = Some(k);
    }
    None
}

/// The least number of trials with an interval of the share that is no wider.
fn trials_for_width(options: &PairsOptions, width: f64, confidence: f64) -> Option<u64> {
    let z = normal_quantile(0.5 + 0.5 * confidence);
    let about = 4.0 * z * z * options.share * (1.0 - options.share) / (width * width);
    if about > 2.0 * MOST_TRIALS as f64 {
        return None;
    }
    let start = if about > EXHAUSTIVE { (START * about) as u64 } else { 1 };
    (start..=MOST_TRIALS).find(|&n| {
        let k = ((n as f64 * options.share + 0.5).floor() as u64).min(n);
        let [low, high] = clopper_pearson(k, n, confidence);
        high - low <= width
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(share: f64, alpha: f64, power: f64, alternative: Alternative) -> PairsOptions {
        PairsOptions { share, alpha, power, alternative, trials: None, width: None }
    }

    #[test]
    fn the_power_of_few_trials_is_that_of_counting() {
        // One-sided at .05, 5 trials: only 5 of 5 (p = 1/32) is significant.
        let one = options(0.8, 0.05, 0.8, Alternative::Greater);
        assert!((power(&one, 5, None).0 - 0.8_f64.powi(5)).abs() < 1e-14);
        // p is equal to alpha.
        let equal = options(0.8, 0.03125, 0.8, Alternative::Greater);
        assert_eq!(power(&equal, 5, None).1, 5);
        // Two-sided, 6 trials: 0 and 6 (p = 1/32).
        let two = options(0.8, 0.05, 0.8, Alternative::TwoSided);
        let expected = 0.8_f64.powi(6) + 0.2_f64.powi(6);
        assert!((power(&two, 6, None).0 - expected).abs() < 1e-14);
        assert_eq!(power(&two, 5, None), (0.0, 6));
    }

    #[test]
    fn the_least_number_of_trials_is_the_first_with_the_power() {
        for alternative in [Alternative::Greater, Alternative::TwoSided] {
            let options = options(0.7, 0.05, 0.8, alternative);
            let (trials, _) = least_trials(&options).unwrap();
            let all: Vec<bool> = (1..=trials).map(|n| power(&options, n, None).0 >= 0.8).collect();
            assert!(all[all.len() - 1] && !all[..all.len() - 1].contains(&true));
        }
    }

    #[test]
    fn a_share_of_one_half_is_never_shown() {
        let plan =
            plan_pairs(&options(0.5, 0.05, 0.8, Alternative::TwoSided), &Settings::default());
        assert!(plan.result.trials.is_none() && plan.result.reason.is_some());
    }

    #[test]
    fn the_curve_of_the_power_crosses_the_wanted_one_where_it_says() {
        let plan =
            plan_pairs(&options(0.7, 0.05, 0.8, Alternative::TwoSided), &Settings::default());
        let PairsPlan { curve, trials, required, .. } = plan.result;
        let first = curve.iter().find(|(_, power)| *power >= required).unwrap();
        assert_eq!(Some(first.0), trials);
        let small = options(0.51, 0.05, 0.8, Alternative::TwoSided);
        assert!(plan_pairs(&small, &Settings::default()).result.curve.len() <= 302);
        let never = options(0.5, 0.05, 0.8, Alternative::TwoSided);
        assert!(plan_pairs(&never, &Settings::default()).result.curve.len() >= 200);
    }

    #[test]
    fn small_effects_need_many_trials() {
        let (trials, power) =
            least_trials(&options(0.51, 0.05, 0.8, Alternative::TwoSided)).unwrap();
        assert!((19_000..20_500).contains(&trials) && power >= 0.8, "{trials}");
    }
}
