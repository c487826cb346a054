//! The last frames of a sequence.

use std::collections::VecDeque;

use fovqa_frame::{Guides, Mask};
use fovqa_metrics::temporal::{KeptMotion, KeptPlane};

/// The frames before the present one, the nearest first. The memory of the oldest frame is used for
/// the next one.
pub(super) struct History {
    frames: VecDeque<Kept>,
    extent: Extent,
}

/// How much is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// The number of frames.
    pub(super) frames: usize,
    /// Whether depth is kept.
    pub(super) depth: bool,
}

/// What is kept of a frame.
#[derive(Default)]
pub(super) struct Kept {
    /// Position of the frame.
    position: usize,
    pub(super) luma: KeptPlane,
    motion: KeptMotion,
    has_motion: bool,
    depth: KeptPlane,
    has_depth: bool,
    /// The pixels that count, if not only the mask of the view decides that.
    pub(super) mask: Option<Mask>,
}

impl Kept {
    /// Its motion; `None` if it has none.
    pub(super) fn motion(&self) -> Option<&KeptMotion> {
        self.has_motion.then_some(&self.motion)
    }

    /// Its depth; `None` if it has none or depth is not kept.
    pub(super) fn depth(&self) -> Option<&KeptPlane> {
        self.has_depth.then_some(&self.depth)
    }
}

impl History {
    pub(super) fn new(extent: Extent) -> Self {
        Self { frames: VecDeque::new(), extent }
    }

    /// Keeps the frame at `position`. `luma` swaps its luma with a plane whose memory is used again.
    pub(super) fn push(
        &mut self,
        position: usize,
        guides: &Guides,
        mask: Option<Mask>,
        luma: impl FnOnce(&mut KeptPlane),
    ) {
        let Extent { frames, depth } = self.extent;
        let is_full = self.frames.len() >= frames;
        let oldest = if is_full { self.frames.pop_back() } else { None };
        let mut kept = oldest.unwrap_or_default();
        luma(&mut kept.luma);
        // The motion of the frame before the present one is only followed by metrics that go on from
        // there.
        let motion = guides.motion.as_ref().filter(|_| frames > 1);
        kept.has_motion = motion.is_some();
        if let Some(motion) = motion {
            kept.motion.take(motion);
        }
        let depth = guides.depth.as_ref().filter(|_| depth);
        kept.has_depth = depth.is_some();
        if let Some(depth) = depth {
            kept.depth.take(depth);
        }
        (kept.position, kept.mask) = (position, mask);
        self.frames.push_front(kept);
    }

    /// The `count` frames before the one at `position`; `None` if one of them is not there.
    pub(super) fn before(&self, position: usize, count: usize) -> Option<Vec<&Kept>> {
        let kept = self.frames.iter().zip(1..=count);
        let kept: Vec<&Kept> = kept
            .filter(|(kept, back)| position.checked_sub(*back) == Some(kept.position))
            .map(|(kept, _)| kept)
            .collect();
        (kept.len() == count).then_some(kept)
    }
}
