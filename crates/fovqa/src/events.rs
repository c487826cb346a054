//! Listeners for the warnings, errors and progress of a run.

use std::cell::RefCell;

use fovqa_engine::Events;

/// A listener that ignores everything.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Events for Silent {
    fn warn(&self, _message: &str) {}

    fn progress(&self, _done: usize, _total: usize) {}
}

/// A listener that collects the warnings.
#[derive(Debug, Default)]
pub(crate) struct Kept(pub(crate) RefCell<Vec<String>>);

impl Events for Kept {
    fn warn(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }

    fn progress(&self, _done: usize, _total: usize) {}
}
