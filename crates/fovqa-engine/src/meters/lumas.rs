//! The luma of the pictures at hand, which the pass over a picture leaves for what is measured over time.

use fovqa_metrics::temporal::KeptPlane;

/// The luma of a pair, and of the reference before it.
#[derive(Default)]
pub(super) struct Lumas {
    /// Whether anybody wants them.
    wanted: bool,
    reference: KeptPlane,
    reference_before: KeptPlane,
    /// Positions of the frames the two are of.
    at: Option<usize>,
    before_at: Option<usize>,
    test: KeptPlane,
}

impl Lumas {
    pub(super) fn new(wanted: bool) -> Self {
        Self { wanted, ..Self::default() }
    }

    pub(super) fn are_wanted(&self) -> bool {
        self.wanted
    }

    /// Where the reference's goes; `None` where it is there already, or not wanted.
    pub(super) fn reference_to_fill(&mut self, position: usize) -> Option<&mut KeptPlane> {
        if !self.wanted || self.at == Some(position) {
            return None;
        }
        std::mem::swap(&mut self.reference, &mut self.reference_before);
        self.before_at = self.at.replace(position);
        Some(&mut self.reference)
    }

    /// Where the test's goes.
    pub(super) fn test_to_fill(&mut self) -> Option<&mut KeptPlane> {
        self.wanted.then_some(&mut self.test)
    }

    /// The reference's, now and in the frame at `before`; `None` where that is not there.
    pub(super) fn references(&self, before: usize) -> Option<(&KeptPlane, &KeptPlane)> {
        (self.before_at == Some(before)).then_some((&self.reference, &self.reference_before))
    }

    /// The test's.
    pub(super) fn test(&self) -> &KeptPlane {
        &self.test
    }

    /// Changes the test's for another plane, whose memory is used again.
    pub(super) fn swap_test(&mut self, plane: &mut KeptPlane) {
        std::mem::swap(&mut self.test, plane);
    }
}
