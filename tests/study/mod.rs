//! `fovqa study`: golden values, mistakes, unusual tables.

mod files;
mod fits;
mod golden;
mod mistakes;
mod of_runs;
mod unusual;
