//! The doubts about the pairs of a comparison: each kind once.

use serde::{Deserialize, Serialize};

use crate::report::FrameResult;

/// A likely mistake in some pairs of a comparison.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct DoubtRecord {
    /// The check, such as `exposure`.
    pub check: String,
    /// The number of the first frame that it is about.
    pub frame: i64,
    /// How many frames it is about. Of a sequence, not every frame is checked.
    pub frames: usize,
    /// What was seen in the first of them.
    pub message: String,
}

impl DoubtRecord {
    /// The doubts about some frames, in the order in which they first come.
    pub(crate) fn all(frames: &[FrameResult]) -> Vec<Self> {
        let mut doubts: Vec<Self> = Vec::new();
        for frame in frames {
            for doubt in &frame.doubts {
                match doubts.iter_mut().find(|known| known.check == doubt.check) {
                    Some(known) => known.frames += 1,
                    None => doubts.push(Self {
                        check: doubt.check.clone(),
                        frame: frame.frame,
                        frames: 1,
                        message: doubt.message.clone(),
                    }),
                }
            }
        }
        doubts
    }
}
