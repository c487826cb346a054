//! Checks the rules of a gate against the values of a run.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_metrics::Better;
use fovqa_plan::{Allowance, GateRule, Quantity, Resolved};

use super::loss::{Loss, Search};
use super::spread_rule;
use super::values::{ComparisonName, FoundValue, Lacking, RunValues};
use crate::baseline::Baseline;

/// The result of a gate.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Name of the experiment.
    pub experiment: String,
    /// The experiment file, as the user named it.
    pub file: String,
    /// The verdict of each rule.
    pub rules: Vec<RuleVerdict>,
    /// The items that could not be scored.
    pub errors: Vec<String>,
    /// The baseline that the run was compared with, of several.
    pub baseline: Option<String>,
    /// The results folder that has pictures of the frames with a loss.
    pub shown_in: Option<String>,
    /// Additional remarks.
    pub notes: Vec<String>,
}

/// The result of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleVerdict {
    /// The rule.
    pub rule: GateRule,
    /// The check of each comparison.
    pub checks: Vec<Check>,
    /// Why there is nothing to check.
    pub failure: Option<String>,
}

/// The check of a rule in one comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Scene, method and eye.
    pub place: ComparisonName,
    /// The band in degrees, if the rule tests each band. The value of a test is the mean of this build's
    /// runs, and the baseline's value the mean of its runs.
    pub band: Option<[f64; 2]>,
    /// The p-value of a test against the spread of repeated runs, after the correction for several tests.
    pub p: Option<f64>,
    /// The value, if there is one.
    pub value: Option<f64>,
    /// The limit with the smallest margin, or with the largest violation.
    pub limit: Option<Limit>,
    /// The worst frame with its value.
    pub worst: Option<(i64, f64)>,
    /// The value of the baseline, if the rule uses it.
    pub baseline: Option<f64>,
    /// Of a rule per frame, the frames that violate it, the worst first.
    pub frames: Vec<FrameCheck>,
    /// If the rule is violated, the frames with the largest loss and where it is, the worst first.
    pub losses: Vec<Loss>,
    /// The result of the check.
    pub outcome: Outcome,
}

/// The check of a rule in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameCheck {
    /// The number of the frame.
    pub frame: i64,
    /// The value.
    pub value: f64,
    /// The value of the baseline, if the rule uses it.
    pub baseline: Option<f64>,
    /// The limit with the smallest margin, or with the largest violation.
    pub limit: Limit,
}

/// A limit and the margin of a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Whether the limit is a minimum rather than a maximum.
    pub at_least: bool,
    /// The limit.
    pub value: f64,
    /// Distance of the value from the limit; negative if the limit is violated.
    pub margin: f64,
}

impl Limit {
    /// Whether the value keeps it. The test is `>=` rather than a negated `<`, so that NaN never does.
    pub fn holds(&self) -> bool {
        self.margin >= 0.0
    }
}

/// The result of a check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The value satisfies the rule.
    Passed,
    /// The value violates the rule. The text explains it.
    Failed(String),
    /// There is no value to check. This never counts as passed.
    NotScored(String),
    /// The rule cannot apply to this run, so the experiment contains a mistake.
    Wrong(String),
}

/// The state of a gate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// Every rule passed.
    Passed,
    /// A rule failed.
    Failed,
    /// Something was not scored.
    NotScored,
    /// A rule is wrong.
    Wrong,
}

impl State {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Failed => "failed",
            Self::NotScored => "not scored",
            Self::Wrong => "wrong",
        }
    }
}

impl Outcome {
    /// The state that corresponds to the outcome.
    pub fn state(&self) -> State {
        match self {
            Self::Passed => State::Passed,
            Self::Failed(_) => State::Failed,
            Self::NotScored(_) => State::NotScored,
            Self::Wrong(_) => State::Wrong,
        }
    }

    /// Why it did not pass.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Passed => None,
            Self::Failed(why) | Self::NotScored(why) | Self::Wrong(why) => Some(why),
        }
    }
}

impl Check {
    /// A check without a value, which passed.
    pub(super) fn of(place: &ComparisonName) -> Self {
        let place = place.clone();
        Self {
            place,
            band: None,
            p: None,
            value: None,
            limit: None,
            worst: None,
            baseline: None,
            frames: Vec::new(),
            losses: Vec::new(),
            outcome: Outcome::Passed,
        }
    }
}

