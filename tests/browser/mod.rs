//! `report.html` in a real browser, where one is installed.

mod chromium;
mod sequence;
mod still;
