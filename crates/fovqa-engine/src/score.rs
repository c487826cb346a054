//! `score`: one reference against one test, frame by frame.

use std::path::{Component, Path};

use fovqa_frame::{Mask, PairSignal, SignalTables};
use fovqa_io::read_mask;
use fovqa_io::sequence::FramePair;
use fovqa_metrics::ScoreError;
use fovqa_results::{Failure, FrameResult, ScoreReport};
use fovqa_vision::GazeAt;

use crate::error::EngineError;
use crate::events::{Events, Warnings};
use crate::load::{Fault, LoadError, Loaded, Loader};
use crate::plan::{check, find_pairs, gaze_trace};
use crate::read_ahead::read_ahead;
use crate::request::ScoreRequest;
use crate::setup::{Inputs, Setup};

/// Scores every frame of a request. Frames that cannot be scored are in the report's failures.
///
/// # Errors
/// When nothing can be scored at all: no frames, frames that do not pair, a view, gaze or mask
/// that cannot be.
pub fn score(request: &ScoreRequest, events: &dyn Events) -> Result<ScoreReport, EngineError> {
    let metrics = check(request, events)?;
    let (pairs, first_frame) = find_pairs(request, events)?;
    let trace = gaze_trace(request, &pairs, first_frame)?;
    let mask = request.mask.as_deref().map(|path| read_mask(path, &request.read)).transpose()?;
    let loader = Loader {
        read: &request.read,
        crop: request.crop,
        nonfinite: request.nonfinite,
        signal: &request.signal,
    };
    let mut run = Run {
        request,
        tables: SignalTables::new(request.signal),
        trace: trace.as_deref(),
        mask,
        frames: pairs.len(),
        setup: None,
        warnings: Warnings::new(events, pairs.len()),
        report: ScoreReport {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            view: None,
            metrics,
            frames: Vec::with_capacity(pairs.len()),
            failures: Vec::new(),
            gaze_held: trace.as_ref().map(|t| t.iter().filter(|g| g.held).count()),
        },
    };
    events.progress(0, pairs.len());
    read_ahead(
        &pairs,
        |pair| loader.load(pair),
        |index, loaded| {
            run.frame(index, &pairs[index], loaded);
            events.progress(index + 1, pairs.len());
        },
    );
    Ok(run.report)
}

struct Run<'a> {
    request: &'a ScoreRequest,
    tables: SignalTables,
    trace: Option<&'a [GazeAt]>,
    mask: Option<Mask>,
    frames: usize,
    setup: Option<Setup<'a>>,
    warnings: Warnings<'a>,
    report: ScoreReport,
}

impl Run<'_> {
    fn frame(&mut self, index: usize, pair: &FramePair, loaded: Result<Loaded, LoadError>) {
        let result = loaded.map_err(Fault::from).and_then(|l| self.score(index, pair, &l));
        match result {
            Ok(frame) => self.report.frames.push(frame),
            Err(Fault { message, help }) => self.report.failures.push(Failure {
                frame: pair.number,
                reference: shown(&pair.reference),
                test: shown(&pair.test),
                message,
                help,
            }),
        }
    }

    fn score(
        &mut self,
        index: usize,
        pair: &FramePair,
        loaded: &Loaded,
    ) -> Result<FrameResult, Fault> {
        for (file, note) in &loaded.notes {
            self.warnings.once(note, &format!("{file}: {note}"));
        }
        let size = (loaded.reference.width(), loaded.reference.height());
        let first = pair.reference.display().to_string();
        let setup = match &mut self.setup {
            Some(setup) => setup,
            none => {
                let inputs = Inputs {
                    request: self.request,
                    metrics: &self.report.metrics,
                    mask: self.mask.as_ref(),
                    trace: self.trace,
                    frames: self.frames,
                    file_size: loaded.reference.file_size(),
                };
                let setup = Setup::new(&inputs, size, first, &mut self.warnings)?;
                self.report.view.clone_from(&setup.view);
                self.report.metrics = setup.scorer.metrics().to_vec();
                none.insert(setup)
            }
        };
        if size != setup.size {
            return Err(Fault {
                message: format!(
                    "{} has {}x{} pixels and {}, the first of the sequence, has {}x{}",
                    pair.reference.display(),
                    size.0,
                    size.1,
                    setup.first_file,
                    setup.size.0,
                    setup.size.1
                ),
                help: "a sequence has one size".to_owned(),
            });
        }
        let gaze_px = self.trace.map(|trace| trace[index].px);
        if let Some(gaze_px) = gaze_px {
            setup.look_at(gaze_px);
        }
        if let Some(gaze) = gaze_px.or(setup.view.as_ref().map(|view| view.gaze_px)) {
            warn_of_gaze(gaze, size, &mut self.warnings);
        }
        setup.apply_mask();
        let regions = setup.regions(loaded.finite.as_ref());
        let signal = PairSignal::new(&loaded.reference, &loaded.test, &self.tables);
        let scores =
            setup.scorer.score(&signal, &regions, setup.weight()).map_err(|error| Fault {
                message: format!("{}: {error}", pair.test.display()),
                help: format!("leave it out of --metrics, or {}", score_help(&error)),
            })?;
        for metric in setup.scorer.metrics().iter().filter(|m| !scores.scores.contains_key(m)) {
            let label = metric.info().label;
            let message = format!(
                "{label} is left out of frame {}: the mask leaves no whole window for it",
                pair.number
            );
            self.warnings.once(&format!("{label} without windows"), &message);
        }
        Ok(FrameResult {
            frame: pair.number,
            reference: shown(&pair.reference),
            test: shown(&pair.test),
            gaze_px,
            scores,
        })
    }
}

fn warn_of_gaze(gaze: [f64; 2], size: (usize, usize), warnings: &mut Warnings<'_>) {
    let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
    if !(inside(gaze[0], size.0) && inside(gaze[1], size.1)) {
        let message = format!(
            "the gaze ({}, {}) lies outside the frame of {}x{}; eccentricities are measured from it all the same",
            gaze[0], gaze[1], size.0, size.1
        );
        warnings.once("gaze outside", &message);
    }
}

fn score_help(error: &ScoreError) -> &'static str {
    match error {
        ScoreError::TooSmall { .. } => "render larger frames",
        ScoreError::Masked { .. } => "score without a mask",
        ScoreError::NothingLeft | ScoreError::NoWindow { .. } => "check the mask: white is visible",
        ScoreError::NoView { .. } => "give a view",
    }
}

/// A path as results show it: relative to the working directory where it lies below it, with `/`.
fn shown(path: &Path) -> String {
    let below = std::env::current_dir()
        .ok()
        .and_then(|here| path.strip_prefix(here).ok().map(Path::to_owned));
    let path = below.unwrap_or_else(|| path.to_owned());
    let mut parts: Vec<String> = Vec::new();
    for part in path.components() {
        match part {
            Component::RootDir => parts.push(String::new()),
            Component::CurDir => {}
            part => parts.push(part.as_os_str().to_string_lossy().into_owned()),
        }
    }
    parts.join("/")
}