impl RuleVerdict {
    /// The worst state among the checks.
    pub fn state(&self) -> State {
        let checks = self.checks.iter().map(|check| check.outcome.state());
        let failed = self.failure.is_some().then_some(State::Failed);
        checks.chain(failed).max().unwrap_or(State::Failed)
    }

    /// The title of the rule.
    pub fn title(&self) -> String {
        let GateRule { quantity, scene, method, eye, .. } = &self.rule;
        if let Some(name) = &self.rule.name {
            return name.clone();
        }
        let of = [scene.as_deref(), method.as_deref(), eye.as_deref()];
        let of: Vec<&str> = of.into_iter().flatten().collect();
        if of.is_empty() {
            quantity.to_string()
        } else {
            format!("{quantity} of {}", of.join(", "))
        }
    }
}

impl Verdict {
    /// Checks the values of a run against the rules of its experiment and, if the rules use it, against a
    /// baseline. `file` is the name of the experiment file.
    pub fn of(
        experiment: &Resolved,
        file: &str,
        run: &RunValues,
        baseline: Option<&Baseline>,
    ) -> Self {
        let rules = experiment.gates.iter();
        let rules = rules.map(|rule| judged(rule, experiment, run, baseline)).collect();
        let notes = baseline.map(|baseline| strangers(run, baseline)).unwrap_or_default();
        let (experiment, file) = (experiment.name.clone(), file.to_owned());
        let errors = run.errors.clone();
        Self { experiment, file, rules, errors, baseline: None, shown_in: None, notes }
    }

    /// A verdict about nothing, because the gate was not possible.
    pub fn none(file: &str, why: &str) -> Self {
        Self {
            experiment: file.to_owned(),
            file: file.to_owned(),
            rules: Vec::new(),
            errors: vec![why.to_owned()],
            baseline: None,
            shown_in: None,
            notes: Vec::new(),
        }
    }

    /// The state of the whole gate.
    pub fn state(&self) -> State {
        let errors = (!self.errors.is_empty()).then_some(State::NotScored);
        let rules = self.rules.iter().map(RuleVerdict::state);
        // A gate without rules checks nothing, so it does not pass.
        rules.chain(errors).max().unwrap_or(State::Failed)
    }
}

/// Comparisons that only the baseline has. Values that no longer exist cannot be compared.
fn strangers(run: &RunValues, baseline: &Baseline) -> Vec<String> {
    let here: BTreeSet<&ComparisonName> = run.places().collect();
    let gone = baseline.comparisons.iter().filter(|c| !here.contains(&c.place()));
    gone.map(|c| format!("the baseline has {}, but the run does not", c.named())).collect()
}

/// Whether a rule applies to a comparison. A rule that names no eye applies to both eyes together.
pub(super) fn is_of(rule: &GateRule, (scene, method, eye): &ComparisonName) -> bool {
    let wanted = |wanted: &Option<String>, name: &str| wanted.as_ref().is_none_or(|w| w == name);
    let of_eye = match &rule.eye {
        Some(wanted) => wanted == eye,
        None => eye.is_empty() || eye == "both",
    };
    of_eye && wanted(&rule.scene, scene) && wanted(&rule.method, method)
}

