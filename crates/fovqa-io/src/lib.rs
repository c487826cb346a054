//! Reads frames from files and writes pictures to files: PNG, JPEG and OpenEXR (with motion and
//! depth), sequences of them, and y4m video, with limits on what is read.
//!
//! Every failure of a decoder (an error, a panic, a declared size beyond reason) becomes a
//! [`ReadError`] that names the file, so that one bad file never affects the others.

mod alpha;
mod contain;
mod decode;
mod decoded;
mod error;
mod exif;
mod exr;
mod files;
mod guides;
mod input_id;
mod jpeg;
mod note;
mod opened;
mod png;
mod read_guides;
mod read_options;
pub mod sequence;
mod small_file;
mod sources;
mod write;
mod y4m;

pub use alpha::AlphaPolicy;
pub use contain::{contained, is_contained};
pub use decode::{frame_size, read_frame, read_frame_and_hash, read_mask};
pub use decoded::{Decoded, DecodedGuides};
pub use error::{ReadError, ReadErrorKind};
pub use files::SourceOptions;
pub use guides::{
    ChannelSearch, DepthChannels, GuideOptions, GuidePreset, GuideSearch, MotionChannels,
    MotionUnit, NamedMotion,
};
pub use input_id::{IdWriter, id_of, id_of_file};
pub use jpeg::kind::JpegKind;
pub use note::Note;
pub use read_guides::{read_guides, read_guides_and_hash};
pub use read_options::{FormatOptions, ReadOptions};
pub use small_file::{open_regular_file, read_head, read_small_file};
pub use sources::{OpenError, open_source};
pub use write::{
    EncodeError, FrameFormat, encode_exr_with_guides, encode_frame, exr_gray, exr_gray_half,
    png_rgb8,
};
pub use y4m::options::{CodeRange, ColourMatrix, Y4mOptions};
pub use y4m::video_stream;
