//! The luma planes of the present images. The pass over an image stores them here for the temporal
//! metrics.

use fovqa_metrics::temporal::KeptPlane;

/// The luma of a pair.
#[derive(Default)]
pub(super) struct Lumas {
    /// Whether any metric needs the luma.
    wanted: bool,
    reference: KeptPlane,
    /// Position of the frame that the luma of the reference belongs to.
    at: Option<usize>,
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
        self.at = Some(position);
        Some(&mut self.reference)
    }

    /// The plane for the luma of the test; `None` if it is not wanted.
    pub(super) fn test_to_fill(&mut self) -> Option<&mut KeptPlane> {
        self.wanted.then_some(&mut self.test)
    }

    /// The luma of the reference.
    pub(super) fn reference(&self) -> &KeptPlane {
        &self.reference
    }

    /// The luma of the test.
    pub(super) fn test(&self) -> &KeptPlane {
        &self.test
    }

    /// Whether the luma of the reference is that of the frame at `position`.
    pub(super) fn is_of(&self, position: usize) -> bool {
        self.at == Some(position)
    }

    /// Swaps the luma of the reference with another plane, whose memory is used again.
    pub(super) fn swap_reference(&mut self, plane: &mut KeptPlane) {
        self.at = None;
        std::mem::swap(&mut self.reference, plane);
    }

    /// Swaps the luma of the test with another plane, whose memory is used again.
    pub(super) fn swap_test(&mut self, plane: &mut KeptPlane) {
        std::mem::swap(&mut self.test, plane);
    }
}
