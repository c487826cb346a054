//! Keeps data of a frame for the next one, and measures the differences between the two.

use std::collections::BTreeMap;

use fovqa_frame::{Guides, Mask, Plane};
use fovqa_metrics::temporal::{AtdFrame, KeptPlane, Link, atd, differences};
use fovqa_metrics::{Image, Metric, Rows};
use fovqa_plan::Plan;
use fovqa_results::{AtdGuides, GuideSource};

use super::{Lumas, Pair};
use crate::events::Warnings;
use crate::load::{Fault, Side};

/// The warning if temporal differences are measured without motion vectors.
const NO_MOTION: &str =
    "ATD is computed without motion vectors: all movement counts as a difference";

/// The previous frames: of the reference, and of each test.
pub(super) struct Temporal {
    params: atd::Params,
    reference: Reference,
    tests: BTreeMap<usize, Test>,
}

/// The previous frame of the reference.
#[derive(Default)]
struct Reference {
    depth: Depth,
    carries: Carries,
    /// The differences of the reference, if they are the same for all tests.
    differences: Option<AtdFrame>,
}

/// The previous frame of a test.
#[derive(Default)]
struct Test {
    luma: KeptPlane,
    /// Position of the frame that the luma belongs to.
    at: Option<usize>,
    depth: Depth,
    /// Where the test and its reference were finite; `None` means everywhere.
    finite: Option<Mask>,
    carries: Carries,
    guides: AtdGuides,
}

/// Depth of the previous frame.
#[derive(Default)]
struct Depth {
    plane: KeptPlane,
    at: Option<usize>,
}

impl Depth {
    fn take(&mut self, depth: Option<&Plane>, position: usize) {
        if let Some(depth) = depth {
            self.plane.take(depth);
            self.at = Some(position);
        }
    }

    fn of(&self, position: usize) -> Option<&KeptPlane> {
        (self.at == Some(position)).then_some(&self.plane)
    }
}

/// What the frames of a sequence carry. Either all frames carry it or none does. The first frame
/// needs no motion.
#[derive(Default)]
struct Carries {
    motion: Option<bool>,
    depth: Option<bool>,
}

impl Carries {
    /// Whether a frame would tell something that is not known yet.
    fn lacks(&self, first: bool) -> bool {
        self.depth.is_none() || (!first && self.motion.is_none())
    }

    fn check(&mut self, side: &Side, first: bool) -> Result<(), Fault> {
        let Guides { motion, depth } = &side.guides;
        if !first {
            agree(&mut self.motion, motion.is_some(), &side.file, "motion vectors")?;
        }
        agree(&mut self.depth, depth.is_some(), &side.file, "depth")
    }
}

fn agree(all: &mut Option<bool>, here: bool, file: &str, what: &str) -> Result<(), Fault> {
    if *all.get_or_insert(here) == here {
        return Ok(());
    }
    let message = if here {
        format!("{file} has {what}, but earlier frames have none")
    } else {
        format!("{file} has no {what}, but earlier frames have some")
    };
    let help = "render them for all frames, or leave atd out of {metrics}".to_owned();
    Err(Fault { message, help })
}

impl Temporal {
    /// Creates the meter; `None` if no metric is temporal.
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Option<Self> {
        metrics.contains(&Metric::Atd).then(|| Self {
            params: plan.params.atd,
            reference: Reference::default(),
            tests: BTreeMap::new(),
        })
    }

    /// Whether a pair would tell what the frames of the reference carry (first value) and what the
    /// tests of its method carry (second value), which is not known yet.
    pub(super) fn lacks(&self, method: usize, first: bool) -> [bool; 2] {
        let test = self.tests.get(&method).is_none_or(|test| test.carries.lacks(first));
        [self.reference.carries.lacks(first), test]
    }

    /// Checks that the reference and the test of a method carry the same as those before them.
    pub(super) fn check(
        &mut self,
        method: usize,
        [reference, test]: [&Side; 2],
        first: bool,
    ) -> Result<(), Fault> {
        self.reference.carries.check(reference, first)?;
        self.tests.entry(method).or_default().carries.check(test, first)
    }

    /// Keeps what the next frame needs of a reference that is about to be dropped.
    pub(super) fn leave(&mut self, reference: &Side, position: usize) {
        self.reference.differences = None;
        if self.params.depth_tolerance.is_some() {
            self.reference.depth.take(reference.guides.depth.as_ref(), position);
        }
    }

