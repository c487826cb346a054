//! Does the work of a call on a thread of its own. The calling thread meanwhile hands messages to Python and
//! looks for signals, so that Ctrl-C works and callbacks run where they were given.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;
use std::time::{Duration, Instant};

use fovqa::{Dialect, Events, ItemDone};
use fovqa_metrics::ReadBackError;
use pyo3::exceptions::PySystemExit;
use pyo3::prelude::*;

use crate::error::{bug, wrong_input};
use crate::threads;

/// How often signals are looked for.
const SIGNALS: Duration = Duration::from_millis(50);
/// How long an interrupted call waits for its work to end.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long the end of the interpreter waits for all work to end.
const LAST_PATIENCE: Duration = Duration::from_secs(10);

/// A message of the work.
enum Said {
    Warning(String),
    Failure(String, String),
    Note(String),
    Progress(usize, usize),
    Step(String, usize),
    Item,
}

/// The calls at work, each with the flag that interrupts it.
static CALLS: Mutex<Vec<Weak<AtomicBool>>> = Mutex::new(Vec::new());
/// The number of callers and workers that have not ended.
static AT_WORK: AtomicUsize = AtomicUsize::new(0);
/// Whether the interpreter is about to end.
static ENDING: AtomicBool = AtomicBool::new(false);

/// Counts a caller or a worker for as long as it exists. A function that prepares long lists counts itself from
/// its beginning.
pub(crate) struct AtWork;

impl AtWork {
    pub(crate) fn new() -> Self {
        AT_WORK.fetch_add(1, Ordering::SeqCst);
        Self
    }
}

impl Drop for AtWork {
    fn drop(&mut self) {
        AT_WORK.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Interrupts all calls and waits for them. It is called before the interpreter ends, because afterwards no
/// thread may use it.
#[pyfunction]
pub(crate) fn shutdown(py: Python<'_>) {
    ENDING.store(true, Ordering::SeqCst);
    for call in CALLS.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        if let Some(interrupted) = call.upgrade() {
            interrupted.store(true, Ordering::Relaxed);
        }
    }
    if !threads::is_orphan() {
        wait(py, LAST_PATIENCE, || AT_WORK.load(Ordering::SeqCst) == 0);
    }
}

/// Waits until something has ended, but not for long.
fn wait(py: Python<'_>, at_most: Duration, has_ended: impl Fn() -> bool + Send + Sync) {
    let begin = Instant::now();
    py.detach(|| {
        while !has_ended() && begin.elapsed() < at_most {
            thread::sleep(Duration::from_millis(2));
        }
    });
}

/// The end of work that nobody waits for any more. It unwinds the stack like a panic, but without a message:
/// everything between is left as after an error.
struct Interrupted;

/// Passes on what the library has to say.
struct Listener {
    said: Sender<Said>,
    interrupted: Arc<AtomicBool>,
    dialect: Dialect,
}

impl Listener {
    fn say(&self, said: Said) {
        if self.interrupted.load(Ordering::Relaxed) {
            std::panic::resume_unwind(Box::new(Interrupted));
        }
        // If nobody listens, nothing needs to be said.
        let _ = self.said.send(said);
    }
}

impl Events for Listener {
    fn warn(&self, message: &str) {
        self.say(Said::Warning(self.dialect.spell(message)));
    }

    fn progress(&self, done: usize, total: usize) {
        self.say(Said::Progress(done, total));
    }

    fn step(&self, what: &str, items: usize) -> ItemDone {
        self.say(Said::Step(what.to_owned(), items));
        // Items are done on several threads, and an unwinding thread of a pool ends the work as well.
        let (said, interrupted) = (Mutex::new(self.said.clone()), Arc::clone(&self.interrupted));
        Box::new(move || {
            if interrupted.load(Ordering::Relaxed) {
                std::panic::resume_unwind(Box::new(Interrupted));
            }
            if let Ok(said) = said.lock() {
                let _ = said.send(Said::Item);
            }
        })
    }

    fn failure(&self, message: &str, help: &str) {
        self.say(Said::Failure(self.dialect.spell(message), self.dialect.spell(help)));
    }

