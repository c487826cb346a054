//! The luma planes of the present images. The pass over an image stores them here for the temporal
//! metrics.

use fovqa_metrics::temporal::KeptPlane;

/// The luma of a pair, and of the reference in the frame before it.
#[derive(Default)]
pub(super) struct Lumas {
    /// Whether any metric needs the luma.
    wanted: bool,
    reference: KeptPlane,
    reference_before: KeptPlane,
    /// Position of the frame that the luma of the reference belongs to.
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

    /// The plane for the luma of the reference; `None` if it is filled already or not wanted.
    pub(super) fn reference_to_fill(&mut self, position: usize) -> Option<&mut KeptPlane> {
        if !self.wanted || self.at == Some(position) {
            return None;
        }
        std::mem::swap(&mut self.reference, &mut self.reference_before);
        self.before_at = self.at.replace(position);
        Some(&mut self.reference)
    }

    /// The plane for the luma of the test; `None` if it is not wanted.
    pub(super) fn test_to_fill(&mut self) -> Option<&mut KeptPlane> {
        self.wanted.then_some(&mut self.test)
    }

    /// The luma of the reference in the present frame and in the frame at `before`; `None` if that
    /// one is not there.
    pub(super) fn references(&self, before: usize) -> Option<(&KeptPlane, &KeptPlane)> {
        (self.before_at == Some(before)).then_some((&self.reference, &self.reference_before))
    }

    /// The luma of the test.
    pub(super) fn test(&self) -> &KeptPlane {
        &self.test
    }

    /// Swaps the luma of the test with another plane, whose memory is used again.
    pub(super) fn swap_test(&mut self, plane: &mut KeptPlane) {
        std::mem::swap(&mut self.test, plane);
    }
}
