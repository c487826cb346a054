//! Sources of frames: files on disk, a video, pictures in memory, or a generator.

mod error;
mod listing;
mod picture;

pub use error::SourceError;
pub use listing::{Doubt, Entry, Frames, Length, Listing, Numbering};
pub use picture::{InputId, MissingGuides, Picture, PictureGuides};

use std::fmt::Debug;
use std::path::PathBuf;

/// A sequence of frames: their names, their numbers and their pictures.
///
/// Frames are read by their index in the [listing](Source::listing), in any order and from several
/// threads at once, unless the source [can be read only once](Source::is_read_once). Options for
/// reading, such as the layer of a file or the treatment of alpha, are fixed when a source is made.
pub trait Source: Debug + Send + Sync {
    /// Its frames, in order.
    fn listing(&self) -> &Listing;

    /// Width and height of a frame before any crop. This reads as little of the frame as possible.
    ///
    /// # Errors
    /// When the size cannot be found out.
    fn size(&self, frame: usize) -> Result<(usize, usize), SourceError>;

    /// Memory for one pixel of its frames, in bytes: 3 for 8-bit RGB.
    fn bytes_per_pixel(&self) -> u64;

    /// Reads a frame. If `guides` is set, its motion and depth are read as well.
    ///
    /// # Errors
    /// When there is no such frame, or it cannot be read.
    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError>;

    /// Reads the motion and depth of a frame from a source that holds only these.
    ///
    /// # Errors
    /// When there is no such frame, it cannot be read, or it has none.
    fn read_guides(&self, frame: usize) -> Result<PictureGuides, SourceError>;

    /// The inputs from which a frame is made, with their names in results.
    fn origins(&self, frame: usize) -> Vec<(String, Origin)>;

    /// The frame rate in frames per second, if the source declares one.
    fn fps(&self) -> Option<f64> {
        None
    }

    /// Bits of the codes that its samples were computed from, if they are encoded floats instead of
    /// codes, as those of a video are.
    fn code_bits(&self) -> Option<u32> {
        None
    }

    /// Whether each frame can be read only once, in order. A frame that is skipped cannot be read
    /// later.
    fn is_read_once(&self) -> bool {
        false
    }

    /// Whether there are more frames after those that have been read, in a source whose length is
    /// not known before its end.
    ///
    /// # Errors
    /// When this cannot be found out.
    fn has_more(&self) -> Result<bool, SourceError> {
        Ok(false)
    }
}

/// An input from which a frame is made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// A file.
    File(PathBuf),
    /// Something without a file, such as parameters. Equal identities mean equal content.
    Made(InputId),
}
