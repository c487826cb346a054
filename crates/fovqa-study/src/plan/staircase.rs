//! Simulated studies with adaptive staircases.

use rayon::prelude::*;
use serde::Serialize;

use super::document::Plan;
use crate::bootstrap::{Interval, interval};
use crate::json::finite;
use crate::moments::{Moments, mean, sd};
use crate::options::LevelMean;
use crate::psychometric::{Curve, Model};
use crate::random::Replicate;
use crate::staircase::{self, reversals, threshold};
use crate::{Settings, StudyError};

/// A study with staircases.
#[derive(Debug, Clone, PartialEq)]
pub struct StaircaseOptions {
    /// Participants of a study, 1 or more.
    pub participants: usize,
    /// Trials of a participant, 1 or more.
    pub trials: usize,
    /// The mean of the true thresholds m, as a level.
    pub threshold: f64,
    /// The width w of the true functions; for `weibull`, in the logarithm of the level.
    pub width: f64,
    /// The true rate of lapses.
    pub lapse: f64,
    /// The standard deviation of m between participants; for `weibull`, of ln m.
    pub between_sd: f64,
    /// The kind of function.
    pub model: Model,
    /// The first level.
    pub start: f64,
    /// The sizes of steps; the last one is for all further reversals. One or more.
    pub steps: Vec<f64>,
    /// The lowest level.
    pub lowest: Option<f64>,
    /// The highest level.
    pub highest: Option<f64>,
    /// Correct answers in a row before a harder level, 1 or more.
    pub down: u32,
    /// Simulated studies.
    pub studies: usize,
    /// How a threshold follows from the reversals.
    pub reversals: staircase::Options,
}

/// How precise the threshold of a study is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StaircasePlan {
    /// The performance to which the staircase converges: ½^(1/down).
    pub target_performance: f64,
    /// The level of that performance at the mean threshold.
    pub target_level: Option<f64>,
    /// The mean of the thresholds of the studies.
    pub mean: Option<f64>,
    /// Their standard deviation.
    pub sd: Option<f64>,
    /// The interval that contains the given share of them.
    pub interval: Option<Interval>,
    /// The mean of the half widths of the t intervals of the studies.
    pub mean_half_width: Option<f64>,
    /// The number of studies in which a participant has no threshold.
    pub failed: usize,
    /// The staircase of the first participant of the first study.
    pub first: First,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A simulated staircase.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct First {
    /// The level of each trial.
    pub levels: Vec<f64>,
    /// 1 for each correct answer, and 0 for each wrong one.
    pub correct: Vec<u8>,
}

/// Simulates studies. Study s uses the random numbers of replicate s.
///
/// # Errors
///
/// If the options do not fit together: the lowest level is above the highest one, the rates of guesses
/// and lapses leave nothing for the function, or a level is not above 0 where its logarithm is needed.
pub fn plan_staircase(
    options: &StaircaseOptions,
    settings: &Settings,
) -> Result<Plan<StaircasePlan>, StudyError> {
    options.check()?;
    let study = |s: usize| options.study(&mut Replicate::new(settings.seed, s as u64), settings);
    let studies: Vec<Option<Study>> = (0..options.studies).into_par_iter().map(study).collect();
    let found: Vec<&Study> = studies.iter().flatten().collect();
    let thresholds: Vec<f64> = found.iter().map(|study| study.threshold).collect();
    let half_widths: Vec<f64> = found.iter().filter_map(|study| study.half_width).collect();
    let target_performance = libm::pow(0.5, 1.0 / f64::from(options.down));
    let target_level = options
        .model
        .x_of(target_performance, &options.curve(0.0))
        .map(|x| options.model.sigmoid.level(x))
        .and_then(finite);
    let mut reasons = Vec::new();
    if target_level.is_none() {
        reasons.push("the function does not reach the target performance");
    }
    if found.len() < 2 {
        reasons.push("fewer than two studies have a threshold of every participant");
    } else if half_widths.is_empty() {
        reasons.push("the threshold of one participant has no t interval");
    }
    let result = StaircasePlan {
        target_performance,
        target_level,
        mean: mean(&thresholds),
        sd: sd(&thresholds),
        mean_half_width: mean(&half_widths),
        failed: studies.len() - found.len(),
        interval: interval(thresholds, settings.confidence),
        first: options.first(settings.seed),
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    };
    Ok(Plan::new("staircase", result))
}

/// The result of one study.
struct Study {
    threshold: f64,
    half_width: Option<f64>,
}

impl StaircaseOptions {
    fn check(&self) -> Result<(), StudyError> {
        let setting = |message: String, help: &str| {
            Err(StudyError::Options { message, help: help.to_owned() })
        };
        if let (Some(low), Some(high)) = (self.lowest, self.highest)
            && low > high
        {
            let message = format!("--lowest {low} is above --highest {high}");
            return setting(message, "exchange the two levels");
        }
        if self.model.guess + self.lapse >= 1.0 {
            let (guess, lapse) = (self.model.guess, self.lapse);
            let message = format!("--guess {guess} and --lapse {lapse} add up to 1 or more");
            return setting(message, "the function needs a range between them");
        }
        if self.model.sigmoid.is_logarithmic() && self.threshold <= 0.0 {
            let message = format!("--threshold {} is not above 0", self.threshold);
            return setting(message, "--sigmoid weibull needs levels above 0");
        }
        let needs_logarithm =
            self.model.sigmoid.is_logarithmic() || self.reversals.mean == LevelMean::Geometric;
        let lowest = self.lowest.unwrap_or(f64::NEG_INFINITY).min(self.start);
        if needs_logarithm && lowest <= 0.0 {
            let message = "levels may reach 0, which has no logarithm".to_owned();
            return setting(message, "set --start and --lowest to levels above 0");
        }
        Ok(())
    }

