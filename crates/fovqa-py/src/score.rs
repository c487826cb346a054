//! Scores one comparison.

use std::io;
use std::sync::Arc;

use fovqa::{
    Compared, Dialect, Error, Events, Failure, Given, Plan, ReadOptions, ScoreReport, SourceSpec,
};
use fovqa_metrics::{Key, Metric, MetricKind};
use fovqa_plan::{EyeView, Gaze};
use fovqa_results::Summary;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::array;
use crate::document::{Document, working_folder};
use crate::error::{exception, wrong_input, wrong_request};
use crate::source::{GivenFrames, PythonFrames, no_guides};
use crate::worker::{AtWork, work};

/// The frames of both images, each for one eye or for two.
const REFERENCES: [&str; 2] = ["reference", "right_reference"];
const TESTS: [&str; 2] = ["test", "right_test"];

/// A map in memory.
struct KeptMap {
    eye: &'static str,
    frame: i64,
    name: &'static str,
    size: (usize, usize),
    values: Vec<f32>,
    heat_map: Vec<u8>,
}

/// Everything that a comparison gives.
struct Scored {
    compared: Compared,
    maps: Vec<KeptMap>,
}

/// Scores test frames against reference frames. `document` has the keys of an experiment with one scene and one
/// method, whose frames are `reference` and `test` (of two eyes, pairs of them).
#[pyfunction]
#[pyo3(signature = (document, reference, test, *, motion=None, depth=None, mask=None, gaze=None, maps=false, progress=None))]
#[allow(clippy::too_many_arguments, reason = "Python calls it with keywords")]
pub(crate) fn score<'py>(
    py: Python<'py>,
    document: &Bound<'py, PyDict>,
    reference: &Bound<'py, PyAny>,
    test: &Bound<'py, PyAny>,
    motion: Option<&Bound<'py, PyAny>>,
    depth: Option<&Bound<'py, PyAny>>,
    mask: Option<&Bound<'py, PyAny>>,
    gaze: Option<Vec<[f64; 2]>>,
    maps: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let _calling = AtWork::new();
    let mut plan = plan_of(document)?;
    plan.maps = maps;
    let mut given = Given::new();
    let eyes = &mut plan.scenes[0].eyes;
    let [references, tests] =
        [(reference, eyes.len()), (test, eyes.len())].map(|(value, eyes)| of_eyes(value, eyes));
    let (references, tests) = (references?, tests?);
    if eyes.len() > 1 && (motion.is_some() || depth.is_some()) {
        return Err(wrong_request(
            "arrays of motion and depth cannot be given for two eyes",
            "score each eye alone, or give files that have them",
        ));
    }
    for (nth, eye) in eyes.iter_mut().enumerate() {
        // Files of a list may have motion and depth beside their colours.
        let guides = eye.settings.guides.clone();
        let read = ReadOptions { guides, ..eye.settings.read.clone() };
        let frames = GivenFrames::of(REFERENCES[nth], &references[nth], &read)?;
        eye.reference = match frames {
            GivenFrames::Source(frames) => {
                let frames = frames.with_guides(motion, depth)?;
                add(&mut given, REFERENCES[nth], frames)
            }
            GivenFrames::Path(path) => {
                no_guides(motion, depth)?;
                path.into()
            }
        };
        let spec = match GivenFrames::of(TESTS[nth], &tests[nth], &read)? {
            GivenFrames::Source(frames) => add(&mut given, TESTS[nth], *frames),
            GivenFrames::Path(path) => path.into(),
        };
        eye.tests = vec![(0, spec)];
    }
    if let Some(points) = gaze {
        let each = Gaze::Each(points);
        for eye in eyes {
            eye.settings.gaze = each.clone();
        }
    }
    if let Some(mask) = mask {
        add_mask(&mut plan, &mut given, mask)?;
    }
    let (scored, heard) =
        work(py, Dialect::Arguments, progress, move |events| scored(&plan, &given, events))?;
    let Scored { compared, maps } =
        scored.map_err(|error| exception(&error, Dialect::Arguments))?;
    let result = PyDict::new(py);
    result.set_item("warnings", heard.warnings)?;
    fill(&result, &compared)?;
    let of_map = |map: KeptMap| -> PyResult<_> {
        let (width, height) = map.size;
        let values = array::array(py, map.values, &[height, width])?;
        let heat_map = pyo3::types::PyBytes::new(py, &map.heat_map);
        Ok((map.eye, map.frame, map.name, values, heat_map))
    };
    let maps = maps.into_iter().map(of_map).collect::<PyResult<Vec<_>>>()?;
    result.set_item("maps", maps)?;
    Ok(result)
}

/// The plan of a document with one scene and one method.
pub(crate) fn plan_of(document: &Bound<'_, PyDict>) -> PyResult<Plan> {
    let experiment = Document::arguments(document)?.experiment()?;
    let mut plan = experiment.plan;
    plan.base = working_folder();
    // A single comparison needs no names.
    plan.methods = vec![String::new()];
    for scene in &mut plan.scenes {
        scene.name = String::new();
    }
    plan.hash_inputs = false;
    plan.pictures = fovqa_plan::WantedPictures::default();
    Ok(plan)
}

