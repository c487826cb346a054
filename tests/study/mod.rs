//! `fovqa study`: golden values, mistakes, unusual tables.

mod golden;
mod mistakes;
mod unusual;