fn judged(
    rule: &GateRule,
    experiment: &Resolved,
    run: &RunValues,
    baseline: Option<&Baseline>,
) -> RuleVerdict {
    let places = run.places().filter(|place| is_of(rule, place));
    let mut checks: Vec<Check> = match rule.spread {
        Some(test) => spread_rule::checks(rule, test, run, baseline),
        None => places.map(|place| check(rule, run, place, baseline)).collect(),
    };
    for check in &mut checks {
        let is_failed = matches!(check.outcome, Outcome::Failed(_)) || !check.frames.is_empty();
        if is_failed && check.value.is_some() {
            let scene = experiment.scenes.iter().find(|scene| scene.name == check.place.0);
            let search = Search { run, baseline, fps: scene.and_then(|scene| scene.fps) };
            let failing: Vec<i64> = check.frames.iter().map(|frame| frame.frame).collect();
            let band_deg = check.band.or(rule.quantity.band_deg);
            let quantity = Quantity { band_deg, ..rule.quantity.clone() };
            check.losses = search.losses(&quantity, &check.place, &failing);
        }
    }
    let nothing =
        checks.is_empty().then(|| "the rule applies to no comparison of the run".to_owned());
    // If a comparison that the rule applies to no longer exists, the rule does not pass either.
    let lost = baseline.filter(|_| rule.needs_baseline()).and_then(|baseline| {
        let gone = baseline.comparisons.iter().find(|c| {
            let place = c.place();
            is_of(rule, &place) && !run.places().any(|here| *here == place)
        });
        gone.map(|c| format!("the baseline has {}, but the run does not", c.named()))
    });
    RuleVerdict { rule: rule.clone(), checks, failure: nothing.or(lost) }
}

impl From<Lacking> for Outcome {
    fn from(lacking: Lacking) -> Self {
        match lacking {
            Lacking::Band(why) => Self::Wrong(why),
            Lacking::NotScored(why) => Self::NotScored(why),
            Lacking::Nothing(why) => Self::Failed(why),
        }
    }
}

fn check(
    rule: &GateRule,
    run: &RunValues,
    place: &ComparisonName,
    baseline: Option<&Baseline>,
) -> Check {
    let mut check = Check::of(place);
    let checked = if rule.quantity.per_frame {
        check_frames(&mut check, rule, run, baseline)
    } else {
        check_value(&mut check, rule, run, baseline)
    };
    check.outcome = checked.err().unwrap_or(Outcome::Passed);
    if run.errors_of(place) > 0 && check.outcome == Outcome::Passed {
        let errors = run.errors_of(place);
        let why = format!("{errors} of its frames could not be scored");
        check.outcome = Outcome::NotScored(why);
    }
    check
}

/// Checks the value of a comparison. The error is the outcome of a check that does not pass.
fn check_value(
    check: &mut Check,
    rule: &GateRule,
    run: &RunValues,
    baseline: Option<&Baseline>,
) -> Result<(), Outcome> {
    let place = &check.place;
    let found = run.of(place, &rule.quantity)?;
    check.value = Some(found.value);
    let before = rule.needs_baseline().then(|| match baseline {
        None => Err(NO_BASELINE.to_owned()),
        Some(baseline) => baseline.value(place, &rule.quantity),
    });
    check.baseline = before.transpose().map_err(Outcome::Failed)?;
    let frames = run.frames_of(place);
    if let Some(was) =
        baseline.filter(|_| check.baseline.is_some()).and_then(|b| b.frames_of(place))
        && was != frames
    {
        let why = format!("the baseline has {was} frames, but the run has {frames}");
        return Err(Outcome::NotScored(why));
    }
    check.limit = tightest(rule, found.value, check.baseline);
    check.worst = worst(&found, rule, check.limit);
    match check.limit {
        Some(limit) if limit.holds() => Ok(()),
        Some(limit) => Err(Outcome::Failed(broken(rule, limit, found.value, check.baseline))),
        None => Err(Outcome::Failed(NO_LIMIT.to_owned())),
    }
}

