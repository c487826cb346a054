//! Exit codes, and what happens on the ways out nobody chose.

use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::diagnostic;

/// How a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done.
    Done,
    /// A gate fails.
    Gate,
    /// The command line is wrong.
    Usage,
    /// An input is missing, unreadable or does not fit, or the output cannot be written.
    Input,
    /// A mistake of ours.
    Bug,
}

const INTERRUPTED: i32 = 130;

impl Exit {
    /// Of two ways to end, the one that counts: what is wrong with the command line before inputs, and
    /// these before gates.
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

    fn code(self) -> u8 {
        match self {
            Exit::Done => 0,
            Exit::Gate => 1,
            Exit::Usage => 2,
            Exit::Input => 3,
            Exit::Bug => 70,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit.code())
    }
}

/// Whether a bug has been said.
static SAID: AtomicBool = AtomicBool::new(false);

/// The exit of a bug, which is said if no hook could tell it from a decoder's mistake.
pub(crate) fn bug() -> Exit {
    if !SAID.load(Ordering::Relaxed) {
        diagnostic::error(
            "fovqa has a bug",
            "please report it with the command line and the input",
        );
    }
    Exit::Bug
}

/// A panic that is not about to become a file's error is a bug: say so, in our own words.
pub(crate) fn watch_panics() {
    std::panic::set_hook(Box::new(|info| {
        if fovqa_io::is_contained() {
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

/// Ctrl-C ends the process with 130; files are only ever written whole, so nothing is half done.
pub(crate) fn watch_interrupts() {
    // Without a handler the system's own way out is left, which is as good.
    let _ = ctrlc::set_handler(|| {
        diagnostic::note("interrupted");
        #[allow(clippy::exit, reason = "the one place where the process ends from outside")]
        std::process::exit(INTERRUPTED);
    });
}
