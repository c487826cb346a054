//! Proposes limits from repeated renders of one build. The natural variation of a value determines
//! how far the limit must be from it, for a stated rate of false alarms.

use fovqa_metrics::Better;
use fovqa_plan::{GateRule, Quantity};

use super::noise::{Spread, enough_runs, rounding_noise, widening};
use super::values::{ComparisonName, Lacking, RunValues};
use super::verdict::is_of;

/// The rate of false alarms if none is given.
pub const FALSE_ALARMS: f64 = 0.01;

/// Proposed limits for a gate, from repeated runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// Number of runs, at least 2.
    pub runs: usize,
    /// The probability that a new run of an unchanged build fails any of the limits, if the values
    /// of runs are normally distributed.
    pub false_alarms: f64,
    /// One proposal per rule and comparison.
    pub proposals: Vec<Proposal>,
}

/// A proposed limit for a value of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// Scene, method and eye.
    pub place: ComparisonName,
    /// The value.
    pub quantity: Quantity,
    /// Whether the rule compares the value with a baseline.
    pub relative: bool,
    /// Smallest value among the runs.
    pub min: f64,
    /// Largest value among the runs.
    pub max: f64,
    /// The observed range: the largest value minus the smallest; of a rule per frame, the largest range of
    /// a frame.
    pub range: f64,
    /// Mean of the values.
    pub mean: f64,
    /// Standard deviation over the runs (divisor n - 1).
    pub deviation: f64,
    /// The limits. There are none if a value is infinite, because it has no distance from other
    /// values.
    pub limits: Vec<ProposedLimit>,
}

/// A limit of a proposal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProposedLimit {
    /// The smallest allowed value.
    AtLeast(f64),
    /// The largest allowed value.
    AtMost(f64),
    /// How far the value may fall below that of the baseline.
    MaxDrop(f64),
    /// How far the value may rise above that of the baseline.
    MaxRise(f64),
}

/// Proposes limits for rules from the values of repeated runs. Each run has a name. `false_alarms` is
/// the probability, above 0 and at most 0.5, that a new run of the same build fails any of the limits.
///
/// # Errors
/// If a run lacks a value.
pub fn calibrate(
    rules: &[GateRule],
    runs: &[(String, RunValues)],
    false_alarms: f64,
) -> Result<Calibration, Lacking> {
    let mut proposals: Vec<(Proposal, Samples)> = Vec::new();
    let places = runs.first().map(|(_, first)| first.places()).into_iter().flatten();
    let places: Vec<&ComparisonName> = places.collect();
    for rule in rules {
        for place in places.iter().filter(|place| is_of(rule, place)) {
            let row = |(name, run): &(String, RunValues)| {
                let found = row(run, place, &rule.quantity);
                found.map_err(|lacking| lacking.within(&format!("{name}: {}", named(place))))
            };
            let samples = Samples::of(runs.iter().map(row).collect::<Result<_, _>>()?);
            let proposal = Proposal::new(rule, place, &samples);
            if !proposals.iter().any(|(known, _)| *known == proposal) {
                proposals.push((proposal, samples));
            }
        }
    }
    let proposals = with_limits(proposals, false_alarms);
    Ok(Calibration { runs: runs.len(), false_alarms, proposals })
}

/// The value of a run, or the values of its frames.
fn row(run: &RunValues, place: &ComparisonName, quantity: &Quantity) -> Result<Vec<f64>, Lacking> {
    if quantity.per_frame {
        let frames = run.frames(place, quantity)?;
        return Ok(frames.into_iter().map(|(_, value)| value).collect());
    }
    Ok(vec![run.of(place, quantity)?.value])
}

/// Adds the limits. The rate of false alarms is divided equally among all of them (Bonferroni).
fn with_limits(proposals: Vec<(Proposal, Samples)>, false_alarms: f64) -> Vec<Proposal> {
    let count: usize = proposals.iter().map(|(proposal, samples)| proposal.count(samples)).sum();
    let share = false_alarms / count.max(1) as f64;
    let with_limits = |(proposal, samples): (Proposal, Samples)| Proposal {
        limits: proposal.limits(&samples, share),
        ..proposal
    };
    proposals.into_iter().map(with_limits).collect()
}

/// Scene, method and eye in words.
pub(super) fn named((scene, method, eye): &ComparisonName) -> String {
    let eye = if eye.is_empty() { String::new() } else { format!(", {eye}") };
    format!("{scene}, {method}{eye}")
}

/// The values of all runs, a row for each.
struct Samples {
    min: f64,
    max: f64,
    mean: f64,
    /// The lowest and the highest mean of a frame over the runs.
    means: [f64; 2],
    /// The largest range of a frame over the runs.
    range: f64,
    /// `None` if a value is infinite, or there is a single run, or the runs have different frames.
    spread: Option<Spread>,
}

