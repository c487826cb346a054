//! What a run has to say while it goes on.

use std::collections::BTreeSet;

/// Receives warnings and progress.
pub trait Events {
    /// Something the user should know; said once.
    fn warn(&self, message: &str);

    /// `done` of `total` frames are through.
    fn progress(&self, done: usize, total: usize);

    /// All frames are through.
    fn finish(&self) {}

    /// Something that could not be done, while the rest goes on: what, where, and how to mend it.
    fn failure(&self, _message: &str, _help: &str) {}

    /// Something worth knowing.
    fn note(&self, _message: &str) {}
}

/// Warnings that are said once, whatever number of frames they are true of.
pub(crate) struct Warnings<'a> {
    events: &'a dyn Events,
    /// Scene and eye, where there are several.
    place: String,
    frames: usize,
    said: BTreeSet<(String, String)>,
}

impl<'a> Warnings<'a> {
    pub(crate) fn new(events: &'a dyn Events) -> Self {
        Self { events, place: String::new(), frames: 0, said: BTreeSet::new() }
    }

    /// Goes on to another view, of so many frames.
    pub(crate) fn enter(&mut self, place: String, frames: usize) {
        (self.place, self.frames) = (place, frames);
    }

    /// Says `message`, unless something was said under the same `key` anywhere: for what is true of
    /// a file.
    pub(crate) fn once(&mut self, key: &str, message: &str) {
        if self.said.insert((String::new(), key.to_owned())) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            self.events.warn(&format!("{message}{once}"));
        }
    }

    /// Says `message` with the place: it is about the frames as a whole.
    pub(crate) fn of_view(&mut self, message: &str) {
        let place = if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
        self.events.warn(&format!("{place}{message}"));
    }

    /// Notes something with the place, where there is something to note.
    pub(crate) fn note_of_view(&mut self, message: Option<&str>) {
        let Some(message) = message else { return };
        let place = if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
        self.events.note(&format!("{place}{message}"));
    }

    /// Says `message` with the place, unless something was said of this view under the same `key`.
    pub(crate) fn once_a_view(&mut self, key: &str, message: &str) {
        if self.said.insert((self.place.clone(), key.to_owned())) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            let place =
                if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
            self.events.warn(&format!("{place}{message}{once}"));
        }
    }
}

/// How far a run is.
pub(crate) struct Progress<'a> {
    events: &'a dyn Events,
    done: usize,
    total: usize,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(events: &'a dyn Events, total: usize) -> Self {
        events.progress(0, total);
        Self { events, done: 0, total }
    }

    /// So many more frames are through.
    pub(crate) fn step(&mut self, frames: usize) {
        self.done += frames;
        self.events.progress(self.done, self.total);
    }
}
