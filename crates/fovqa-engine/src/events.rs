//! What a run has to say while it goes on.

/// Receives warnings and progress.
pub trait Events {
    /// Something the user should know; said once.
    fn warn(&self, message: &str);

    /// `done` of `total` frames are through.
    fn progress(&self, done: usize, total: usize);
}
