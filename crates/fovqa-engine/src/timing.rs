//! Finds the frames of a method's sequence and the time between them, which FovVideoVDP filters
//! over.

use std::collections::BTreeMap;

use fovqa_metrics::fvvdp::{Params, Time, TimeError};

use crate::found::FoundView;

/// The frames and frame rate of a method's sequence.
#[derive(Debug, Clone)]
pub(crate) struct Timing {
    /// Indices of its frames in the view.
    pub(crate) frames: Vec<usize>,
    /// Frames per second; `None` for a still image.
    pub(crate) fps: Option<f64>,
    /// How the sequence is filtered, or why it cannot be.
    pub(crate) time: Result<Time, Gap>,
}

/// Frames that are not equally spaced: the numbers of two frames between which some are missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Gap(i64, i64);

impl std::fmt::Display for Gap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "frames are missing between {} and {}", self.0, self.1)
    }
}

/// The sequences of all methods of a view, by the index of the method.
///
/// # Errors
/// If a sequence has no frame rate, or a rate that cannot be filtered.
pub(crate) fn timings(
    view: &FoundView,
    fps: Option<f64>,
    params: &Params,
) -> Result<BTreeMap<usize, Timing>, TimeError> {
    let mut frames: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, frame) in view.frames.iter().enumerate() {
        for (method, _) in &frame.tests {
            frames.entry(*method).or_default().push(index);
        }
    }
    let timing = |frames: Vec<usize>| {
        let frame = |index: &usize| &view.frames[*index];
        let step =
            |pair: &[usize]| frame(&pair[1]).position.saturating_sub(frame(&pair[0]).position);
        // For example, every second frame of 60 frames per second gives 30 frames per second.
        let nearest = frames.windows(2).map(step).min().unwrap_or(1).max(1);
        let fps = fps.map(|fps| fps / nearest as f64).filter(|_| frames.len() > 1);
        let time = Time::new(frames.len(), fps, params.temp_padding)?;
        let gap = frames.windows(2).find(|pair| step(pair) != nearest);
        let gap = gap.map(|pair| Gap(frame(&pair[0]).number, frame(&pair[1]).number));
        Ok(Timing { fps, time: gap.map_or(Ok(time), Err), frames })
    };
    frames.into_iter().map(|(method, frames)| Ok((method, timing(frames)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::found_frame::{FoundFrame, GuideFrames};
    use crate::view_sources::ViewSources;

    fn view(positions: &[usize]) -> FoundView {
        let frame = |position: &usize| FoundFrame {
            number: *position as i64 + 10,
            position: *position,
            reference: *position,
            guides: GuideFrames::default(),
            tests: vec![(0, *position)],
        };
        let frames = positions.iter().map(frame).collect();
        FoundView {
            scene: 0,
            eye: 0,
            sources: ViewSources::empty(),
            frames,
            fps: None,
            trace: None,
            passed_over: 0,
            remarks: Vec::new(),
        }
    }

    fn timing(positions: &[usize], fps: Option<f64>) -> Result<Timing, TimeError> {
        Ok(timings(&view(positions), fps, &Params::default())?.remove(&0).unwrap())
    }

    #[test]
    fn a_step_between_frames_slows_the_sequence_down() {
        let every = timing(&[0, 1, 2], Some(60.0)).unwrap();
        assert_eq!((every.fps, every.frames.len()), (Some(60.0), 3));
        assert_eq!(timing(&[3, 5, 7], Some(60.0)).unwrap().fps, Some(30.0));
        assert_eq!(timing(&[0, 20], Some(60.0)).unwrap_err(), TimeError::Fps { fps: 3.0 });
        assert_eq!(timing(&[0, 1], None).unwrap_err(), TimeError::NoFps);
    }

    #[test]
    fn a_gap_is_no_sequence_and_one_frame_needs_no_time() {
        let gap = timing(&[0, 1, 3], Some(60.0)).unwrap();
        assert_eq!(gap.time.unwrap_err().to_string(), "frames are missing between 11 and 13");
        let still = timing(&[4], None).unwrap();
        assert!(still.time.is_ok() && still.fps.is_none());
    }
}
