//! `report.html` in a real browser, where one is installed.

mod chromium;
mod pictures;
mod sequence;
mod still;
