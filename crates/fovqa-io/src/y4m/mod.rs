//! YUV4MPEG2 video (`*.y4m`), as `ffmpeg -f yuv4mpegpipe` writes it, with 8, 10 or 12 bits, from
//! files and from streams.
//!
//! A header line is followed by frames. Each frame has a line that begins with `FRAME`, the plane
//! of Y', and those of Cb and Cr if there is colour. Nothing is rounded on the way to R'G'B'
//! ([`convert`]).

mod colour;
mod convert;
mod file;
mod frames;
mod header;
pub(crate) mod options;
mod stream;

pub(crate) use file::{VideoKind, is_video_name, open_video, video_kind};
pub(crate) use stream::standard_input;
pub use stream::video_stream;
