//! The thread pool for all parallel work.

use crate::diagnostic;
use crate::exit::Exit;

/// Maximum number of threads. More threads only take longer to start.
const MOST: usize = 256;

/// Starts the pool. The number of threads is `asked`, otherwise that of the environment, otherwise
/// that of the machine, up to the maximum.
fn start(asked: Option<u16>) -> Result<(), String> {
    let from_environment = || std::env::var("RAYON_NUM_THREADS").ok()?.parse::<usize>().ok();
    // For 0, the pool itself chooses one thread per core.
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
