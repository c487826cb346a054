//! A frame that was read from a file, with its notes, motion and depth.

use fovqa_frame::{Frame, Guides};

use crate::guides::search::GuideSearch;
use crate::note::Note;
use crate::read_options::ReadOptions;

/// A frame that was read from a file, with everything found beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// The frame.
    pub frame: Frame,
    /// Notes about the file.
    pub notes: Vec<Note>,
    /// Motion and depth, if they were asked for and exist.
    pub guides: Guides,
    /// The channels that were looked for as motion and depth.
    pub guide_search: GuideSearch,
    /// Ratio of a pixel's width to its height, as the file declares it; 1 if it declares none.
    pub pixel_aspect: f32,
}

impl Decoded {
    /// A frame from a file format that cannot hold motion or depth.
    pub(crate) fn without_guides(frame: Frame, notes: Vec<Note>, options: &ReadOptions) -> Self {
        let guide_search = GuideSearch::without_channels(&options.guides);
        Self { frame, notes, guides: Guides::default(), guide_search, pixel_aspect: 1.0 }
    }
}

/// Motion and depth that were read from a file, with notes about the file.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedGuides {
    /// Motion and depth; everything that was asked for exists.
    pub guides: Guides,
    /// Notes about the file.
    pub notes: Vec<Note>,
    /// The channels from which they were read.
    pub search: GuideSearch,
}
