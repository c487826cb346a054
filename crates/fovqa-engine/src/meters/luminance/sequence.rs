//! The progress of FovVideoVDP in a method's sequence.

use std::ops::Range;

use fovqa_metrics::fvvdp::Stream;

use crate::timing::Timing;

/// A method's sequence.
pub(super) struct Sequence {
    pub(super) timing: Timing,
    pub(super) state: State,
    /// Index of the first frame that is read.
    pub(super) start: usize,
    /// Index after the last frame that is read.
    pub(super) end: usize,
}

pub(super) enum State {
    /// No frame has been read.
    New,
    /// `done` frames are finished.
    Going { reference: Stream, test: Stream, done: usize },
    /// The sequence cannot continue.
    Broken(Missing),
}

/// What the sequence lacks.
#[derive(Debug, Clone)]
pub(super) enum Missing {
    /// A frame that could not be scored, by its index in the view.
    Frame(usize),
    /// Another reason, in words.
    Said(String),
}

impl Sequence {
    /// The whole sequence, from its first frame to its last.
    pub(super) fn new(timing: Timing) -> Self {
        let state = match &timing.time {
            Ok(_) => State::New,
            Err(gap) => State::Broken(Missing::Said(gap.to_string())),
        };
        let end = timing.frames.len();
        Self { timing, state, start: 0, end }
    }

    /// Continues the sequence, of which `done` frames are finished, up to `end`. Returns those of
    /// the finished frames that must be read again.
    pub(super) fn go_on(&mut self, done: usize, end: usize) -> Range<usize> {
        (self.start, self.end) = (0, end);
        let (State::New, Ok(time)) = (&self.state, &self.timing.time) else { return done..done };
        if done == end {
            let (reference, test) = (Stream::default(), Stream::default());
            self.state = State::Going { reference, test, done };
            return done..done;
        }
        // If this is not the first frame, the effect of the frames before it has left the filters
        // by now.
        self.start = if done < time.reach() { 0 } else { done + 1 - time.reach() };
        self.start..done
    }

    /// The number of frames that are finished.
    pub(super) fn done(&self) -> usize {
        match &self.state {
            State::Going { done, .. } => *done,
            State::New => self.start,
            State::Broken(_) => 0,
        }
    }

    /// Why the sequence has no value; `None` if all frames that are read are finished.
    pub(super) fn missing(&self, number: impl Fn(usize) -> String) -> Option<String> {
        let frame = match &self.state {
            State::Broken(Missing::Said(why)) => return Some(why.clone()),
            State::Broken(Missing::Frame(frame)) => frame,
            State::New | State::Going { .. } => self.timing.frames[..self.end].get(self.done())?,
        };
        Some(format!("frame {} could not be scored", number(*frame)))
    }
}
