//! One sequence over time: each frame against the one before it, which is all that is kept.

pub mod atd;
mod depth_plane;
mod luma_plane;
mod source;
#[cfg(test)]
mod tests;

pub use atd::{AtdBand, AtdFrame, differences};
pub use depth_plane::DepthPlane;
pub use luma_plane::LumaPlane;
pub use source::Link;
