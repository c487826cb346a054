//! Exit codes, and the handling of panics and interrupts.

use std::any::Any;
use std::sync::atomic::{AtomicBool, Ordering};

use fovqa_metrics::ReadBackError;

use crate::diagnostic;

/// How a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    /// The command is done.
    Done,
    /// A gate failed.
    Gate,
    /// The command line contains a mistake.
    Usage,
    /// An input is missing, unreadable or does not fit, or the output cannot be written.
    Input,
    /// A bug in fovqa.
    Bug,
}

const INTERRUPTED: i32 = 130;

impl Exit {
    /// The more important of two exits: mistakes on the command line come before errors of inputs,
    /// and these before gates.
    pub(crate) fn or_worse(self, other: Self) -> Self {
        let rank = |exit| match exit {
            Exit::Done => 0,
            Exit::Gate => 1,
            Exit::Input => 2,
            Exit::Usage => 3,
            Exit::Bug => 4,
        };
        if rank(other) > rank(self) { other } else { self }
    }

    /// The code with which the process ends.
    pub(crate) fn code(self) -> u8 {
        match self {
            Exit::Done => 0,
            Exit::Gate => 1,
            Exit::Usage => 2,
            Exit::Input => 3,
            Exit::Bug => 70,
        }
    }
}

/// Whether a bug was reported.
static SAID: AtomicBool = AtomicBool::new(false);

/// The exit after a panic: of an error that has no other way to be reported, or of a bug.
pub(crate) fn of_panic(payload: &(dyn Any + Send)) -> Exit {
    let Some(error) = payload.downcast_ref::<ReadBackError>() else { return bug() };
    let help = "check the disk of the folder for temporary files, or choose another one with the variable TMPDIR";
    diagnostic::error(&error.to_string(), help);
    Exit::Input
}

/// The exit for a bug. The bug is reported here if the panic hook could not distinguish it from the
/// error of a decoder.
fn bug() -> Exit {
    if !SAID.load(Ordering::Relaxed) {
        diagnostic::error(
            "fovqa has a bug",
            "please report it with the command line and the input",
        );
    }
    Exit::Bug
}

/// Reports a panic in fovqa's own words if it is a bug. A panic that becomes an error is not reported
/// here.
pub(crate) fn watch_panics() {
    std::panic::set_hook(Box::new(|info| {
        if fovqa_io::is_contained() || info.payload().is::<ReadBackError>() {
            return;
        }
        SAID.store(true, Ordering::Relaxed);
        let place = info.location().map(|l| format!(" at {}:{}", l.file(), l.line()));
        let what = info.payload_as_str().unwrap_or("no reason given");
        diagnostic::error(
            &format!("fovqa has a bug{}: {what}", place.unwrap_or_default()),
            "please report it with the command line and, if you can, the input",
        );
    }));
}

/// Ends the process with code 130 on Ctrl-C. Files are always written as a whole, so no partial
/// file remains.
pub(crate) fn watch_interrupts() {
    // If no handler can be set, the operating system ends the process, which has the same effect.
    let _ = ctrlc::set_handler(|| {
        diagnostic::note("interrupted");
        #[allow(clippy::exit, reason = "the one place where the process ends from outside")]
        std::process::exit(INTERRUPTED);
    });
}
