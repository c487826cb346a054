//! Finds the gaze for each frame, if the gaze comes from a trace.

use std::path::Path;

use fovqa_frame::source::{Frames, Length};
use fovqa_io::read_small_file;
use fovqa_plan::{EyeView, Gaze, Plan};
use fovqa_vision::{FrameAt, GazeAt, GazeTrace};

use crate::error::EngineError;
use crate::found_frame::FoundFrame;
use crate::view_sources::ViewSources;

/// Largest size of a gaze file in bytes: enough for hours of gaze at the rate of any eye tracker.
const MAX_GAZE_BYTES: u64 = 64 << 20;

/// The gaze for each frame, if it comes from a trace, and remarks about it for the user.
///
/// # Errors
/// If a trace cannot be read, or has no gaze for a frame.
pub(crate) fn gaze(
    plan: &Plan,
    view: &EyeView,
    sources: &ViewSources,
    fps: Option<f64>,
    frames: &[FoundFrame],
) -> Result<(Option<Vec<GazeAt>>, Vec<String>), EngineError> {
    let (path, hold) = match &view.settings.gaze {
        Gaze::Centre => return Ok((None, Vec::new())),
        Gaze::Builtin => return Ok((of_builtin(sources, frames), Vec::new())),
        Gaze::Point(point) => return Ok((None, of_point(*point).into_iter().collect())),
        Gaze::Each(points) => return Ok((Some(of_each(points, sources, frames)?), Vec::new())),
        Gaze::Trace { path, hold } => (path, *hold),
    };
    let bytes = read_small_file(path, MAX_GAZE_BYTES)
        .map_err(|error| EngineError::GazeFile { path: path.clone(), error })?;
    let failed = |error| EngineError::GazeTrace { path: path.clone(), error };
    let trace = GazeTrace::read(bytes.as_slice()).map_err(failed)?;
    let frames: Vec<FrameAt> = frames.iter().map(|frame| (frame.number, frame.position)).collect();
    let gaze = trace.at_frames(&frames, fps, hold).map_err(failed)?;
    let remarks = of_trace(plan, path, &trace);
    Ok((Some(gaze), remarks))
}

/// The gaze of the viewer of a built-in scene; `None` if the scene is not built in.
fn of_builtin(sources: &ViewSources, frames: &[FoundFrame]) -> Option<Vec<GazeAt>> {
    let builtin = sources.builtin.as_ref()?;
    let gaze = |frame: &FoundFrame| GazeAt { px: builtin.gaze_px(frame.reference), held: false };
    Some(frames.iter().map(gaze).collect())
}

/// The gaze of frames of which each has a point.
fn of_each(
    points: &[[f64; 2]],
    sources: &ViewSources,
    frames: &[FoundFrame],
) -> Result<Vec<GazeAt>, EngineError> {
    let listing = sources.reference.listing();
    let count = match &listing.frames {
        Frames::Named(entries) => Some(entries.len()),
        Frames::Counted(Length::Whole(count)) => Some(*count),
        Frames::Counted(Length::Damaged(_) | Length::Open) => None,
    };
    if let Some(frames) = count.filter(|count| *count != points.len()) {
        return Err(EngineError::GazeCount { points: points.len(), frames });
    }
    let gaze = |frame: &FoundFrame| {
        let lacks = || EngineError::GazeCount { points: points.len(), frames: frames.len() };
        let px = *points.get(frame.reference).ok_or_else(lacks)?;
        Ok(GazeAt { px, held: false })
    };
    frames.iter().map(gaze).collect()
}

/// A remark about a gaze point that looks like fractions of the frame size instead of pixels. The
/// corner is excluded, because it is the same in both units.
fn of_point([x, y]: [f64; 2]) -> Option<String> {
    let share = |at: f64| (0.0..=1.0).contains(&at);
    (share(x) && share(y) && (x > 0.0 || y > 0.0)).then(|| {
        format!(
            "the gaze ({x}, {y}) is in the first pixel of the frame: it is given in pixels from the top-left corner; \
             if these are fractions of the frame, multiply them by its width and height"
        )
    })
}

fn of_trace(plan: &Plan, path: &Path, trace: &GazeTrace) -> Vec<String> {
    /// Longest plausible interval in seconds. Eye trackers are faster, and so are frames that show
    /// motion.
    const LONGEST_INTERVAL_S: f64 = 1.0;
    let file = plan.shown(path);
    let mut remarks = Vec::new();
    if !trace.unused_quality_columns().is_empty() {
        remarks.push(format!(
            "{file}: not applied: {}; to exclude a row, leave its x_px or y_px empty, or write 0 in a column \
             named valid",
            trace.unused_quality_columns().join(", ")
        ));
    }
    if trace.is_in_first_pixel() {
        remarks.push(format!(
            "{file}: all positions are in the first pixel of the frame: x_px and y_px must be pixels, not \
             fractions of the frame"
        ));
    }
    if let Some(interval) = trace.interval_s().filter(|s| *s > LONGEST_INTERVAL_S) {
        remarks.push(format!(
            "{file}: time_s increases by {interval} s from row to row; check that it is in seconds"
        ));
    }
    remarks
}
