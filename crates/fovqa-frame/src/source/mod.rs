//! Frames, wherever they come from: files on disk, a video, pictures in memory, or something that makes them.

mod error;
mod listing;
mod picture;

pub use error::SourceError;
pub use listing::{Doubt, Entry, Frames, Length, Listing, Numbering};
pub use picture::{InputId, MissingGuides, Picture, PictureGuides};

use std::fmt::Debug;
use std::path::PathBuf;

/// A sequence of frames: what they are called, how they are numbered, and their pictures.
///
/// Frames are asked for by their place in the [listing](Source::listing), in any order and from several
/// threads at once, unless the source [is read once](Source::is_read_once). How they are read (which layer
/// of a file, what becomes of alpha) is settled when a source is made.
pub trait Source: Debug + Send + Sync {
    /// Its frames, in order.
    fn listing(&self) -> &Listing;

    /// Width and height of a frame before any crop, as cheaply as they can be told.
    ///
    /// # Errors
    /// When they cannot be told.
    fn size(&self, frame: usize) -> Result<(usize, usize), SourceError>;

    /// Bytes of one pixel of its frames in memory: 3 for 8-bit RGB.
    fn bytes_per_pixel(&self) -> u64;

    /// Reads a frame, with the motion and depth that are in it where `guides` says so.
    ///
    /// # Errors
    /// When there is no such frame, or it cannot be read.
    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError>;

    /// Reads the motion and the depth of a frame, of a source that has nothing else.
    ///
    /// # Errors
    /// When there is no such frame, it cannot be read, or it has none.
    fn read_guides(&self, frame: usize) -> Result<PictureGuides, SourceError>;

    /// What a frame is made of, by the names that results have for it.
    fn origins(&self, frame: usize) -> Vec<(String, Origin)>;

    /// Frames a second, where the source says so itself.
    fn fps(&self) -> Option<f64> {
        None
    }

    /// Whether each frame can be read but once, in order. Frames that are passed over are gone.
    fn is_read_once(&self) -> bool {
        false
    }

    /// Whether there are frames behind those that have been read, in a source whose length is not known
    /// before its end.
    ///
    /// # Errors
    /// When that cannot be told.
    fn has_more(&self) -> Result<bool, SourceError> {
        Ok(false)
    }
}

/// What a frame is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// A file.
    File(PathBuf),
    /// Something without a file, such as parameters: the same where this is the same.
    Made(InputId),
}
