//! Scores the only comparison of a plan, as `fovqa score` does.

use std::path::Path;

use fovqa_engine::{Events, Given, Record};
use fovqa_plan::Plan;
use fovqa_results::ScoreReport;

use crate::error::Error;
use crate::maps::{MapsFolder, maps_lacking};

/// Scores the only comparison of a plan. If a folder is given, the maps of its frames are written
/// there. A problem with the whole comparison is an error; frames that cannot be scored are
/// failures in the report.
///
/// # Errors
/// If the plan is not possible, frames have no partner, or a map cannot be written.
pub fn score_files(
    plan: &Plan,
    given: &Given,
    maps: Option<&Path>,
    events: &dyn Events,
) -> Result<ScoreReport, Error> {
    if let Some(message) = maps_lacking(plan.metrics.metrics()).filter(|_| maps.is_some()) {
        return Err(Error::usage(message, "request one of them with {metrics}"));
    }
    let maps = maps.map(|folder| MapsFolder::new(folder.to_owned(), false));
    comparison(plan, given, events, &mut |entry| {
        maps.as_ref().map_or(Ok(()), |maps| maps.write(&entry))
    })
}

pub(crate) fn comparison(
    plan: &Plan,
    given: &Given,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<ScoreReport, Error> {
    fovqa_engine::check(plan)?;
    let mut found = fovqa_engine::find(plan, given);
    if let Some(problem) = found.problems.pop() {
        return Err(problem.error.into());
    }
    let results = fovqa_engine::run(plan, &found, events, record);
    events.finish();
    Ok(results?.comparisons.pop().map(|comparison| comparison.report).unwrap_or_default())
}
