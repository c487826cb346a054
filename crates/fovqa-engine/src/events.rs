//! Messages and progress that a run reports while it works.

use std::collections::BTreeSet;

/// Is called after each item of a step, by any thread.
pub type ItemDone = Box<dyn Fn() + Send + Sync>;

/// Receives warnings and progress.
pub trait Events {
    /// Something that the user should know. It is reported once.
    fn warn(&self, message: &str);

    /// `done` of `total` frames are finished.
    fn progress(&self, done: usize, total: usize);

    /// All frames are finished.
    fn finish(&self) {}

    /// A step after the frames begins, such as `drawing figures`. It has this number of items, or 0 if
    /// they are not counted. It ends when the returned function is dropped.
    fn step(&self, _what: &str, _items: usize) -> ItemDone {
        Box::new(|| {})
    }

    /// Something could not be done, and the rest continues. The texts say what failed, where, and
    /// how to correct it.
    fn failure(&self, _message: &str, _help: &str) {}

    /// Something that may interest the user.
    fn note(&self, _message: &str) {}
}

/// Reports each warning once, however many frames it applies to.
pub(crate) struct Warnings<'a> {
    events: &'a dyn Events,
    /// Names of the scene and the eye, if there are several.
    place: String,
    frames: usize,
    said: BTreeSet<(String, String)>,
}

impl<'a> Warnings<'a> {
    pub(crate) fn new(events: &'a dyn Events) -> Self {
        Self { events, place: String::new(), frames: 0, said: BTreeSet::new() }
    }

    /// Continues with another view, which has `frames` frames.
    pub(crate) fn enter(&mut self, place: String, frames: usize) {
        (self.place, self.frames) = (place, frames);
    }

    /// Warns of `message`, unless a warning with the same `key` was reported in any view. For facts
    /// about a file.
    pub(crate) fn once(&mut self, key: &str, message: &str) {
        if self.said.insert((String::new(), key.to_owned())) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            self.events.warn(&format!("{message}{once}"));
        }
    }

    /// Warns of `message` together with the place, because it is about the frames as a whole.
    pub(crate) fn of_view(&mut self, message: &str) {
        let place = if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
        self.events.warn(&format!("{place}{message}"));
    }

    /// Reports a note together with the place, if there is a message.
    pub(crate) fn note_of_view(&mut self, message: Option<&str>) {
        let Some(message) = message else { return };
        let place = if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
        self.events.note(&format!("{place}{message}"));
    }

    /// Warns of `message` together with the place, unless a warning with the same `key` was
    /// reported for this view.
    pub(crate) fn once_a_view(&mut self, key: &str, message: &str) {
        if self.said.insert((self.place.clone(), key.to_owned())) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            let place =
                if self.place.is_empty() { String::new() } else { format!("{}: ", self.place) };
            self.events.warn(&format!("{place}{message}{once}"));
        }
    }
}

/// Counts how many frames of a run are finished.
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

    /// Adds `frames` frames to those that are finished.
    pub(crate) fn step(&mut self, frames: usize) {
        self.done += frames;
        self.events.progress(self.done, self.total);
    }
}
