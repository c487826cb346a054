//! Runs code of the user while the work is done.

use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// How long a thread of the pool sleeps that waits for the code and has no other work.
const PAUSE: Duration = Duration::from_micros(100);

/// Runs code that fetches something from Python. An error becomes its text.
///
/// The code may use this package in turn, and so need the pool. A thread of the pool must not only wait for it:
/// the code runs on another thread, and this one does other work of the pool meanwhile. That other work may
/// fetch something as well, so the code must not wait for other fetches.
pub(crate) fn fetch<T: Send>(
    code: impl FnOnce(Python<'_>) -> PyResult<T> + Send,
) -> Result<T, String> {
    let run = || {
        let ran = Python::try_attach(|py| code(py).map_err(|error| error.value(py).to_string()));
        ran.unwrap_or_else(|| Err("the interpreter has ended".to_owned()))
    };
    if rayon::current_thread_index().is_none() {
        return run();
    }
    thread::scope(|scope| {
        let running = scope.spawn(run);
        while !running.is_finished() {
            if rayon::yield_now() != Some(rayon::Yield::Executed) {
                thread::sleep(PAUSE);
            }
        }
        running.join().unwrap_or_else(|payload| std::panic::resume_unwind(payload))
    })
}
