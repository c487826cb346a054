//! `fovqa study`: golden values, mistakes, unusual tables.

mod fits;
mod golden;
mod mistakes;
mod unusual;
