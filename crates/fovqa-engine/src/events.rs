//! What a run has to say while it goes on.

use std::collections::BTreeSet;

/// Receives warnings and progress.
pub trait Events {
    /// Something the user should know; said once.
    fn warn(&self, message: &str);

    /// `done` of `total` frames are through.
    fn progress(&self, done: usize, total: usize);
}

/// Warnings that are said once, whatever number of frames they are true of.
pub(crate) struct Warnings<'a> {
    events: &'a dyn Events,
    frames: usize,
    said: BTreeSet<String>,
}

impl<'a> Warnings<'a> {
    pub(crate) fn new(events: &'a dyn Events, frames: usize) -> Self {
        Self { events, frames, said: BTreeSet::new() }
    }

    /// Says `message`, unless something was said under the same `key`.
    pub(crate) fn once(&mut self, key: &str, message: &str) {
        if self.said.insert(key.to_owned()) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            self.events.warn(&format!("{message}{once}"));
        }
    }
}
