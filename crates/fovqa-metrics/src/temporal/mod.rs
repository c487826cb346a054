//! One sequence over time: each frame against the one before it, which is all that is kept.

pub mod atd;
pub(crate) mod kept_plane;
mod source;
#[cfg(test)]
mod tests;

pub use atd::{AtdFrame, AtdSum, differences};
pub use kept_plane::KeptPlane;
pub use source::Link;
