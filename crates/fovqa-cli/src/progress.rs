//! Shows warnings and progress on stderr. There is no bar if stderr is not a terminal.

use std::cell::{OnceCell, RefCell};
use std::io::IsTerminal;
use std::time::Duration;

use fovqa::{Events, ItemDone};
use indicatif::{ProgressBar, ProgressStyle};

use crate::{diagnostic, width};
use fovqa::Dialect;

/// Prints the messages of a run on stderr.
#[derive(Default)]
pub(crate) struct Terminal {
    dialect: Dialect,
    /// The bar of the frames.
    frames: OnceCell<ProgressBar>,
    /// The bar of the step after them.
    step: RefCell<Option<ProgressBar>>,
}

/// Columns of a bar on a wide terminal.
const BAR: usize = 30;
/// Columns for the text beside a bar.
const BESIDE: usize = 32;
/// How often the sign of a step without a bar moves.
const TICK: Duration = Duration::from_millis(120);

impl Terminal {
    /// Makes a listener that uses the given terms.
    pub(crate) fn speaking(dialect: Dialect) -> Self {
        Self { dialect, ..Self::default() }
    }

    /// Prints a message without mixing it with the bar.
    fn beside_the_bar(&self, print: impl FnOnce()) {
        let step = self.step.borrow();
        match step.as_ref().or(self.frames.get()).filter(|bar| !bar.is_finished()) {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}

/// A bar, followed by a text.
fn bar(items: usize, text: &str) -> ProgressBar {
    let columns = width::of_stderr().map_or(BAR, |width| width.saturating_sub(BESIDE));
    let columns = columns.clamp(1, BAR);
    let style = ProgressStyle::with_template(&format!("{{bar:{columns}}} {text}"));
    ProgressBar::new(items as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// A bar that leaves the screen when it is dropped.
struct Shown(ProgressBar);

impl Drop for Shown {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Events for Terminal {
    fn warn(&self, message: &str) {
        let message = &self.dialect.spell(message);
        self.beside_the_bar(|| diagnostic::warning(message));
    }

    fn progress(&self, done: usize, total: usize) {
        if total < 2 || !std::io::stderr().is_terminal() {
            return;
        }
        let bar = self.frames.get_or_init(|| bar(total, "{pos}/{len} frames, {eta} left"));
        bar.set_position(done as u64);
    }

    /// Removes the progress bar from the screen.
    fn finish(&self) {
        if let Some(bar) = self.frames.get() {
            bar.finish_and_clear();
        }
    }

    fn step(&self, what: &str, items: usize) -> ItemDone {
        if !std::io::stderr().is_terminal() {
            return Box::new(|| {});
        }
        let bar = if items > 1 {
            let bar = bar(items, "{msg} {pos}/{len}").with_message(what.to_owned());
            bar.tick();
            bar
        } else {
            let style = ProgressStyle::with_template("{spinner} {msg}");
            let bar = ProgressBar::new_spinner().with_message(what.to_owned());
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            bar.enable_steady_tick(TICK);
            bar
        };
        *self.step.borrow_mut() = Some(bar.clone());
        let shown = Shown(bar);
        Box::new(move || shown.0.inc(1))
    }

    fn failure(&self, message: &str, help: &str) {
        let (message, help) = (self.dialect.spell(message), self.dialect.spell(help));
        self.beside_the_bar(|| diagnostic::error(&message, &help));
    }

    fn note(&self, message: &str) {
        self.beside_the_bar(|| diagnostic::note(message));
    }
}
