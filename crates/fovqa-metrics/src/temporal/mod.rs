//! Temporal metrics: each frame is compared with the one before it, and only that one is kept.

pub mod atd;
pub(crate) mod kept_plane;
mod source;
#[cfg(test)]
mod tests;

pub use atd::{AtdFrame, AtdSum, differences};
pub use kept_plane::KeptPlane;
pub use source::Link;
