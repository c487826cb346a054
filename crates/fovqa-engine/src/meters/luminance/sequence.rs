//! How far FovVideoVDP has come in a method's sequence.

use std::ops::Range;

use fovqa_metrics::fvvdp::Stream;

use crate::timing::Timing;

/// A method's sequence.
pub(super) struct Sequence {
    pub(super) timing: Timing,
    pub(super) state: State,
    /// The first of its frames that comes.
    pub(super) start: usize,
    /// The frame behind the last that comes.
    pub(super) end: usize,
}

pub(super) enum State {
    /// Before its first frame.
    New,
    /// So many frames are through.
    Going { reference: Stream, test: Stream, done: usize },
    /// It cannot go on.
    Broken(Missing),
}

/// What a sequence lacks.
#[derive(Debug, Clone)]
pub(super) enum Missing {
    /// A frame that could not be scored, by its index in the view.
    Frame(usize),
    /// Something else, in words.
    Said(String),
}

impl Sequence {
    /// From its first frame to its last.
    pub(super) fn new(timing: Timing) -> Self {
        let state = match &timing.time {
            Ok(_) => State::New,
            Err(gap) => State::Broken(Missing::Said(gap.to_string())),
        };
        let end = timing.frames.len();
        Self { timing, state, start: 0, end }
    }

    /// Goes on where `done` of its frames are through, up to `end`: those of them that have to come once
    /// more.
    pub(super) fn go_on(&mut self, done: usize, end: usize) -> Range<usize> {
        (self.start, self.end) = (0, end);
        let (State::New, Ok(time)) = (&self.state, &self.timing.time) else { return done..done };
        if done == end {
            let (reference, test) = (Stream::default(), Stream::default());
            self.state = State::Going { reference, test, done };
            return done..done;
        }
        // Where that is not the first frame, all that it brings in has gone out again by now.
        self.start = if done < time.reach() { 0 } else { done + 1 - time.reach() };
        self.start..done
    }

    /// How many frames are through.
    pub(super) fn done(&self) -> usize {
        match &self.state {
            State::Going { done, .. } => *done,
            State::New => self.start,
            State::Broken(_) => 0,
        }
    }

    /// Why it has no value; `None` where all its frames that come are through.
    pub(super) fn missing(&self, number: impl Fn(usize) -> String) -> Option<String> {
        let frame = match &self.state {
            State::Broken(Missing::Said(why)) => return Some(why.clone()),
            State::Broken(Missing::Frame(frame)) => frame,
            State::New | State::Going { .. } => self.timing.frames[..self.end].get(self.done())?,
        };
        Some(format!("frame {} could not be scored", number(*frame)))
    }
}
