//! The pool all work runs on.

use crate::diagnostic;
use crate::exit::Exit;

/// More than this only takes longer to start.
const MOST: usize = 256;

/// Starts the pool with as many threads as are asked for, or as the environment or the machine
/// has, within reason.
fn start(asked: Option<u16>) -> Result<(), String> {
    let from_environment = || std::env::var("RAYON_NUM_THREADS").ok()?.parse::<usize>().ok();
    // 0 leaves the choice to the pool: one thread a core.
    let threads = asked.map(usize::from).or_else(from_environment).unwrap_or(0).min(MOST);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| format!("{threads} threads cannot be started: {error}"))
}

/// Starts the thread pool, and prints the error if it cannot be started.
pub(crate) fn started(asked: Option<u16>) -> Result<(), Exit> {
    start(asked).map_err(|message| {
        diagnostic::error(&message, "ask for fewer");
        Exit::Usage
    })
}