    /// The function of a participant whose threshold is `z` standard deviations above the mean.
    fn curve(&self, z: f64) -> Curve {
        let position = self.model.sigmoid.scale(self.threshold) + self.between_sd * z;
        Curve { position, width: self.width, lapse: self.lapse }
    }

    fn clamped(&self, level: f64) -> f64 {
        let level = self.lowest.map_or(level, |lowest| level.max(lowest));
        self.highest.map_or(level, |highest| level.min(highest))
    }

    /// The staircase of one participant.
    fn run(&self, random: &mut Replicate) -> First {
        let curve = self.curve(random.normal());
        let harder = -self.model.direction.sign();
        let mut level = self.clamped(self.start);
        let (mut count, mut turns, mut last_move) = (0, 0, 0.0);
        let mut out = First::default();
        for _ in 0..self.trials {
            let chance = self.model.performance(&curve, self.model.sigmoid.scale(level));
            let is_correct = random.bernoulli(chance);
            out.levels.push(level);
            out.correct.push(u8::from(is_correct));
            count = if is_correct { count + 1 } else { 0 };
            if is_correct && count < self.down {
                continue;
            }
            count = 0;
            let direction = if is_correct { harder } else { -harder };
            if last_move * direction < 0.0 {
                turns += 1;
            }
            last_move = direction;
            let size = self.steps.get(turns).or(self.steps.last()).copied().unwrap_or(0.0);
            level = self.clamped(level + direction * size);
        }
        out
    }

    /// One study; `None` if a participant has no threshold.
    fn study(&self, random: &mut Replicate, settings: &Settings) -> Option<Study> {
        let options = &self.reversals;
        let thresholds: Vec<Option<f64>> = (0..self.participants)
            .map(|_| {
                let levels = self.run(random).levels;
                threshold(&levels, &reversals(&levels), options).threshold
            })
            .collect();
        let scaled: Option<Vec<f64>> =
            thresholds.into_iter().map(|level| level.map(|l| options.mean.scale(l))).collect();
        let moments = Moments::of(&scaled?, settings.confidence);
        let level = |value: f64| options.mean.level(value);
        let half_width = moments.ci.map(|[low, high]| 0.5 * (level(high) - level(low)));
        Some(Study { threshold: level(moments.mean?), half_width })
    }

    fn first(&self, seed: u64) -> First {
        self.run(&mut Replicate::new(seed, 0))
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;
    use crate::options::Direction;

    fn options() -> StaircaseOptions {
        StaircaseOptions {
            participants: 3,
            trials: 60,
            threshold: 1.0,
            width: 1e-6,
            lapse: 0.0,
            between_sd: 0.0,
            model: Model { guess: 0.0, ..Model::default() },
            start: 3.0,
            steps: vec![0.5, 0.25],
            lowest: None,
            highest: None,
            down: 1,
            studies: 20,
            reversals: staircase::Options::default(),
        }
    }

    #[test]
    fn a_perfect_observer_oscillates_around_the_threshold() {
        let options = StaircaseOptions { threshold: 1.1, ..options() };
        let plan = plan_staircase(&options, &Settings::default()).unwrap().result;
        assert_eq!(plan.first.levels[..8], [3.0, 2.5, 2.0, 1.5, 1.0, 1.25, 1.0, 1.25]);
        assert_eq!(plan.first.correct[..8], [1, 1, 1, 1, 0, 1, 0, 1]);
        assert_eq!((plan.mean, plan.sd, plan.failed), (Some(1.125), Some(0.0), 0));
        assert_eq!(plan.target_performance, 0.5);
    }

    #[test]
    fn an_observer_of_low_levels_is_the_mirror_image() {
        let options = StaircaseOptions {
            start: -3.0,
            threshold: -1.1,
            model: Model { direction: Direction::Decreasing, guess: 0.0, ..Model::default() },
            ..options()
        };
        let plan = plan_staircase(&options, &Settings::default()).unwrap().result;
        assert_eq!(plan.first.levels[..6], [-3.0, -2.5, -2.0, -1.5, -1.0, -1.25]);
    }

    #[test]
    fn staircases_at_a_limit_have_no_threshold() {
        let options = StaircaseOptions { lowest: Some(2.0), ..options() };
        let plan = plan_staircase(&options, &Settings::default()).unwrap().result;
        assert_eq!((plan.failed, plan.mean), (20, None));
        assert!(plan.reason.is_some());
    }

    #[test]
    fn options_that_do_not_fit_are_errors() {
        let low = StaircaseOptions { lowest: Some(2.0), highest: Some(1.0), ..options() };
        assert!(plan_staircase(&low, &Settings::default()).is_err());
        let rates = StaircaseOptions { lapse: 1.0, ..options() };
        assert!(plan_staircase(&rates, &Settings::default()).is_err());
    }
}