    fn note(&self, message: &str) {
        self.say(Said::Note(self.dialect.spell(message)));
    }
}

/// What the work said, beside its result.
#[derive(Debug, Default)]
pub(crate) struct Heard {
    /// Warnings, each one sentence.
    pub(crate) warnings: Vec<String>,
    /// What could not be done, with how to mend it.
    pub(crate) failures: Vec<(String, String)>,
    /// Notes.
    pub(crate) notes: Vec<String>,
}

/// Does `work` on a thread of its own, and returns its result with what it said. `progress` is called with
/// what is done, the number of items done, and their total, in the calling thread.
pub(crate) fn work<T: Send + 'static>(
    py: Python<'_>,
    dialect: Dialect,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Events) -> T + Send + 'static,
) -> PyResult<(T, Heard)> {
    threads::started()?;
    if ENDING.load(Ordering::SeqCst) {
        return Err(PySystemExit::new_err(()));
    }
    // A thread that is in the middle of a call must not be there any more when the interpreter ends.
    let _calling = AtWork::new();
    let (said, heard) = channel();
    let interrupted = Arc::new(AtomicBool::new(false));
    {
        let mut calls = CALLS.lock().unwrap_or_else(PoisonError::into_inner);
        calls.retain(|call| call.strong_count() > 0);
        calls.push(Arc::downgrade(&interrupted));
    }
    let listener = Listener { said, interrupted: Arc::clone(&interrupted), dialect };
    let at_work = AtWork::new();
    let worker = thread::Builder::new().name("fovqa".to_owned()).spawn(move || {
        // The sender is dropped at the end, which wakes the caller.
        let result = catch_unwind(AssertUnwindSafe(|| work(&listener)));
        drop(at_work);
        result
    });
    let worker = worker.map_err(|error| {
        wrong_input(format!("a thread cannot be started: {error}"), "end other programs")
    })?;
    let mut of_work = Heard::default();
    let mut state = Progress { progress, what: "frames".to_owned(), done: 0, total: 0 };
    if let Err(error) = listen(py, heard, &interrupted, &mut of_work, &mut state) {
        interrupted.store(true, Ordering::Relaxed);
        wait(py, PATIENCE, || worker.is_finished());
        return Err(error);
    }
    match py.detach(|| worker.join()) {
        Ok(Ok(result)) => Ok((result, of_work)),
        Ok(Err(payload)) | Err(payload) => Err(of_panic(&*payload)),
    }
}

/// Hears what the work says, until it ends.
fn listen(
    py: Python<'_>,
    mut heard: Receiver<Said>,
    interrupted: &AtomicBool,
    of_work: &mut Heard,
    progress: &mut Progress<'_, '_>,
) -> PyResult<()> {
    let mut looked = Instant::now();
    loop {
        // Before this call is given up, only the end of the interpreter interrupts it.
        if interrupted.load(Ordering::Relaxed) {
            return Err(PySystemExit::new_err(()));
        }
        let next;
        (next, heard) = py.detach(move || (heard.recv_timeout(SIGNALS), heard));
        match next {
            Ok(Said::Warning(message)) => of_work.warnings.push(message),
            Ok(Said::Failure(message, help)) => of_work.failures.push((message, help)),
            Ok(Said::Note(message)) => of_work.notes.push(message),
            Ok(Said::Progress(done, total)) => progress.frames(done, total)?,
            Ok(Said::Step(what, items)) => progress.step(what, items)?,
            Ok(Said::Item) => progress.item()?,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        if looked.elapsed() >= SIGNALS {
            py.check_signals()?;
            looked = Instant::now();
        }
    }
}

/// Counts what is done, for the callback.
struct Progress<'a, 'py> {
    progress: Option<&'a Bound<'py, PyAny>>,
    what: String,
    done: usize,
    total: usize,
}

impl Progress<'_, '_> {
    fn frames(&mut self, done: usize, total: usize) -> PyResult<()> {
        (self.what, self.done, self.total) = ("frames".to_owned(), done, total);
        self.tell()
    }

    fn step(&mut self, what: String, items: usize) -> PyResult<()> {
        (self.what, self.done, self.total) = (what, 0, items);
        self.tell()
    }

    fn item(&mut self) -> PyResult<()> {
        self.done += 1;
        self.tell()
    }

    fn tell(&self) -> PyResult<()> {
        match self.progress.filter(|_| self.total > 0) {
            Some(progress) => {
                progress.call1((self.what.as_str(), self.done, self.total)).map(|_| ())
            }
            None => Ok(()),
        }
    }
}

/// The message of the last panic that was a bug.
static BUG: Mutex<Option<String>> = Mutex::new(None);

/// Keeps the message of a panic instead of printing it: it becomes an exception.
pub(crate) fn watch_panics() {
    std::panic::set_hook(Box::new(|info| {
        if fovqa_io::is_contained() || info.payload().is::<ReadBackError>() {
            return;
        }
        let place = info.location().map(|place| format!(" at {}:{}", place.file(), place.line()));
        let what = info.payload_as_str().unwrap_or("no reason given");
        if let Ok(mut bug) = BUG.lock() {
            *bug = Some(format!("{what}{}", place.unwrap_or_default()));
        }
    }));
}

fn of_panic(payload: &(dyn Any + Send)) -> PyErr {
    if payload.is::<Interrupted>() {
        // Only the end of the interpreter interrupts work whose caller still waits.
        return PySystemExit::new_err(());
    }
    if let Some(error) = payload.downcast_ref::<ReadBackError>() {
        let help = "check the disk of the folder for temporary files, or choose another one with the variable TMPDIR";
        return wrong_input(error.to_string(), help);
    }
    let what = BUG.lock().ok().and_then(|mut bug| bug.take());
    bug(what.as_deref().unwrap_or("no reason given"))
}
