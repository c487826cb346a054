//! A sequence over time: how the frames become temporal channels, and the conditions for this. A
//! sequence of one frame is a still with one unfiltered channel.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use thiserror::Error;

use super::grid::Grid;
use super::params::Padding;
use super::temporal_filters::{FASTEST_FPS, TOO_SLOW_FPS, TemporalFilters};
use super::window::{Window, at_first_frame};

/// A sequence that cannot be filtered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum TimeError {
    /// There is no frame rate.
    #[error("FovVideoVDP of a sequence needs the frame rate, but none is given")]
    NoFps,
    /// The frame rate is out of the range for which filters can be made.
    #[error(
        "FovVideoVDP needs more than {TOO_SLOW_FPS} and at most {FASTEST_FPS} frames per second; the sequence has {fps}"
    )]
    Fps {
        /// The given frame rate, or the effective one if frames are skipped.
        fps: f64,
    },
}

/// The temporal filters and the padding for the frames of a sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct Time {
    /// `None` for a still.
    filters: Option<TemporalFilters>,
    padding: Padding,
    frames: usize,
}

impl Time {
    /// For a sequence of at least one frame, at a frame rate.
    ///
    /// # Errors
    /// When a sequence has no frame rate, or one that is too low or too high.
    pub fn new(frames: usize, fps: Option<f64>, padding: Padding) -> Result<Self, TimeError> {
        let filters = if frames > 1 {
            let fps = fps.ok_or(TimeError::NoFps)?;
            if !(fps > TOO_SLOW_FPS && fps <= FASTEST_FPS) {
                return Err(TimeError::Fps { fps });
            }
            Some(TemporalFilters::new(fps))
        } else {
            None
        };
        Ok(Self { filters, padding, frames })
    }

    /// The frames, except the first, that are needed to start the sequence.
    pub fn before_first(&self) -> BTreeSet<usize> {
        let frames = self.at_first().into_iter();
        frames.filter(|frame| *frame > 0).collect()
    }

    /// The number of frames that the filters cover, including the present one.
    pub fn reach(&self) -> usize {
        self.filters.as_ref().map_or(1, TemporalFilters::len)
    }

    fn at_first(&self) -> Vec<usize> {
        match &self.filters {
            None => vec![0],
            Some(filters) => at_first_frame(self.padding, self.frames, filters.len()),
        }
    }
}

/// One sequence of pictures over time: the luminance of the frames that the filters cover.
#[derive(Debug, Clone, Default)]
pub struct Stream(Window);

impl Stream {
    /// Starts with the first frame, and with those of [`Time::before_first`] by their numbers.
    ///
    /// # Panics
    /// When one of those frames is missing.
    pub fn begin(time: &Time, first: &Arc<Grid>, before: &BTreeMap<usize, Arc<Grid>>) -> Self {
        let frames = time.at_first().into_iter().map(|frame| {
            let luminance = if frame == 0 { first } else { &before[&frame] };
            (frame, Arc::clone(luminance))
        });
        Self(Window::new(frames.collect()))
    }

    /// Starts in the middle of a sequence. Frames before this one are assumed to be equal to it;
    /// channels are those of the whole sequence after [`Time::reach`] frames, including this one.
    pub fn begin_at(time: &Time, frame: usize, luminance: &Arc<Grid>) -> Self {
        let alike = (0..time.reach()).map(|_| (frame, Arc::clone(luminance)));
        Self(Window::new(alike.collect()))
    }

    /// Continues with the next frame.
    pub fn push(&mut self, frame: usize, luminance: Arc<Grid>) {
        self.0.push(frame, luminance);
    }

    /// The numbers of the covered frames, the oldest first.
    pub fn frames(&self) -> Vec<usize> {
        self.0.frames().collect()
    }

    /// The temporal channels of the present frame: sustained and transient, or the still itself.
    pub fn channels(&self, time: &Time) -> Vec<Arc<Grid>> {
        match &time.filters {
            None => vec![self.0.newest()],
            Some(filters) => self.0.filtered(filters).into_iter().map(Arc::new).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(value: f32) -> Arc<Grid> {
        let mut grid = Grid::new(3, 2);
        grid.fill_blocks(|_, rows| rows.for_each(|row| row[..3].fill(value)));
        Arc::new(grid)
    }

    /// 24 frames per second make 6 taps.
    #[test]
    fn a_sequence_can_be_started_in_the_middle() {
        const FRAMES: usize = 12;
        let frames: Vec<Arc<Grid>> = (0..FRAMES).map(|i| grid((i * i) as f32 + 0.1)).collect();
        for padding in [Padding::Replicate, Padding::Circular, Padding::Pingpong] {
            let time = Time::new(FRAMES, Some(24.0), padding).unwrap();
            assert_eq!(time.reach(), 6);
            let before = (1..FRAMES).map(|i| (i, Arc::clone(&frames[i]))).collect();
            let mut whole = Stream::begin(&time, &frames[0], &before);
            let mut at = Vec::new();
            for (frame, luminance) in frames.iter().enumerate() {
                if frame > 0 {
                    whole.push(frame, Arc::clone(luminance));
                }
                at.push(whole.channels(&time));
            }
            // Channels are equal once all frames that the filters cover have been pushed.
            for first in 1..FRAMES {
                let mut part = Stream::begin_at(&time, first, &frames[first]);
                for frame in first + 1..FRAMES {
                    part.push(frame, Arc::clone(&frames[frame]));
                    let alike = part.channels(&time) == at[frame];
                    assert_eq!(alike, frame - first >= 5, "{padding:?}: {frame} from {first}");
                }
            }
        }
    }
}
