//! Shows warnings and a progress bar on stderr. There is no bar if stderr is not a terminal.

use std::cell::OnceCell;
use std::io::IsTerminal;

use fovqa::Events;
use indicatif::{ProgressBar, ProgressStyle};

use crate::diagnostic;
use crate::dialect::Dialect;

/// Prints the messages of a run on stderr.
#[derive(Default)]
pub(crate) struct Terminal {
    dialect: Dialect,
    bar: OnceCell<ProgressBar>,
}

impl Terminal {
    /// Makes a listener that uses the given terms.
    pub(crate) fn speaking(dialect: Dialect) -> Self {
        Self { dialect, ..Self::default() }
    }
}

impl Events for Terminal {
    fn warn(&self, message: &str) {
        let message = &self.dialect.spell(message);
        match self.bar.get() {
            Some(bar) => bar.suspend(|| diagnostic::warning(message)),
            None => diagnostic::warning(message),
        }
    }

    fn progress(&self, done: usize, total: usize) {
        if total < 2 || !std::io::stderr().is_terminal() {
            return;
        }
        let bar = self.bar.get_or_init(|| {
            let style = ProgressStyle::with_template("{bar:30} {pos}/{len} frames, {eta} left");
            ProgressBar::new(total as u64)
                .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        bar.set_position(done as u64);
    }

    /// Removes the progress bar from the screen.
    fn finish(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }

    fn failure(&self, message: &str, help: &str) {
        diagnostic::error(&self.dialect.spell(message), &self.dialect.spell(help));
    }

    fn note(&self, message: &str) {
        diagnostic::note(message);
    }
}
