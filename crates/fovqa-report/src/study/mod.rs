//! The results of user studies: tables, for text and for papers.

mod anova;
mod cells;
mod figures;
mod metrics;
mod of_run;
mod pairs;
mod parts;
mod plan;
mod printed;
mod psychometric;
mod ranks;
mod ratings;
mod sheet;
mod staircase;
mod text;

pub(crate) use of_run::study_of_run;
pub use printed::{NoResult, ResultOfPrinted, printed_results};
pub use sheet::{AnsweredAnalysis, DrawnStudy, StudySheet};
pub use text::study_text;

use fovqa_study::Analysis;

use parts::{Part, Parts, joined};

/// The tables and remarks of an analysis, with those of all groups in one.
fn joined_parts(analysis: &Analysis) -> Vec<Part> {
    let planned = |add: &dyn Fn(&mut Parts)| {
        let mut parts = Parts::default();
        add(&mut parts);
        parts.0
    };
    match analysis {
        Analysis::Pairs(document) => joined(&document.groups, pairs::parts),
        Analysis::Ranks(document) => joined(&document.groups, ranks::parts),
        Analysis::Anova(document) => joined(&document.groups, anova::parts),
        Analysis::Psychometric(document) => joined(&document.groups, psychometric::parts),
        Analysis::Staircase(document) => joined(&document.groups, staircase::parts),
        Analysis::Ratings(document) => joined(&document.groups, ratings::parts),
        Analysis::Metrics(document) => joined(&document.groups, metrics::parts),
        Analysis::PlanPairs(plan) => planned(&|parts| plan::pairs(&plan.result, parts)),
        Analysis::PlanPredicted(plan) => planned(&|parts| plan::predicted(&plan.result, parts)),
        Analysis::PlanStaircase(plan) => planned(&|parts| plan::staircase(&plan.result, parts)),
    }
}
