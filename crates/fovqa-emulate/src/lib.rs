//! Emulation: what a foveation method would have shown, from a finished frame.

mod blur;
mod convolve;
mod counts;
mod cps;
mod deamp;
mod fetch;
mod fxaa;
mod grids;
mod guenter;
mod image;
mod layer_axis;
mod linear;
mod log_polar;
mod offsets;
mod picture;
mod places;
mod polar_view;
mod radial;
mod ragged;
mod read_frame;
mod rmfr;
mod rounded;
mod sampling;
mod separable;
mod sums;
mod turn;
mod vafr;
mod visual_polar;
mod write_frame;

pub use counts::Counts;
pub use image::Image;
pub use picture::Picture;
pub use sampling::Sampling;
pub use write_frame::WriteFrameError;
