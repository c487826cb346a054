//! One frame of a sequence that was found, with the positions of its images in their sources.

/// One frame: its reference and all of its tests.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundFrame {
    /// Frame number.
    pub number: i64,
    /// Position in the sequence, counted from 0. Two frames are consecutive if their positions
    /// differ by 1. Numbers that are missing on both sides have a position as well.
    pub position: usize,
    /// Index of the reference in its source.
    pub reference: usize,
    /// Motion and depth that come from sources of their own.
    pub guides: GuideFrames,
    /// Tests: the index of the method, in ascending order, and the index of the image in the
    /// method's source.
    pub tests: Vec<(usize, usize)>,
}

/// Indices of a frame's motion and depth in sources of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GuideFrames {
    /// Index of the motion.
    pub motion: Option<usize>,
    /// Index of the depth.
    pub depth: Option<usize>,
}
