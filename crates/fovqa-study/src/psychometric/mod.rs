//! Psychometric functions: the probability of a correct answer as a function of the level of a
//! stimulus, fitted by maximum likelihood and by Bayesian inference.

mod levels;
mod ml;
mod model;
mod options;
mod posterior;
mod read;
mod sigmoid;

use serde::Serialize;

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
        return Psychometric { levels, ml: None, posterior: None, reason: Some(reason.to_owned()) };
    };
    let ml = ml::fit(options, &trials, &span, settings);
    let start = ml.as_ref().map(|(_, curve)| *curve);
    let posterior = start
        .and_then(|curve| posterior::fit(options, &trials, &span, &curve, settings.confidence));
    let reason = (ml.is_none() || posterior.is_none())
        .then(|| "the likelihood of the answers is not finite".to_owned());
    Psychometric { levels, ml: ml.map(|(ml, _)| ml), posterior, reason }
}