    /// Which motion and depth the differences of a test used.
    pub(super) fn guides(&self, method: usize) -> AtdGuides {
        self.tests.get(&method).map(|test| test.guides).unwrap_or_default()
    }

    /// Measures the differences between a pair and the one before it. The luma of both images must
    /// be ready. The result is empty if there is no pair before it. The present pair is kept for
    /// the next one.
    pub(super) fn measure(
        &mut self,
        pair: &Pair<'_>,
        lumas: &mut Lumas,
        rows: &mut Rows,
        warnings: &mut Warnings<'_>,
    ) {
        if let Some([of_reference, of_test]) = self.compare(pair, lumas) {
            if self.guides(pair.method).motion == GuideSource::None {
                warnings.once_a_view("no motion", NO_MOTION);
            }
            of_reference.rows(Image::Reference, rows);
            of_test.rows(Image::Test, rows);
        }
        self.take_in(pair, lumas);
    }

    /// Keeps a pair for the next one. The luma of both images must be ready.
    pub(super) fn take_in(&mut self, pair: &Pair<'_>, lumas: &mut Lumas) {
        let test = self.tests.entry(pair.method).or_default();
        lumas.swap_test(&mut test.luma);
        test.at = Some(pair.position);
        test.finite = pair.finite.cloned();
        if self.params.depth_tolerance.is_some() {
            test.depth.take(pair.test.guides.depth.as_ref(), pair.position);
        }
    }

    fn compare(&mut self, pair: &Pair<'_>, lumas: &Lumas) -> Option<[AtdFrame; 2]> {
        let before = pair.position.checked_sub(1)?;
        let test = self.tests.entry(pair.method).or_default();
        let reference = &mut self.reference;
        let of_reference = lumas.references(before).filter(|_| test.at == Some(before))?;
        let mask = pair.setup.mask();
        let mask_before = match (&test.finite, mask) {
            (Some(finite), Some(mask)) => {
                let mut both = finite.clone();
                both.intersect(mask);
                Some(both)
            }
            (Some(finite), None) => Some(finite.clone()),
            (None, _) => None,
        };
        let mask_before = mask_before.as_ref().or(mask);
        let wants_depth = self.params.depth_tolerance.is_some();
        let depth = |side: &'_ Side, kept: &'_ Depth| -> bool {
            wants_depth && side.guides.depth.is_some() && kept.of(before).is_some()
        };
        let own_depth = depth(pair.test, &test.depth);
        let shared_depth = depth(pair.reference, &reference.depth);
        let own_motion = pair.test.guides.motion.is_some();
        test.guides = AtdGuides {
            motion: source(own_motion, pair.reference.guides.motion.is_some()),
            depth: source(own_depth, shared_depth),
        };
        let reference_depth = pair.reference.guides.depth.as_ref().zip(reference.depth.of(before));
        let reference_depth = reference_depth.filter(|_| shared_depth);
        let link = Link {
            motion: pair.reference.guides.motion.as_ref(),
            depth: reference_depth,
            regions: pair.regions,
            mask_before,
        };
        let of_test = (lumas.test(), &test.luma);
        let params = &self.params;
        // Which pixels are finite depends on the pair, so the differences of the reference cannot
        // be shared between tests.
        let shared = pair.finite.is_none() && test.finite.is_none();
        let known = reference.differences.clone().filter(|_| shared);
        let (of_reference, of_test) = if own_motion || own_depth {
            let test_depth = pair.test.guides.depth.as_ref().zip(test.depth.of(before));
            let own = Link {
                motion: pair.test.guides.motion.as_ref().or(link.motion),
                depth: if own_depth { test_depth } else { reference_depth },
                ..link
            };
            let known = known.or_else(|| differences(&link, &[of_reference], params).pop());
            (known, differences(&own, &[of_test], params).pop())
        } else if known.is_some() {
            (known, differences(&link, &[of_test], params).pop())
        } else {
            let mut both = differences(&link, &[of_reference, of_test], params);
            let of_test = both.pop();
            (both.pop(), of_test)
        };
        if shared {
            reference.differences.clone_from(&of_reference);
        }
        Some([of_reference?, of_test?])
    }
}

fn source(own: bool, shared: bool) -> GuideSource {
    match (own, shared) {
        (true, _) => GuideSource::Test,
        (false, true) => GuideSource::Reference,
        (false, false) => GuideSource::None,
    }
}