/// The frames of each eye.
fn of_eyes<'py>(value: &Bound<'py, PyAny>, eyes: usize) -> PyResult<Vec<Bound<'py, PyAny>>> {
    if eyes == 1 {
        return Ok(vec![value.clone()]);
    }
    let pair = value.cast::<PyTuple>().ok().filter(|pair| pair.len() == 2);
    let pair = pair.ok_or_else(|| PyTypeError::new_err("give a left and a right image"))?;
    Ok(pair.iter().collect())
}

pub(crate) fn add(given: &mut Given, name: &str, frames: PythonFrames) -> SourceSpec {
    given.insert(name.to_owned(), Arc::new(frames));
    SourceSpec::Given(name.to_owned())
}

/// Gives a mask, which is an array.
fn add_mask(plan: &mut Plan, given: &mut Given, mask: &Bound<'_, PyAny>) -> PyResult<()> {
    const NAME: &str = "mask";
    for eye in plan.scenes.iter_mut().flat_map(|scene| &mut scene.eyes) {
        let EyeView { settings, .. } = eye;
        let frame = array::mask(mask, settings.read.max_megapixels)?;
        given.insert(NAME.to_owned(), Arc::new(PythonFrames::of_frame(NAME, frame)));
        settings.given_mask = Some(NAME.to_owned());
    }
    Ok(())
}

fn scored(plan: &Plan, given: &Given, events: &dyn Events) -> Result<Scored, Error> {
    let mut maps = Vec::new();
    let compared = fovqa::score_plan(plan, given, events, &mut |pair| {
        for map in pair.maps {
            maps.push(KeptMap {
                eye: pair.eye,
                frame: pair.frame,
                name: map.info.name,
                size: map.info.size(map.frame_size),
                values: map.values.clone(),
                heat_map: pair.heat_map(map)?,
            });
        }
        Ok::<(), io::Error>(())
    })?;
    Ok(Scored { compared, maps })
}

/// Adds the values of a comparison: as JSON, CSV and text exactly as the command prints them.
fn fill(result: &Bound<'_, PyDict>, compared: &Compared) -> PyResult<()> {
    let (mut json, mut csv) = (Vec::new(), Vec::new());
    let (written, table, reports) = match compared {
        Compared::OneEye(report) => {
            all_failed(report.frames.len(), &report.failures)?;
            let written = fovqa::write_json(report, &mut json)
                .and_then(|()| fovqa::write_csv(report, &mut csv));
            (written, fovqa_report::score_table(report).to_string(), vec![("", &**report)])
        }
        Compared::TwoEyes(report) => {
            let named = |(eye, failure): (&str, &Failure)| Failure {
                message: format!("{eye} eye: {}", failure.message),
                ..failure.clone()
            };
            let failures: Vec<Failure> = report.failures().map(named).collect();
            all_failed(report.left.frames.len() + report.right.frames.len(), &failures)?;
            let written = fovqa::write_stereo_json(report, &mut json)
                .and_then(|()| fovqa::write_stereo_csv(report, &mut csv));
            let table = fovqa_report::stereo_table(report).to_string();
            (written, table, report.named().to_vec())
        }
    };
    written.map_err(|error| wrong_input(error.to_string(), ""))?;
    result.set_item("json", String::from_utf8_lossy(&json))?;
    result.set_item("csv", String::from_utf8_lossy(&csv))?;
    result.set_item("table", table)?;
    let metrics = reports.last().map(|(_, report)| report.metrics.as_slice()).unwrap_or_default();
    result.set_item("metrics", metrics.iter().map(|metric| metric.key()).collect::<Vec<_>>())?;
    let values = PyDict::new(result.py());
    let failures = PyDict::new(result.py());
    for (eye, report) in reports {
        let of_eye = PyDict::new(result.py());
        for (metric, value) in values_of(report) {
            of_eye.set_item(metric.key(), value)?;
        }
        values.set_item(eye, of_eye)?;
        let of_eye: Vec<_> = report.failures.iter().map(failure).collect();
        failures.set_item(eye, of_eye)?;
    }
    result.set_item("values", values)?;
    result.set_item("failures", failures)
}

/// A failure as frame, message and help.
pub(crate) fn failure(of: &Failure) -> (Option<i64>, String, String) {
    let spell = |text: &str| Dialect::Arguments.spell(text);
    (of.frame, spell(&of.message), spell(&of.help))
}

/// The error if nothing could be scored.
pub(crate) fn all_failed(scored: usize, failures: &[Failure]) -> PyResult<()> {
    match failures.first() {
        Some(of) if scored == 0 => {
            let (_, message, help) = failure(of);
            Err(wrong_input(message, help))
        }
        _ => Ok(()),
    }
}

/// The value of each metric, as comparison tables show it: the mean over the frames, the JOD of a sequence, and
/// test / reference of measures of each image.
fn values_of(report: &ScoreReport) -> Vec<(Metric, Option<f64>)> {
    let summary = Summary::of(report);
    let value = |metric: Metric| match metric {
        Metric::Fvvdp => summary.fvvdp.as_ref().and_then(|fvvdp| fvvdp.jod),
        metric if metric.is(MetricKind::Temporal) => summary.temporal.of(metric)?.ratio,
        metric => summary.statistics.get(&metric).map(|statistics| statistics.mean),
    };
    let is_single = |metric: &Metric| match metric {
        Metric::Fvvdp => true,
        metric if metric.is(MetricKind::Temporal) => true,
        metric => metric.is(MetricKind::Fidelity) && Key::of(*metric).is_score(),
    };
    report.metrics.iter().copied().filter(is_single).map(|m| (m, value(m))).collect()
}
