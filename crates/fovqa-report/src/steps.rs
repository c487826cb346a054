//! The steps of making tables, figures and pages, for those who show what is going on.

/// Begins a step, such as `drawing figures`, with the number of its items; 0 if they are not counted.
/// The step ends when the returned function is dropped.
pub type BeginStep<'a> = dyn Fn(&str, usize) -> ItemDone + 'a;

/// Is called after each item of a step, by any thread.
pub type ItemDone = Box<dyn Fn() + Send + Sync>;
