//! Turns panics of decoder libraries into errors.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static CONTAINED: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic on this thread will become an error, so that a panic hook does not need to
/// report it.
pub fn is_contained() -> bool {
    CONTAINED.get()
}

/// Runs a decoder. `None` if it panicked.
pub fn contained<T>(work: impl FnOnce() -> T) -> Option<T> {
    let before = CONTAINED.replace(true);
    let result = catch_unwind(AssertUnwindSafe(work));
    CONTAINED.set(before);
    result.ok()
}
