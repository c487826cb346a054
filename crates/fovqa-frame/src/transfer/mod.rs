//! Transfer functions, one file each.

pub mod pq;
pub mod srgb;
