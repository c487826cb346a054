//! Transfer functions, one per file.

mod chords;
pub mod pq;
pub mod pu21;
pub mod srgb;
