//! A frame that was read, with its motion, depth and notes.

use super::SourceError;
use crate::{Frame, Guides};

/// A frame that was read, with everything found in its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The frame.
    pub frame: Frame,
    /// Motion and depth, if they were asked for and exist.
    pub guides: Guides,
    /// Motion or depth that the user named but that does not exist.
    pub missing: MissingGuides,
    /// Notes for the user: one sentence each, with settings in braces as in [`SourceError::help`].
    pub notes: Vec<String>,
    /// The inputs it was made from, by name, if the source was asked for them.
    pub inputs: Vec<(String, InputId)>,
    /// Ratio of a pixel's width to its height, as the frame declares it; 1 if it declares none.
    pub pixel_aspect: f32,
}

impl Picture {
    /// A picture with nothing but a frame.
    pub fn new(frame: Frame) -> Self {
        Self {
            frame,
            guides: Guides::default(),
            missing: MissingGuides::default(),
            notes: Vec::new(),
            inputs: Vec::new(),
            pixel_aspect: 1.0,
        }
    }
}

/// Motion and depth that the user named, and the reasons why they are missing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MissingGuides {
    /// Why the motion is missing.
    pub motion: Option<SourceError>,
    /// Why the depth is missing.
    pub depth: Option<SourceError>,
}

/// The motion and depth of a frame, without its colours.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureGuides {
    /// Motion and depth; everything that was asked for exists.
    pub guides: Guides,
    /// Notes for the user, as in [`Picture`].
    pub notes: Vec<String>,
    /// The inputs it was made from, as in [`Picture`].
    pub inputs: Vec<(String, InputId)>,
}

/// The identity of an input, which distinguishes its versions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputId {
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 of the bytes in lower-case hexadecimal digits, as `sha256sum` prints it.
    pub sha256: String,
}
