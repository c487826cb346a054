//! Measures of each image by itself. The luma of both images is stored for the temporal metrics.

use fovqa_metrics::temporal::KeptPlane;
use fovqa_metrics::{BlockRegions, Image, Metric, Params, PictureInput, Profiler, Rows};
use fovqa_plan::Plan;

use super::{Lumas, Pair};

/// Measures the profiles of the images of a pair.
pub(super) struct Profiles {
    profiler: Profiler,
    /// The profiles of the present reference, if they are the same for all tests.
    reference: Option<Rows>,
}

impl Profiles {
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Self {
        Self { profiler: Profiler::new(metrics, &plan.params), reference: None }
    }

    /// Drops the profiles of the reference.
    pub(super) fn leave(&mut self) {
        self.reference = None;
    }

    pub(super) fn measure(&mut self, pair: &Pair<'_>, lumas: &mut Lumas, rows: &mut Rows) {
        if self.profiler.is_idle() && !lumas.are_wanted() {
            return;
        }
        let known = self.reference.take().filter(|_| pair.finite.is_none());
        let plane = lumas.reference_to_fill(pair.position);
        let reference = known.unwrap_or_else(|| one(&self.profiler, pair, Image::Reference, plane));
        let mut both = one(&self.profiler, pair, Image::Test, lumas.test_to_fill());
        both.extend(&reference);
        both.derive();
        rows.extend(&both);
        if pair.finite.is_none() {
            self.reference = Some(reference);
        }
    }
}

/// Stores the luma of a pair.
pub(super) fn take_in(pair: &Pair<'_>, lumas: &mut Lumas) {
    let nothing = Profiler::new(&[], &Params::default());
    one(&nothing, pair, Image::Reference, lumas.reference_to_fill(pair.position));
    one(&nothing, pair, Image::Test, lumas.test_to_fill());
}

fn one(profiler: &Profiler, pair: &Pair<'_>, image: Image, plane: Option<&mut KeptPlane>) -> Rows {
    if profiler.is_idle() && plane.is_none() {
        return Rows::default();
    }
    let side = if image == Image::Reference { pair.reference } else { pair.test };
    let none = BlockRegions::default();
    let levels = profiler.haar_levels().unwrap_or(0);
    let blocks = pair.blocks_of(levels).unwrap_or(&none);
    let eccentricity = pair.setup.eccentricity(pair.gaze_px);
    let input = PictureInput {
        frame: &side.frame,
        tables: pair.tables,
        regions: pair.regions,
        blocks,
        seen: eccentricity.as_ref().zip(pair.setup.edges()),
        image,
    };
    profiler.measure(&input, plane)
}
