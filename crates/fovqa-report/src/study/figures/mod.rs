//! The figures of a user study.

mod anova;
mod brackets;
mod context;
mod dots;
mod metrics;
mod pairs;
mod plan;
mod psychometric;
mod ranks;
mod ratings;
mod staircase;
#[cfg(test)]
mod tests;
mod thresholds;

use fovqa_study::{Analysis, Settings};

use crate::sheet::{NamedFigure, Names};
use context::Context;

/// The figures of an analysis with its settings. The names of their files begin with `name`. Undefined
/// results have no figures.
pub(crate) fn figures(analysis: &Analysis, name: &str, settings: &Settings) -> Vec<NamedFigure> {
    let context = Context::new(name, settings);
    let mut figures = match analysis {
        Analysis::Pairs(document) => pairs::figures(document, &context),
        Analysis::Ranks(document) => ranks::figures(document, &context),
        Analysis::Anova(document) => anova::figures(document, &context),
        Analysis::Psychometric(document) => {
            let mut figures = psychometric::figures(document, &context);
            figures.extend(thresholds::figures(document, &context));
            figures
        }
        Analysis::Staircase(document) => staircase::figures(document, &context),
        Analysis::Ratings(document) => ratings::figures(document, &context),
        Analysis::Metrics(document) => metrics::figures(document, &context),
        Analysis::PlanPairs(plan) => plan::pairs(&plan.result, &context),
        // The shares of pairs are a table.
        Analysis::PlanPredicted(_) => Vec::new(),
        Analysis::PlanStaircase(plan) => plan::staircase(&plan.result, &context),
    };
    let mut names = Names::default();
    for figure in &mut figures {
        figure.name = names.free(&figure.name);
    }
    figures
}
