//! Scores the only comparison of a plan, as `fovqa score` does.

use std::io;
use std::path::Path;

use fovqa_engine::{EngineError, Entry, Events, Finished, Given, Record};
use fovqa_metrics::Map;
use fovqa_plan::Plan;
use fovqa_results::{Comparison, ScoreReport, StereoReport};
use fovqa_vision::Seen;

use crate::error::Error;
use crate::map_sheets::MapSheets;
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
    Ok(of_both_eyes(with_maps(plan, given, maps, events)?))
}

/// The results of a scene with two eyes.
fn of_both_eyes(mut reports: Vec<Comparison>) -> StereoReport {
    let mut of = |eye: &str| {
        let found = reports.iter_mut().find(|comparison| comparison.eye == eye);
        found.map(|comparison| std::mem::take(&mut comparison.report)).unwrap_or_default()
    };
    StereoReport { left: of("left"), right: of("right"), both: of("both") }
}

/// The maps of a pair that was scored.
pub struct PairMaps<'a> {
    /// `left` or `right`; empty if the scene has one image per frame.
    pub eye: &'static str,
    /// Frame number.
    pub frame: i64,
    /// The maps.
    pub maps: &'a [Map],
    seen: Option<&'a Seen>,
    sheets: &'a MapSheets,
}

impl PairMaps<'_> {
    /// A map as a heat map: a PNG with a colour bar and, if there is a view, the bands and the gaze.
    ///
    /// # Errors
    /// If the frame is larger than a PNG can be.
    pub fn heat_map(&self, map: &Map) -> io::Result<Vec<u8>> {
        self.sheets.sheet(map, self.seen)?.png(map).map_err(io::Error::other)
    }
}

/// Receives the maps of each pair, in order. An error ends the scoring.
pub type TakeMaps<'a> = dyn FnMut(&PairMaps<'_>) -> io::Result<()> + 'a;

/// The results of a plan that has one comparison, of one eye or of two.
#[derive(Debug, Clone, PartialEq)]
pub enum Compared {
    /// Of one image per frame.
    OneEye(Box<ScoreReport>),
    /// Of a left and a right image per frame.
    TwoEyes(Box<StereoReport>),
}

/// Scores the only comparison of a plan, and hands over the maps of each pair as soon as they are there.
/// As [`score_files`] and [`score_two_eyes`], which write maps to files.
///
/// # Errors
/// As [`score_files`], and if `take` refuses the maps of a pair.
pub fn score_plan(
    plan: &Plan,
    given: &Given,
    events: &dyn Events,
    take: &mut TakeMaps<'_>,
) -> Result<Compared, Error> {
    if let Some(message) = maps_lacking(plan.metrics.metrics()).filter(|_| plan.maps) {
        return Err(Error::usage(message, "request one of them with {metrics}"));
    }
    let sheets = MapSheets::default();
    let mut reports = comparisons(plan, given, events, &mut |entry| {
        let Entry::Pair(Finished { named, maps, seen, result: Ok(result), .. }) = entry else {
            return Ok(());
        };
        if maps.is_empty() {
            return Ok(());
        }
        let eye = named.eye.map_or("", fovqa_plan::Eye::name);
        let pair = PairMaps { eye, frame: result.frame, maps, seen, sheets: &sheets };
        take(&pair).map_err(|error| EngineError::Map { path: "maps".into(), error })
    })?;
    if plan.scenes.iter().any(|scene| scene.eyes.len() > 1) {
        return Ok(Compared::TwoEyes(Box::new(of_both_eyes(reports))));
    }
    let report = reports.pop().map(|comparison| comparison.report).unwrap_or_default();
    Ok(Compared::OneEye(Box::new(report)))
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
