//! Psychometric functions: the probability of a correct answer as a function of the level of a
//! stimulus, fitted by maximum likelihood and by Bayesian inference.

mod drawn;
mod levels;
mod ml;
mod model;
mod options;
mod posterior;
mod read;
mod sigmoid;

use serde::Serialize;

pub use self::drawn::{CurvePoint, DrawnCurve};
pub use self::levels::{Level, pool};
pub use self::ml::{LevelAt, MaximumLikelihood};
pub use self::model::Model;
pub use self::options::Options;
pub use self::posterior::{Estimate, Intervals, Posterior, Threshold};

pub(crate) use self::model::Curve;

use self::levels::Trials;
use self::read::read;
use crate::input::Data;
use crate::json::{Document, Group};
use crate::{Settings, StudyError};

/// A psychometric function.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Psychometric {
    /// The trials, pooled by level, ascending.
    pub levels: Vec<Level>,
    /// The maximum-likelihood fit.
    pub ml: Option<MaximumLikelihood>,
    /// The posterior.
    pub posterior: Option<Posterior>,
    /// The fitted function, for figures: of maximum likelihood, or of the posterior's mode if the
    /// answers do not determine that.
    #[serde(skip)]
    pub drawn: Option<DrawnCurve>,
    /// Why a fit is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Fits a function to each group.
///
/// # Errors
///
/// If a column is missing or a cell cannot be used, and if the rates of guesses and lapses leave
/// nothing for the function.
pub fn psychometric(
    data: &Data,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Psychometric>, StudyError> {
    options.check()?;
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let levels = pool(read(&data, options.model.sigmoid)?);
        groups.push(Group { by, result: fit(levels, options, settings) });
    }
    Ok(Document::new("psychometric", groups))
}

/// Fits the function to pooled levels. For `weibull`, all levels have to be above 0.
pub fn fit(levels: Vec<Level>, options: &Options, settings: &Settings) -> Psychometric {
    let trials = Trials::new(&levels, options.model.sigmoid);
    let Some(span) = trials.span() else {
        let reason = if levels.len() < 2 {
            "a function needs trials at two or more levels"
        } else {
            "the levels are too far apart, or too near to each other, for a fit"
        };
        let reason = Some(reason.to_owned());
        return Psychometric { levels, ml: None, posterior: None, drawn: None, reason };
    };
    let ml = ml::fit(options, &trials, &span, settings);
    let start = ml.as_ref().map(|fit| fit.best);
    let posterior = start
        .and_then(|curve| posterior::fit(options, &trials, &span, &curve, settings.confidence));
    let reason = (ml.is_none() || posterior.is_none())
        .then(|| "the likelihood of the answers is not finite".to_owned());
    let model = &options.model;
    let drawn = match (&ml, &posterior) {
        (Some(ml), _) if ml.result.threshold.is_some() => {
            Some(DrawnCurve::with_band(model, &span, (&ml.best, &ml.refits), settings.confidence))
        }
        (_, Some(posterior)) => Some(DrawnCurve::of_mode(model, &span, &posterior.map)),
        _ => None,
    };
    Psychometric { levels, ml: ml.map(|ml| ml.result), posterior, drawn, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(correct: &[u64], trials: u64) -> Vec<Level> {
        let level = |(i, &correct): (usize, &u64)| Level { level: 1.0 + i as f64, correct, trials };
        correct.iter().enumerate().map(level).collect()
    }

    fn settings(bootstrap: usize) -> Settings {
        Settings { bootstrap, ..Settings::default() }
    }

    #[test]
    fn the_fit_to_counts_of_a_function_is_that_function() {
        // 10 000 trials per level of m = 3, w = 2, λ = 0.02.
        let model = Model::default();
        let curve = self::model::Curve { position: 3.0, width: 2.0, lapse: 0.02 };
        let count = |i: u32| (model.performance(&curve, f64::from(i)) * 10_000.0).round() as u64;
        let correct: Vec<u64> = (1..=6).map(count).collect();
        let options = Options::default();
        let result = fit(levels(&correct, 10_000), &options, &settings(20));
        let ml = result.ml.unwrap();
        assert!((ml.threshold.unwrap() - 3.0).abs() < 1e-3);
        assert!((ml.width.unwrap() - 2.0).abs() < 5e-3);
        assert!((ml.lapse.unwrap() - 0.02).abs() < 1e-3);
        assert!(ml.deviance < 1e-3 && ml.df == 3 && ml.p_bootstrap.unwrap() > 0.9);
        let level = &ml.thresholds[0];
        let [low, high] = level.ci.unwrap().map(Option::unwrap);
        assert!(low < level.level.unwrap() && level.level.unwrap() < high && high - low < 0.2);
        let posterior = result.posterior.unwrap();
        assert!((posterior.median.threshold - 3.0).abs() < 0.02);
    }

    #[test]
    fn a_step_chance_and_one_level_are_not_determined() {
        for correct in [&[10, 10, 20, 20, 20][..], &[11, 9, 10, 10], &[20, 20, 20, 20]] {
            let result = fit(levels(correct, 20), &Options::default(), &settings(0));
            let ml = result.ml.unwrap();
            assert!(ml.threshold.is_none() && ml.lapse.is_none() && ml.reason.is_some());
            assert!(ml.thresholds.iter().all(|threshold| threshold.level.is_none()));
            assert!(result.posterior.is_some());
        }
        let one = fit(levels(&[15], 20), &Options::default(), &settings(0));
        assert!(one.ml.is_none() && one.posterior.is_none() && one.reason.is_some());
    }

    #[test]
    fn a_falling_function_is_the_mirror_image() {
        let rising = [11, 13, 17, 19, 20];
        let falling: Vec<u64> = rising.iter().rev().copied().collect();
        let mirrored =
            Model { direction: crate::options::Direction::Decreasing, ..Model::default() };
        let options = Options { model: mirrored, ..Options::default() };
        let rises = fit(levels(&rising, 20), &Options::default(), &settings(0)).ml.unwrap();
        let falls = fit(levels(&falling, 20), &options, &settings(0)).ml.unwrap();
        assert!((rises.threshold.unwrap() + falls.threshold.unwrap() - 6.0).abs() < 1e-6);
        assert!((rises.deviance - falls.deviance).abs() < 1e-9);
    }
}
