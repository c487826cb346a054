//! A frame that was read from a file, with remarks, motion and depth.

use fovqa_frame::{Frame, Guides};

use crate::guides::search::GuideSearch;
use crate::note::Note;
use crate::read_options::ReadOptions;

/// A frame and remarks about its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// The frame.
    pub frame: Frame,
    /// Remarks.
    pub notes: Vec<Note>,
    /// Motion and depth, where they were asked for and are there.
    pub guides: Guides,
    /// What was looked for to find them.
    pub guide_search: GuideSearch,
    /// Width of a pixel over its height, as the file declares it; 1 where it declares nothing.
    pub pixel_aspect: f32,
}

impl Decoded {
    /// A frame of a file that cannot hold guides.
    pub(crate) fn without_guides(frame: Frame, notes: Vec<Note>, options: &ReadOptions) -> Self {
        let guide_search = GuideSearch::in_vain(&options.guides);
        Self { frame, notes, guides: Guides::default(), guide_search, pixel_aspect: 1.0 }
    }
}

/// Motion and depth that were read from a file, with remarks about the file.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedGuides {
    /// The guides; whatever was asked for is there.
    pub guides: Guides,
    /// Remarks.
    pub notes: Vec<Note>,
    /// Which channels they are.
    pub search: GuideSearch,
}
