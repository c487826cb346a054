//! Transfer functions, one file each.

mod chords;
pub mod pq;
pub mod pu21;
pub mod srgb;
