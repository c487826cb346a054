//! Emulation: what a foveation method would have shown, from a finished frame.

mod counts;
mod fetch;
mod image;
mod picture;
mod read_frame;
mod rounded;
mod sampling;
mod write_frame;

pub use counts::Counts;
pub use image::Image;
pub use picture::Picture;
pub use sampling::Sampling;
pub use write_frame::WriteFrameError;
