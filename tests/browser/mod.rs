//! The pages of runs and studies in a real browser, where one is installed.

mod chromium;
mod gate;
mod pictures;
mod sequence;
mod still;
mod study;