impl Samples {
    fn of(mut rows: Vec<Vec<f64>>) -> Self {
        let frames = rows.first().map_or(0, Vec::len);
        if frames > 1 && rows.iter().all(|row| row.len() == frames) {
            // A frame that is identical to its reference in every run does not vary.
            let is_kept: Vec<bool> = (0..frames)
                .map(|frame| rows.iter().any(|row| row[frame] < f64::INFINITY))
                .collect();
            for row in &mut rows {
                let mut kept = is_kept.iter();
                row.retain(|_| kept.next() == Some(&true));
            }
        }
        let spread = Spread::of_frames(&rows);
        let ends = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], value| {
                [min.min(value), max.max(value)]
            })
        };
        let count = rows.first().map_or(0, Vec::len);
        let of_frame = |frame: usize| rows.iter().filter_map(move |row| row.get(frame).copied());
        let mean_of = |frame| of_frame(frame).sum::<f64>() / rows.len() as f64;
        let range_of = |frame| {
            let [min, max] = ends(&mut of_frame(frame));
            if min.to_bits() == max.to_bits() { 0.0 } else { max - min }
        };
        let [min, max] = ends(&mut rows.iter().flatten().copied());
        Self {
            min,
            max,
            mean: (0..count).map(mean_of).sum::<f64>() / count.max(1) as f64,
            means: ends(&mut (0..count).map(mean_of)),
            range: (0..count).map(range_of).fold(0.0, f64::max),
            spread,
        }
    }
}

impl Proposal {
    fn new(rule: &GateRule, place: &ComparisonName, samples: &Samples) -> Self {
        Self {
            place: place.clone(),
            quantity: rule.quantity.clone(),
            relative: rule.needs_baseline(),
            min: samples.min,
            max: samples.max,
            range: samples.range,
            mean: samples.mean,
            deviation: samples.spread.map_or(0.0, |spread| spread.deviation),
            limits: Vec::new(),
        }
    }

    /// The number of limits.
    fn count(&self, samples: &Samples) -> usize {
        match (samples.spread, self.quantity.better()) {
            (None, _) => 0,
            (Some(_), Better::Neither) => 2,
            (Some(_), Better::Higher | Better::Lower) => 1,
        }
    }

    /// The limits, each of which a new run fails with a probability of `share`. No limit is stricter
    /// than any of the runs, and differences within rounding noise never fail.
    fn limits(&self, samples: &Samples, share: f64) -> Vec<ProposedLimit> {
        let Some(spread) = samples.spread else { return Vec::new() };
        let noise = rounding_noise(&self.quantity, self.min.abs().max(self.max.abs()));
        let margin = spread.of_new_run(share);
        let at_least = || {
            let [lowest, _] = samples.means;
            let limit = (lowest - margin).min(self.min - noise);
            ProposedLimit::AtLeast(rounded(limit, lowest - limit, f64::floor))
        };
        let at_most = || {
            let [_, highest] = samples.means;
            let limit = (highest + margin).max(self.max + noise);
            ProposedLimit::AtMost(rounded(limit, limit - highest, f64::ceil))
        };
        let allowance = || {
            let allowance = spread.of_two_new_runs(share).max(samples.range + noise);
            rounded(allowance, allowance, f64::ceil)
        };
        match (self.quantity.better(), self.relative) {
            (Better::Higher, false) => vec![at_least()],
            (Better::Lower, false) => vec![at_most()],
            (Better::Higher, true) => vec![ProposedLimit::MaxDrop(allowance())],
            (Better::Lower, true) => vec![ProposedLimit::MaxRise(allowance())],
            (Better::Neither, _) => vec![at_least(), at_most()],
        }
    }
}

impl Calibration {
    /// The number of limits.
    pub fn limits(&self) -> usize {
        self.proposals.iter().map(|proposal| proposal.limits.len()).sum()
    }

    /// Describes the number of runs, the rate of false alarms and, if there are few runs, how wide
    /// that makes the limits.
    pub fn in_words(&self) -> String {
        let (runs, rate, limits) = (self.runs, self.false_alarms, self.limits());
        let all = if limits == 1 {
            "its limit".to_owned()
        } else {
            format!("all {limits} limits together")
        };
        let text = format!(
            "{runs} repeated runs of one build. A new run of that build fails with a probability of at most {rate} \
             for {all}, if values are normally distributed"
        );
        match self.few_runs() {
            None => text,
            Some(few) => format!("{text}. {few}"),
        }
    }

    /// How wide few runs make the limits, and how many runs are enough; `None` if they are.
    fn few_runs(&self) -> Option<String> {
        let (runs, limits) = (self.runs, self.limits());
        let share = self.false_alarms / limits.max(1) as f64;
        let enough = enough_runs(share);
        if runs < 2 || runs >= enough || limits == 0 {
            return None;
        }
        let times = widening(runs, share);
        let times = if times < 10.0 { format!("{times:.1}") } else { format!("{times:.0}") };
        Some(format!(
            "{runs} runs say little about the noise, so the limits are {times} times as wide as very many runs \
             would make them; from {enough} runs they would be at most twice as wide"
        ))
    }
}

/// Rounds a value to the second significant digit of its margin, which must be above 0.
fn rounded(value: f64, margin: f64, round: impl Fn(f64) -> f64) -> f64 {
    if !value.is_finite() || !margin.is_finite() || margin <= 0.0 {
        return value;
    }
    let digits = 1 - libm::floor(libm::log10(margin)) as i32;
    // Dividing by a power of ten above one gives quotients that print with few digits.
    let power = libm::pow(10.0, f64::from(digits.abs()));
    if power.is_infinite() {
        return value;
    }
    // A number that differs from an integer only by rounding errors counts as that integer.
    let round = |value: f64| {
        let whole = value.round();
        if (value - whole).abs() < 1e-6 { whole } else { round(value) }
    };
    if digits >= 0 { round(value * power) / power } else { round(value / power) * power }
}

#[cfg(test)]
mod tests;
