//! Temporal metrics: the change of pictures over time, along their motion. Each frame is compared with the
//! frames before it, of which only as many are kept as a metric needs.

pub mod atd;
pub mod flicker;
mod kept_motion;
pub(crate) mod kept_plane;
mod source;
#[cfg(test)]
mod tests;
mod time_input;

pub use kept_motion::KeptMotion;
pub use kept_plane::KeptPlane;
pub use time_input::{FrameBefore, Picture, TimeInput};
