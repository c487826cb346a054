//! Transfer functions, one file each.

pub mod pq;
pub mod pu21;
pub mod srgb;
