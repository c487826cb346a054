//! One frame of a sequence that was found: where its pictures stand in their sources.

/// One frame: its reference and the tests there are of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundFrame {
    /// Frame number.
    pub number: i64,
    /// Its place in the sequence, from 0: two frames follow each other where their positions differ by
    /// 1. Numbers that are missing on both sides have a position as well.
    pub position: usize,
    /// The reference: its place in its source.
    pub reference: usize,
    /// Motion and depth that have sources of their own.
    pub guides: GuideFrames,
    /// Tests: the index of their method, which rises, and their place in its source.
    pub tests: Vec<(usize, usize)>,
}

/// Places of the motion and the depth of a frame in sources of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GuideFrames {
    /// The motion.
    pub motion: Option<usize>,
    /// The depth.
    pub depth: Option<usize>,
}
