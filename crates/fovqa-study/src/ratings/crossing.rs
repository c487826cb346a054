//! The largest level whose scores are acceptable (RMFR, Fig. 10).

use serde::Serialize;

use super::scores::Scores;
use crate::Settings;
use crate::bootstrap::{Interval, interval, replicates};
use crate::json::finite;

/// Means that are below the threshold by rounding alone count as equal to it.
const ROUNDING: f64 = 1e-12;

/// The largest acceptable level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Acceptable {
    /// The mean score that an acceptable level has at least, for figures.
    #[serde(skip)]
    pub threshold: f64,
    /// The last of the leading levels whose mean score reaches the threshold. Levels above the first
    /// one that does not reach it are not acceptable, even if their scores are.
    pub largest_level: Option<f64>,
    /// Where the line from that level to the next one crosses the threshold.
    pub crossing: Option<f64>,
    /// Its interval, with participants resampled. A limit is undefined if no level is acceptable
    /// there, or all are.
    pub crossing_ci: Option<Interval>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The largest acceptable level, with its interval.
pub(super) fn acceptable(scores: &Scores<1>, threshold: f64, settings: &Settings) -> Acceptable {
    let everybody: Vec<usize> = (0..scores.means.len()).collect();
    let (largest_level, exact) = crossing(scores, &everybody, threshold);
    let exact = exact.unwrap_or(f64::NEG_INFINITY);
    let crossing_ci = (everybody.len() > 1).then(|| {
        let drawn = replicates(settings, |random| {
            crossing(scores, &random.resample(everybody.len()), threshold).1
        });
        interval(drawn.into_iter().flatten().collect(), settings.confidence)
    });
    let crossing_ci = crossing_ci.flatten();
    let mut reasons = Vec::new();
    if exact == f64::NEG_INFINITY {
        reasons.push("the lowest level does not reach the threshold");
    } else if exact == f64::INFINITY {
        reasons.push("all levels reach the threshold");
    }
    match crossing_ci {
        None if everybody.len() < 2 => reasons.push("one participant has no bootstrap interval"),
        None => reasons.push("there are no bootstrap replicates"),
        Some(limits) if limits.contains(&None) => {
            reasons.push("a limit is undefined where no level reaches the threshold, or all do");
        }
        Some(_) => {}
    }
    Acceptable {
        threshold,
        largest_level,
        crossing: finite(exact),
        crossing_ci,
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    }
}

/// The largest acceptable level of these participants, and the crossing: -∞ if no level is acceptable,
/// ∞ if all are, `None` without scores. Levels without scores are skipped.
fn crossing(
    scores: &Scores<1>,
    participants: &[usize],
    threshold: f64,
) -> (Option<f64>, Option<f64>) {
    let least = threshold - ROUNDING * threshold.abs().max(1.0);
    let mut sums = vec![(0.0, 0.0); scores.conditions.len()];
    for (condition, mean) in participants.iter().flat_map(|&p| &scores.means[p]) {
        let (sum, count) = &mut sums[*condition];
        *sum += mean;
        *count += 1.0;
    }
    let mut last: Option<(f64, f64)> = None;
    let mut has_scores = false;
    for (&[level], (sum, count)) in scores.conditions.iter().zip(sums) {
        if count == 0.0 {
            continue;
        }
        let score = sum / count;
        has_scores = true;
        if score >= least {
            last = Some((level, score));
            continue;
        }
        let Some((below, reached)) = last else { return (None, Some(f64::NEG_INFINITY)) };
        let share = (reached - threshold) / (reached - score);
        return (Some(below), Some(below + share * (level - below)));
    }
    (last.map(|(level, _)| level), has_scores.then_some(f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scores(means: &[&[f64]]) -> Scores<1> {
        Scores {
            conditions: vec![[1.0], [2.0], [4.0]],
            means: means
                .iter()
                .map(|m| m.iter().copied().enumerate().filter(|(_, m)| m.is_finite()).collect())
                .collect(),
        }
    }

    #[test]
    fn the_first_level_below_the_threshold_ends_the_search() {
        let recovers = scores(&[&[3.0, 1.0, 3.0]]);
        assert_eq!(crossing(&recovers, &[0], 2.0), (Some(1.0), Some(1.5)));
        let never = scores(&[&[1.0, 3.0, 3.0]]);
        assert_eq!(crossing(&never, &[0], 2.0), (None, Some(f64::NEG_INFINITY)));
        let always = scores(&[&[2.0, 3.0, 2.0]]);
        assert_eq!(crossing(&always, &[0], 2.0), (Some(4.0), Some(f64::INFINITY)));
    }

    #[test]
    fn levels_without_scores_are_skipped() {
        let gap = scores(&[&[3.0, f64::NAN, 1.0]]);
        assert_eq!(crossing(&gap, &[0], 2.0), (Some(1.0), Some(2.5)));
        let nothing = scores(&[&[f64::NAN; 3]]);
        assert_eq!(crossing(&nothing, &[0], 2.0), (None, None));
    }

    #[test]
    fn a_mean_that_is_equal_but_for_rounding_reaches_the_threshold() {
        let thirds = scores(&[&[2.1, 1.0, 1.0], &[2.2, 1.0, 1.0], &[1.7, 1.0, 1.0]]);
        assert_eq!(crossing(&thirds, &[0, 1, 2], 2.0).0, Some(1.0));
    }

    #[test]
    fn undefined_values_have_a_reason() {
        let one = acceptable(&scores(&[&[3.0, 2.5, 1.0]]), 2.0, &Settings::default());
        assert!(one.crossing.is_some() && one.crossing_ci.is_none() && one.reason.is_some());
        let all = scores(&[&[3.0; 3], &[3.0; 3]]);
        let all = acceptable(&all, 2.0, &Settings { bootstrap: 20, ..Settings::default() });
        assert_eq!((all.crossing, all.crossing_ci), (None, Some([None, None])));
    }
}
