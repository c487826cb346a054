//! Takes the pictures that were not known to be needed while the frames were scored: which frame is the
//! worst is known at the end.

use std::collections::BTreeSet;
use std::io;
use std::ops::Range;
use std::path::Path;

use fovqa_engine::{Entry, Events, Findings, FoundInputs, FoundView, Named, Unit};
use fovqa_metrics::Metric;
use fovqa_plan::{Experiment, Eye, FrameChoice, MetricChoice, Plan, WantedPictures};
use fovqa_results::{
    FileError, FrameImages, IMAGES, IMAGES_JSON, ImagesRecord, ViewImages, make_folder, write_whole,
};

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
    let units = taking.found.map(|found| missing(taking, &record, found, pictures));
    if let Some((found, units)) = taking.found.zip(units.filter(|units| !units.is_empty())) {
        let again = again(plan, &record, taking.findings);
        let write = &mut |entry: Entry<'_>| pictures.write(&entry);
        let none = Findings::default();
        if let Err(error) = fovqa_engine::score(&again, found, &units, none, &Silent, write) {
            taking.events.warn(&format!("{error}; {}", no_pictures(results)));
        }
    }
    if taking.found.is_none() && lacks(taking, &record, pictures) {
        taking.events.note(&format!(
            "pictures of some frames for the report are missing; `fovqa run EXPERIMENT --output {} --resume`, \
             with the options of the shards, takes them",
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
                let of_map = |metric: &Metric| metric.info().map.is_some_and(|of| of.name == map);
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

/// Whether any chosen picture is missing.
fn lacks(taking: &Taking<'_>, record: &ImagesRecord, pictures: &Pictures) -> bool {
    let mut scored = taking.findings.scored(&taking.experiment.plan);
    scored.any(|(named, frame)| {
        let of_view = |view: &&ViewImages| view.scene == named.scene && view.eye == named.eye;
        record.views.iter().find(of_view).is_some_and(|view| {
            view.frames.iter().any(|chosen| chosen.frame == frame.frame)
                && view.methods.iter().any(|shown| shown == named.method)
                && !pictures.has(named, frame.frame)
        })
    })
}

/// The pairs whose pictures are missing, as units of work.
fn missing(
    taking: &Taking<'_>,
    record: &ImagesRecord,
    found: &FoundInputs,
    pictures: &Pictures,
) -> Vec<Unit> {
    let plan = &taking.experiment.plan;
    let scored: BTreeSet<(&str, Option<Eye>, &str, i64)> = taking
        .findings
        .scored(plan)
        .map(|(named, frame)| (named.scene, named.eye, named.method, frame.frame))
        .collect();
    let mut units = Vec::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        let eye = scene.eyes[view.eye].eye;
        let of_view = |of: &&ViewImages| of.scene == scene.name && of.eye == eye;
        let Some(of_view) = record.views.iter().find(of_view) else { continue };
        let is_missing = |frame: i64, method: usize| {
            let method = plan.methods[method].as_str();
            let named = Named { scene: &scene.name, method, eye };
            of_view.frames.iter().any(|chosen| chosen.frame == frame)
                && of_view.methods.iter().any(|shown| shown == method)
                && scored.contains(&(named.scene, eye, method, frame))
                && !pictures.has(named, frame)
        };
        let ranges = ranges(view, is_missing).into_iter();
        units.extend(ranges.map(|pairs| Unit { scene: view.scene, eye: view.eye, pairs }));
    }
    units
}

/// The ranges of the pairs of a view for which `is_wanted` holds. A range does not go beyond a frame.
fn ranges(view: &FoundView, is_wanted: impl Fn(i64, usize) -> bool) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    let mut pair = 0;
    for frame in &view.frames {
        let first = pair;
        for (method, _) in &frame.tests {
            if is_wanted(frame.number, *method) {
                match ranges.last_mut() {
                    Some(range) if range.end == pair && range.start >= first => range.end += 1,
                    _ => ranges.push(pair..pair + 1),
                }
            }
            pair += 1;
        }
    }
    ranges
}

/// The plan for scoring frames again for their pictures: only metrics that have maps.
fn again(plan: &Plan, record: &ImagesRecord, findings: &Findings) -> Plan {
    let mut mapped: Vec<Metric> = plan.metrics.metrics().to_vec();
    mapped.retain(|metric| {
        let is_scored = || findings.scored(plan).any(|(_, frame)| frame.rows.has(*metric));
        metric.info().map.is_some() && is_scored()
    });
    let frames: BTreeSet<i64> =
        record.views.iter().flat_map(|view| &view.frames).map(|frame| frame.frame).collect();
    let metrics = if mapped.is_empty() {
        // Something has to be scored; without maps, it is the cheapest.
        MetricChoice::Named(vec![Metric::Mse])
    } else {
        MetricChoice::Named(mapped)
    };
    Plan {
        metrics,
        maps: false,
        hash_inputs: false,
        crops: Vec::new(),
        pictures: WantedPictures {
            frames: frames.into_iter().map(FrameChoice::Number).collect(),
            methods: (0..plan.methods.len()).collect(),
        },
        ..plan.clone()
    }
}

/// Reports nothing: everything was reported while the frames were scored.
struct Silent;

impl Events for Silent {
    fn warn(&self, _message: &str) {}

    fn progress(&self, _done: usize, _total: usize) {}
}
