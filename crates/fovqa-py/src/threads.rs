//! The threads of the work. They are those of the process: all calls share them.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::prelude::*;

use crate::error::wrong_request;

/// Maximum number of threads. More threads only take longer to start.
const MOST: usize = 256;

/// Whether the threads were started; the error if they could not be.
static STARTED: OnceLock<Result<(), String>> = OnceLock::new();

/// Whether this process is the child of one that had started its threads. They do not exist here.
static ORPHANED: AtomicBool = AtomicBool::new(false);

/// Whether this process is such a child.
pub(crate) fn is_orphan() -> bool {
    ORPHANED.load(Ordering::Relaxed)
}

/// Starts the threads, if they were not started.
pub(crate) fn started() -> PyResult<()> {
    if is_orphan() {
        return Err(wrong_request(
            "this process was forked from one that had used fovqa, and its threads do not exist here",
            "start processes with multiprocessing.get_context(\"spawn\"), or call fovqa only in the children",
        ));
    }
    start(None)
}

fn start(threads: Option<usize>) -> PyResult<()> {
    let from_environment = || std::env::var("RAYON_NUM_THREADS").ok()?.parse::<usize>().ok();
    let started = STARTED.get_or_init(|| {
        // For 0, the pool itself chooses one thread per core.
        let threads = threads.or_else(from_environment).unwrap_or(0).min(MOST);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        pool.map_err(|error| format!("{threads} threads cannot be started: {error}"))
    });
    started.clone().map_err(|message| wrong_request(message, "ask for fewer"))
}

/// Chooses the number of threads of all later calls.
#[pyfunction]
pub(crate) fn set_threads(threads: usize) -> PyResult<()> {
    if !(1..=MOST).contains(&threads) {
        return Err(wrong_request(
            format!("{threads} threads are not possible"),
            format!("give a number from 1 to {MOST}"),
        ));
    }
    if STARTED.get().is_some() {
        let running = rayon::current_num_threads();
        if running == threads {
            return Ok(());
        }
        return Err(wrong_request(
            format!("the threads were started already: {running}"),
            "choose their number before the first call that works, or with the variable RAYON_NUM_THREADS",
        ));
    }
    start(Some(threads))
}

/// Notes in the child that the process was forked.
#[pyfunction]
pub(crate) fn after_fork() {
    if STARTED.get().is_some() {
        ORPHANED.store(true, Ordering::Relaxed);
    }
}
