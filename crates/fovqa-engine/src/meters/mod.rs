//! What runs over the frames of a view.

pub(crate) mod light;
pub(crate) mod temporal;

pub use light::FvvdpMaps;
