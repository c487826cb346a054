//! Scores the only comparison of a plan, as `fovqa score` does.

use std::path::Path;

use fovqa_engine::{Events, Given, Record};
use fovqa_plan::Plan;
use fovqa_results::{Comparison, ScoreReport, StereoReport};

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
    let mut reports = with_maps(plan, given, maps, events)?;
    Ok(reports.pop().map(|comparison| comparison.report).unwrap_or_default())
}

/// Scores the only scene of a plan, which has two eyes and one method. As [`score_files`]; maps are in
/// a folder for each eye.
///
/// # Errors
/// As [`score_files`].
pub fn score_two_eyes(
    plan: &Plan,
    given: &Given,
    maps: Option<&Path>,
    events: &dyn Events,
) -> Result<StereoReport, Error> {
    let mut reports = with_maps(plan, given, maps, events)?;
    let mut of = |eye: &str| {
        let found = reports.iter_mut().find(|comparison| comparison.eye == eye);
        found.map(|comparison| std::mem::take(&mut comparison.report)).unwrap_or_default()
    };
    Ok(StereoReport { left: of("left"), right: of("right"), both: of("both") })
}

fn with_maps(
    plan: &Plan,
    given: &Given,
    maps: Option<&Path>,
    events: &dyn Events,
) -> Result<Vec<Comparison>, Error> {
    if let Some(message) = maps_lacking(plan.metrics.metrics()).filter(|_| maps.is_some()) {
        return Err(Error::usage(message, "request one of them with {metrics}"));
    }
    let maps = maps.map(|folder| MapsFolder::new(folder.to_owned(), false));
    comparisons(plan, given, events, &mut |entry| {
        maps.as_ref().map_or(Ok(()), |maps| maps.write(&entry))
    })
}

/// Scores the only comparison of a plan.
pub(crate) fn comparison(
    plan: &Plan,
    given: &Given,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<ScoreReport, Error> {
    let mut reports = comparisons(plan, given, events, record)?;
    Ok(reports.pop().map(|comparison| comparison.report).unwrap_or_default())
}

fn comparisons(
    plan: &Plan,
    given: &Given,
    events: &dyn Events,
    record: &mut Record<'_>,
) -> Result<Vec<Comparison>, Error> {
    fovqa_engine::check(plan)?;
    let mut found = fovqa_engine::find(plan, given);
    if let Some(problem) = found.problems.pop() {
        return Err(problem.error.into());
    }
    let results = fovqa_engine::run(plan, &found, events, record);
    events.finish();
    Ok(results?.comparisons)
}
