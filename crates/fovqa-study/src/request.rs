//! An analysis that is asked for, whoever asks: a command line or a file.

use crate::input::{Data, Selection, Table};
use crate::{
    Analysis, Settings, StudyError, anova, metrics, pairs, plan, psychometric, ranks, ratings,
    staircase,
};

/// An analysis with its own options.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// Pairwise comparisons.
    Pairs(pairs::Options),
    /// Rank tests.
    Ranks(ranks::Options),
    /// Analysis of variance: one or two factors.
    Anova(Vec<String>),
    /// Psychometric functions.
    Psychometric(psychometric::Options),
    /// Thresholds of staircases.
    Staircase(staircase::Options),
    /// Ratings by level, or over a grid.
    Ratings(ratings::Options),
    /// Metrics against mean opinion scores.
    Metrics(metrics::Options),
    /// A plan of pairwise comparisons.
    PlanPairs(plan::PairsOptions),
    /// A plan of the pairwise comparisons of a run's methods.
    PlanPredicted(plan::PredictedOptions),
    /// A plan of staircases.
    PlanStaircase(plan::StaircaseOptions),
}

/// The tables that an analysis reads.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inputs<'t> {
    /// The answers; a plan has none.
    pub table: Option<&'t Table>,
    /// The scores of metrics (results.csv of a run).
    pub scores: Option<&'t Table>,
}

impl Request {
    /// The name of the analysis.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Pairs(_) => "pairs",
            Self::Ranks(_) => "ranks",
            Self::Anova(_) => "anova",
            Self::Psychometric(_) => "psychometric",
            Self::Staircase(_) => "staircase",
            Self::Ratings(_) => "ratings",
            Self::Metrics(_) => "metrics",
            Self::PlanPairs(_) | Self::PlanPredicted(_) | Self::PlanStaircase(_) => "plan",
        }
    }

    /// Carries out the analysis for the selected rows.
    ///
    /// # Errors
    /// If a table is missing, or does not fit the options.
    pub fn answer(
        &self,
        inputs: Inputs<'_>,
        selection: &Selection,
        settings: &Settings,
    ) -> Result<Analysis, StudyError> {
        let scores = || inputs.scores.ok_or_else(|| missing("scores of metrics"));
        let data = || {
            let table = inputs.table.ok_or_else(|| missing("a table of answers"))?;
            Data::new(table, selection)
        };
        match self {
            Self::Pairs(options) => pairs::pairs(&data()?, options, settings).map(Analysis::Pairs),
            Self::Ranks(options) => ranks::ranks(&data()?, options, settings).map(Analysis::Ranks),
            Self::Anova(within) => anova::anova(&data()?, within, settings).map(Analysis::Anova),
            Self::Psychometric(options) => {
                let functions = psychometric::psychometric(&data()?, options, settings);
                functions.map(Analysis::Psychometric)
            }
            Self::Staircase(options) => {
                staircase::staircase(&data()?, options, settings).map(Analysis::Staircase)
            }
            Self::Ratings(options) => {
                ratings::ratings(&data()?, options, settings).map(Analysis::Ratings)
            }
            Self::Metrics(options) => {
                metrics::metrics(&data()?, scores()?, options, settings).map(Analysis::Metrics)
            }
            Self::PlanPairs(options) => {
                Ok(Analysis::PlanPairs(plan::plan_pairs(options, settings)))
            }
            Self::PlanPredicted(options) => {
                plan::plan_predicted(scores()?, options, settings).map(Analysis::PlanPredicted)
            }
            Self::PlanStaircase(options) => {
                plan::plan_staircase(options, settings).map(Analysis::PlanStaircase)
            }
        }
    }
}

fn missing(what: &str) -> StudyError {
    StudyError::Setting {
        message: format!("the analysis has no input: it needs {what}"),
        help: "name the file".to_owned(),
    }
}
