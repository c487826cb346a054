//! Takes the pictures that were not known to be needed while the frames were scored: which frame is the
//! worst is known at the end.

use std::collections::BTreeSet;
use std::io;
use std::path::Path;

use fovqa_engine::{Events, Findings, FoundInputs, Named};
use fovqa_metrics::Metric;
use fovqa_plan::{Experiment, Plan};
use fovqa_results::{
    FileError, FrameImages, IMAGES, IMAGES_JSON, ImagesRecord, ViewImages, make_folder, write_whole,
};

use super::again::Again;
use super::chosen::chosen;
use super::folders::{clear_pictures, keep_frames};
use super::recorder::{Pictures, record_text};

/// A run whose frames were scored.
pub(crate) struct Taking<'a> {
    pub(crate) experiment: &'a Experiment,
    /// The frames; `None` if they cannot be read again.
    pub(crate) found: Option<&'a FoundInputs>,
    pub(crate) findings: &'a Findings,
    pub(crate) events: &'a dyn Events,
}

/// Takes the pictures of the chosen frames that do not exist yet, writes the list of the frames, and
/// removes the pictures of other frames. What cannot be taken or written is reported: results do not
/// depend on it.
pub(crate) fn take_missing(taking: &Taking<'_>, results: &Path, pictures: &mut Pictures) {
    if let Err(error) = take(taking, results, pictures) {
        taking.events.warn(&format!("{error}; {}", no_pictures(results)));
    }
}

/// What the user can do about pictures that could not be written.
pub(crate) fn no_pictures(results: &Path) -> String {
    format!(
        "the page lacks pictures; mend {}, and `fovqa run EXPERIMENT --output {} --resume` takes them",
        results.join(IMAGES).display(),
        results.display()
    )
}

fn take(taking: &Taking<'_>, results: &Path, pictures: &mut Pictures) -> Result<(), FileError> {
    let plan = &taking.experiment.plan;
    let record = chosen(plan, &taking.experiment.report, taking.findings);
    if let Some(found) = taking.found {
        let scored: BTreeSet<_> = taking
            .findings
            .scored(plan)
            .map(|(named, frame)| (named.scene, named.eye, named.method, frame.frame))
            .collect();
        let missing: BTreeSet<_> = scored
            .into_iter()
            .filter(|(scene, eye, method, frame)| {
                let named = Named { scene, method, eye: *eye };
                is_chosen(&record, named, *frame) && !pictures.has(named, *frame)
            })
            .collect();
        let is_missing = |named: Named<'_>, frame: i64| {
            missing.contains(&(named.scene, named.eye, named.method, frame))
        };
        let mapped = mapped(plan, taking.findings);
        let again = Again { plan, found, mapped: &mapped, hash_inputs: false };
        if let Err(error) = again.score(&is_missing, &mut |entry| pictures.write(&entry)) {
            taking.events.warn(&format!("{error}; {}", no_pictures(results)));
        }
    }
    if taking.found.is_none() && lacks(taking, &record, pictures) {
        taking.events.note(&format!(
            "{}: pictures of some frames for the report are missing; {{experiment_of_shards}} takes them",
            results.display()
        ));
    }
    drop_unscored(taking, &record, pictures)
        .map_err(|error| FileError::Write { path: results.join(IMAGES_JSON), error })?;
    let folders: BTreeSet<_> = record
        .views
        .iter()
        .flat_map(|view| view.frames.iter().map(|frame| folder(results, view, frame.frame)))
        .collect();
    if folders.is_empty() {
        clear_pictures(results);
        return Ok(());
    }
    keep_frames(results, &|path| folders.contains(path));
    let list = results.join(IMAGES_JSON);
    let text =
        record_text(&record).map_err(|error| FileError::Write { path: list.clone(), error })?;
    let failed = |error| FileError::Write { path: list.clone(), error };
    make_folder(&results.join(IMAGES)).map_err(failed)?;
    write_whole(&list, text.as_bytes())
}

/// Drops the maps of metrics without a value. A shard that begins after a gap in a sequence does not know
/// yet that FovVideoVDP will have none.
fn drop_unscored(
    taking: &Taking<'_>,
    record: &ImagesRecord,
    pictures: &Pictures,
) -> io::Result<()> {
    for (named, frame) in taking.findings.scored(&taking.experiment.plan) {
        let of_view = |view: &&ViewImages| view.scene == named.scene && view.eye == named.eye;
        let view = record.views.iter().find(of_view);
        if view.is_some_and(|view| view.frames.iter().any(|chosen| chosen.frame == frame.frame)) {
            let is_scored = |map: &str| {
                let of_map = |metric: &Metric| metric.info().maps().any(|of| of.name == map);
                Metric::ALL.into_iter().filter(of_map).any(|metric| frame.rows.has(metric))
            };
            pictures.keep_maps(named, frame.frame, is_scored)?;
        }
    }
    Ok(())
}

fn folder(results: &Path, view: &ViewImages, frame: i64) -> std::path::PathBuf {
    FrameImages::new(results, &view.scene, view.eye, frame).folder().to_owned()
}

/// Whether the report shows a method's frame.
fn is_chosen(record: &ImagesRecord, named: Named<'_>, frame: i64) -> bool {
    let of_view = |view: &&ViewImages| view.scene == named.scene && view.eye == named.eye;
    record.views.iter().find(of_view).is_some_and(|view| {
        view.frames.iter().any(|chosen| chosen.frame == frame)
            && view.methods.iter().any(|shown| shown == named.method)
    })
}

/// Whether any chosen picture is missing.
fn lacks(taking: &Taking<'_>, record: &ImagesRecord, pictures: &Pictures) -> bool {
    let mut scored = taking.findings.scored(&taking.experiment.plan);
    scored.any(|(named, frame)| {
        is_chosen(record, named, frame.frame) && !pictures.has(named, frame.frame)
    })
}

/// The metrics that have maps, of those that were scored.
fn mapped(plan: &Plan, findings: &Findings) -> Vec<Metric> {
    let mut mapped: Vec<Metric> = plan.metrics.metrics().to_vec();
    mapped.retain(|metric| {
        let is_scored = || findings.scored(plan).any(|(_, frame)| frame.rows.has(*metric));
        metric.info().map.is_some() && is_scored()
    });
    mapped
}