/// Checks each frame of a comparison. The value of the check is that of the frame with the smallest
/// margin.
fn check_frames(
    check: &mut Check,
    rule: &GateRule,
    run: &RunValues,
    baseline: Option<&Baseline>,
) -> Result<(), Outcome> {
    let place = &check.place;
    let frames = run.frames(place, &rule.quantity)?;
    let mut before = BTreeMap::new();
    let mut lacking = None;
    if rule.needs_baseline() {
        let baseline = baseline.ok_or_else(|| Outcome::Failed(NO_BASELINE.to_owned()))?;
        before = baseline.frames(place, &rule.quantity).map_err(Outcome::Failed)?;
        let numbers: BTreeSet<i64> = frames.iter().map(|(frame, _)| *frame).collect();
        let known: BTreeSet<i64> = before.keys().copied().collect();
        lacking = known.symmetric_difference(&numbers).min().map(|frame| {
            let (has, lacks) =
                if numbers.contains(frame) { ("run", "baseline") } else { ("baseline", "run") };
            let quantity = &rule.quantity;
            format!("the {has} has {quantity} of frame {frame}, but the {lacks} does not")
        });
    }
    let mut checks = Vec::with_capacity(frames.len());
    for (frame, value) in frames {
        let baseline = before.get(&frame).copied();
        if rule.needs_baseline() && baseline.is_none() {
            continue;
        }
        let limit = tightest(rule, value, baseline);
        let limit = limit.ok_or_else(|| Outcome::Failed(NO_LIMIT.to_owned()))?;
        checks.push(FrameCheck { frame, value, baseline, limit });
    }
    checks.sort_by(|a, b| a.limit.margin.total_cmp(&b.limit.margin).then(a.frame.cmp(&b.frame)));
    let nothing = |why: Option<String>| why.map_or(Ok(()), |why| Err(Outcome::NotScored(why)));
    let Some(worst) = checks.first().copied() else { return nothing(lacking) };
    let of = checks.len();
    check.value = Some(worst.value);
    check.baseline = worst.baseline;
    check.limit = Some(worst.limit);
    check.worst = Some((worst.frame, worst.value));
    check.frames = checks.into_iter().filter(|check| !check.limit.holds()).collect();
    if check.frames.is_empty() {
        return nothing(lacking);
    }
    let failing = check.frames.len();
    let broken = broken(rule, worst.limit, worst.value, worst.baseline);
    let why = if of == 1 {
        format!("frame {} fails: {broken}", worst.frame)
    } else {
        let verb = if failing == 1 { "fails" } else { "fail" };
        format!("{failing} of {of} frames {verb}, worst is frame {}: {broken}", worst.frame)
    };
    // What fails is told although there is no verdict.
    Err(match lacking {
        Some(lacking) => Outcome::NotScored(format!("{lacking}; {why}")),
        None => Outcome::Failed(why),
    })
}

const NO_BASELINE: &str = "there is no baseline";
const NO_LIMIT: &str = "the rule has no limit";

fn broken(rule: &GateRule, limit: Limit, value: f64, before: Option<f64>) -> String {
    let side = if limit.at_least { "below" } else { "above" };
    let baseline = before.map(|before| format!(" (baseline {before})")).unwrap_or_default();
    format!("{} is {value}, {side} {}{baseline}", rule.quantity, limit.value)
}

/// The limit with the smallest margin.
fn tightest(rule: &GateRule, value: f64, before: Option<f64>) -> Option<Limit> {
    limits(rule, value, before).into_iter().reduce(|a, b| if b.margin < a.margin { b } else { a })
}

/// The limits of a rule, given the value and the value of the baseline.
fn limits(rule: &GateRule, value: f64, before: Option<f64>) -> Vec<Limit> {
    // If both are infinite, neither is better.
    let apart = |a: f64, b: f64| if a.to_bits() == b.to_bits() { 0.0 } else { a - b };
    let least = |limit: f64| Limit { at_least: true, value: limit, margin: apart(value, limit) };
    let most = |limit: f64| Limit { at_least: false, value: limit, margin: apart(limit, value) };
    let moved = |allowance: Option<Allowance>, sign: f64| {
        let (allowance, before) = allowance.zip(before)?;
        let limit = before + sign * allowance.of(before);
        // A share of infinity is not a number; the limit is then the baseline itself.
        Some(if limit.is_nan() { before } else { limit })
    };
    [
        rule.at_least.map(least),
        rule.at_most.map(most),
        moved(rule.max_drop, -1.0).map(least),
        moved(rule.max_rise, 1.0).map(most),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The worst frame in the direction of the rule. If the rule has no direction, it is the frame
/// nearest to its limit.
fn worst(found: &FoundValue, rule: &GateRule, limit: Option<Limit>) -> Option<(i64, f64)> {
    let low = match rule.quantity.better() {
        Better::Higher => true,
        Better::Lower => false,
        Better::Neither => limit.is_none_or(|limit| limit.at_least),
    };
    let worse = |a: (i64, f64), b: (i64, f64)| {
        let is_worse = if low { b.1 < a.1 } else { b.1 > a.1 };
        if is_worse { b } else { a }
    };
    found.frames.iter().copied().reduce(worse)
}
