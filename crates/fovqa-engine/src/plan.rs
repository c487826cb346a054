//! What can be settled before a pixel is read: metrics, pairs, the gaze of each frame.

use std::fs::File;

use fovqa_io::sequence::{FramePair, Pairs, list, pair};
use fovqa_metrics::Metric;
use fovqa_vision::{GazeAt, GazeTrace};

use crate::error::{EngineError, no_view};
use crate::events::Events;
use crate::request::{Gaze, MetricChoice, ScoreRequest};

/// Checks what needs no file, and settles the metrics.
pub(crate) fn check(
    request: &ScoreRequest,
    events: &dyn Events,
) -> Result<Vec<Metric>, EngineError> {
    request.params.check()?;
    let needs_view = |metrics: &[Metric]| -> Vec<Metric> {
        metrics.iter().copied().filter(|m| m.info().needs_view).collect()
    };
    if let Some(view) = &request.view {
        view.check()?;
    } else {
        let what = match request.gaze {
            _ if request.bands.is_some() => Some("eccentricity bands"),
            Gaze::Point(_) | Gaze::Trace { .. } => Some("a gaze"),
            Gaze::Centre => None,
        };
        if let Some(what) = what {
            return Err(EngineError::NoView { what: what.to_owned() });
        }
    }
    let mut metrics = match &request.metrics {
        MetricChoice::Named(named) => {
            let foveal = needs_view(named);
            if request.view.is_none() && !foveal.is_empty() {
                return Err(no_view(&foveal));
            }
            named.clone()
        }
        MetricChoice::Default => {
            let mut metrics = Metric::DEFAULT.to_vec();
            if request.view.is_none() {
                for metric in needs_view(&metrics) {
                    events.warn(&format!(
                        "{} is left out: it needs a view (such as --fov-vertical or --display)",
                        metric.info().label
                    ));
                }
                metrics.retain(|m| !m.info().needs_view);
            }
            metrics
        }
    };
    metrics.sort_unstable();
    metrics.dedup();
    Ok(metrics)
}

/// The pairs to score, and the number of the sequence's first frame.
pub(crate) fn find_pairs(
    request: &ScoreRequest,
    events: &dyn Events,
) -> Result<(Vec<FramePair>, u64), EngineError> {
    let (reference, test) = (list(&request.reference)?, list(&request.test)?);
    let Pairs { mut pairs, first: first_frame, alone } =
        pair(&reference, &test, request.allow_missing)?;
    if alone > 0 {
        events.warn(&format!("{alone} frames without a partner are passed over"));
    }
    let numbers = || pairs.iter().map(|p| p.number);
    let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
    if let Some(range) = request.frames {
        pairs.retain(|pair| range.contains(pair.number));
    }
    if pairs.is_empty() {
        return Err(EngineError::NoFrames { first, last });
    }
    Ok((pairs, first_frame))
}

/// Hours of gaze at any rate a tracker has.
const MAX_GAZE_BYTES: u64 = 64 << 20;

/// The gaze of each pair, where it comes from a trace.
pub(crate) fn gaze_trace(
    request: &ScoreRequest,
    pairs: &[FramePair],
    first_frame: u64,
) -> Result<Option<Vec<GazeAt>>, EngineError> {
    let Gaze::Trace { path, hold } = &request.gaze else { return Ok(None) };
    let open = || {
        // Looked at before it is opened, which a pipe without a writer would never end.
        let size = std::fs::metadata(path)?;
        if !size.is_file() {
            return Err(std::io::Error::other("it is not a regular file"));
        }
        if size.len() > MAX_GAZE_BYTES {
            return Err(std::io::Error::other("it is larger than 64 MiB"));
        }
        File::open(path)
    };
    let file = open().map_err(|error| EngineError::GazeFile { path: path.clone(), error })?;
    let frames: Vec<u64> = pairs.iter().map(|p| p.number).collect();
    GazeTrace::read(std::io::BufReader::new(file))
        .and_then(|trace| trace.at_frames(&frames, first_frame, request.fps, *hold))
        .map(Some)
        .map_err(|error| EngineError::GazeTrace { path: path.clone(), error })
}
