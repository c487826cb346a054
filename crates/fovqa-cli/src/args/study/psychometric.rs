//! `fovqa study psychometric`.

use clap::{Args, ValueEnum};
use fovqa_params::Words;
use fovqa_study::options::{Direction, Sigmoid};
use fovqa_study::psychometric::{Model, Options};

use super::options::{rate, share};
use super::{InputArgs, SettingsArgs};
use crate::args::values::words;

pub(super) const EXAMPLES: &str = "\
Columns: level, correct (0 or 1; a count if there is a column trials).

Example:
  fovqa study psychometric staircases.csv --by method --performance 0.75";

/// Whether the posterior allows for overdispersion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Overdispersion {
    /// Beta-binomial distribution.
    On,
    /// Binomial distribution.
    Off,
}

/// The shape of a psychometric function.
#[derive(Debug, Args)]
pub(crate) struct ShapeArgs {
    /// Shape of the psychometric function
    #[arg(long, value_name = "SHAPE", default_value = Sigmoid::default().word(), value_parser = words::<Sigmoid>())]
    sigmoid: Sigmoid,
    /// How performance depends on the level
    #[arg(long, value_name = "WAY", default_value = Direction::default().word(), value_parser = words::<Direction>())]
    direction: Direction,
    /// Share of correct answers by guessing
    #[arg(long, value_name = "SHARE", default_value = "0.5", value_parser = rate)]
    guess: f64,
}

#[derive(Debug, Args)]
pub(crate) struct PsychometricArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    #[command(flatten)]
    shape: ShapeArgs,
    /// Performances at which thresholds are reported
    #[arg(long, value_name = "SHARE,…", default_value = "0.75,0.7071067811865476", value_delimiter = ',', value_parser = share)]
    performance: Vec<f64>,
    /// A fixed lapse rate [default: it is fitted]
    #[arg(long, value_name = "RATE", value_parser = rate)]
    lapse: Option<f64>,
    /// Largest lapse rate of the maximum-likelihood fit
    #[arg(long, value_name = "RATE", default_value = "0.06", value_parser = rate)]
    lapse_max: f64,
    /// Whether the posterior allows for overdispersion
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    overdispersion: Overdispersion,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl ShapeArgs {
    /// The kind of function.
    pub(super) fn model(&self) -> Model {
        Model { sigmoid: self.sigmoid, direction: self.direction, guess: self.guess }
    }
}

impl PsychometricArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        Options {
            model: self.shape.model(),
            lapse: self.lapse,
            lapse_max: self.lapse_max,
            performance: self.performance.clone(),
            overdispersion: self.overdispersion == Overdispersion::On,
        }
    }
}
