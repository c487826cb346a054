//! A frame that was read, with what was found beside it.

use super::SourceError;
use crate::{Frame, Guides};

/// A frame that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The frame.
    pub frame: Frame,
    /// Motion and depth, where they were asked for and are there.
    pub guides: Guides,
    /// What was asked for by name and is not there.
    pub missing: MissingGuides,
    /// What the user should know of it: a sentence each, with settings in braces as in
    /// [`SourceError::help`].
    pub notes: Vec<String>,
    /// What it was made of, by name, where the source was asked to tell.
    pub inputs: Vec<(String, InputId)>,
    /// Width of a pixel over its height, as the frame declares it; 1 where it declares nothing.
    pub pixel_aspect: f32,
}

impl Picture {
    /// A frame and nothing beside it.
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

/// Motion and depth that were asked for by name, and why they are not there.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MissingGuides {
    /// The motion.
    pub motion: Option<SourceError>,
    /// The depth.
    pub depth: Option<SourceError>,
}

/// Motion or depth without a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureGuides {
    /// What was asked for: all of it is there.
    pub guides: Guides,
    /// As of [`Picture`].
    pub notes: Vec<String>,
    /// As of [`Picture`].
    pub inputs: Vec<(String, InputId)>,
}

/// What tells one version of an input from another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputId {
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 of the bytes in lower-case hexadecimal digits, as `sha256sum` prints it.
    pub sha256: String,
}
