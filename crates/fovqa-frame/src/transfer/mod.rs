//! Transfer functions, one file each.

pub mod srgb;
