//! Ratings: mean scores by level with the largest acceptable level (RMFR, Fig. 10), or over a grid of
//! two parameters with its best cell (RMFR, Fig. 9).

mod crossing;
mod grid;
mod scores;

use serde::Serialize;

pub use self::crossing::Acceptable;
pub use self::grid::{Best, Cell, GridRatings};

use self::crossing::acceptable;
use self::grid::grid;
use self::scores::Scores;
use crate::input::{Data, Validation, without_validation};
use crate::json::{Document, Group};
use crate::moments::Moments;
use crate::options::Smoothing;
use crate::{Settings, StudyError};

/// Options of the analysis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// The mean score that an acceptable level has at least.
    pub threshold: Option<f64>,
    /// Two columns of parameters, for a grid instead of levels.
    pub grid: Option<[String; 2]>,
    /// The smoothing of the grid.
    pub smoothing: Smoothing,
    /// Which participants are left out because of their validation trials.
    pub validation: Option<Validation>,
}

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Ratings {
    /// Scores by level.
    Levels(LevelRatings),
    /// Scores over a grid.
    Grid(GridRatings),
}

/// Scores by level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelRatings {
    /// The number of participants.
    pub participants: usize,
    /// The levels, ascending.
    pub levels: Vec<LevelRating>,
    /// The largest acceptable level, if a threshold is given.
    #[serde(flatten)]
    pub acceptable: Option<Acceptable>,
}

/// The scores of one level, over the means of participants.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelRating {
    /// The level.
    pub level: f64,
    /// The moments of the participants' means.
    #[serde(flatten)]
    pub moments: Moments,
}

/// Computes the scores of each group.
///
/// # Errors
///
/// If a column is missing or a cell cannot be used.
pub fn ratings(
    data: &Data,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Ratings>, StudyError> {
    let (data, excluded) = without_validation(data, options.validation)?;
    let data = data.without_empty("value")?;
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let result = match &options.grid {
            Some(columns) => Ratings::Grid(grid(&data, columns, options.smoothing)?),
            None => Ratings::Levels(levels(&data, options, settings)?),
        };
        groups.push(Group { by, result });
    }
    let mut document = Document::new("ratings", groups);
    document.excluded = excluded;
    Ok(document)
}

fn levels(data: &Data, options: &Options, settings: &Settings) -> Result<LevelRatings, StudyError> {
    let scores = Scores::read(data, ["level"])?;
    let values = scores.by_condition();
    let levels = scores
        .conditions
        .iter()
        .zip(&values)
        .map(|(&[level], values)| LevelRating {
            level,
            moments: Moments::of(values, settings.confidence),
        })
        .collect();
    let acceptable = options.threshold.map(|threshold| acceptable(&scores, threshold, settings));
    Ok(LevelRatings { participants: scores.means.len(), levels, acceptable })
}
