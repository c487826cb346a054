//! Encodes pictures as files in memory. The caller writes them to disk as a whole.

mod error;
mod exr_frame;
mod format;
mod format_of_path;
mod frame;
mod jpeg_frame;
mod maps;
mod png_frame;
mod visible;

pub use error::EncodeError;
pub use exr_frame::encode_exr_with_guides;
pub use format::FrameFormat;
pub use frame::encode_frame;
pub use maps::{exr_gray, exr_gray_half, png_rgb8};
