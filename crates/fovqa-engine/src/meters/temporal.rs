//! What is kept of a frame for the next one, and the differences between the two.

use std::collections::BTreeMap;

use fovqa_frame::{Guides, Mask, Plane};
use fovqa_metrics::Regions;
use fovqa_metrics::temporal::{AtdFrame, KeptPlane, Link, atd, differences};
use fovqa_results::{AtdGuides, GuideSource};

use crate::load::{Fault, Side};

/// The frames before the present one: of the reference, and of each test.
pub(crate) struct Temporal {
    params: atd::Params,
    reference: Reference,
    tests: BTreeMap<usize, Test>,
    /// The luma of the test at hand.
    test_luma: KeptPlane,
}

/// The reference, now and before.
#[derive(Default)]
struct Reference {
    now: KeptPlane,
    before: KeptPlane,
    /// Positions of the frames the two are of.
    at: Option<usize>,
    before_at: Option<usize>,
    depth: Depth,
    carries: Carries,
    /// Its differences, where they are the same for all tests.
    differences: Option<AtdFrame>,
}

/// A test, before.
#[derive(Default)]
struct Test {
    luma: KeptPlane,
    /// Position of the frame it is of.
    at: Option<usize>,
    depth: Depth,
    /// Where it and its reference were finite; `None`: everywhere.
    finite: Option<Mask>,
    carries: Carries,
    guides: AtdGuides,
}

/// Depth of the frame before.
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

/// What the frames of a sequence carry: all of them, or none. Its first frame needs no motion.
#[derive(Default)]
struct Carries {
    motion: Option<bool>,
    depth: Option<bool>,
}

impl Carries {
    /// Whether a frame would tell more.
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
        format!("{file} has {what}, and frames before it have none")
    } else {
        format!("{file} has no {what}, and frames before it have some")
    };
    let help = "render them for all frames, or leave atd out of {metrics}".to_owned();
    Err(Fault { message, help })
}

/// Which pixels of a pair count now, and counted in the frame before.
pub(crate) struct Counted<'a> {
    pub(crate) regions: &'a Regions<'a>,
    /// Where both are finite; `None`: everywhere.
    pub(crate) finite: Option<Mask>,
    /// The lens mask.
    pub(crate) mask: Option<&'a Mask>,
}

/// A pair and its place in the sequence.
pub(crate) struct Present<'a> {
    pub(crate) reference: &'a Side,
    pub(crate) test: &'a Side,
    pub(crate) method: usize,
    pub(crate) position: usize,
}

impl Temporal {
    pub(crate) fn new(params: atd::Params) -> Self {
        Self {
            params,
            reference: Reference::default(),
            tests: BTreeMap::new(),
            test_luma: KeptPlane::default(),
        }
    }

    /// Whether a pair tells what the frames of the reference carry; or those of its method's tests.
    pub(crate) fn lacks(&self, method: usize, first: bool) -> [bool; 2] {
        let test = self.tests.get(&method).is_none_or(|test| test.carries.lacks(first));
        [self.reference.carries.lacks(first), test]
    }

    /// Checks that frames carry what those before them did.
    pub(crate) fn check(&mut self, present: &Present<'_>, first: bool) -> Result<(), Fault> {
        self.reference.carries.check(present.reference, first)?;
        self.tests.entry(present.method).or_default().carries.check(present.test, first)
    }

    /// Where the reference's luma goes; `None` where it is there already.
    pub(crate) fn reference_luma(&mut self, position: usize) -> Option<&mut KeptPlane> {
        let reference = &mut self.reference;
        if reference.at == Some(position) {
            return None;
        }
        std::mem::swap(&mut reference.now, &mut reference.before);
        reference.before_at = reference.at.replace(position);
        reference.differences = None;
        Some(&mut reference.now)
    }

    /// Where the test's luma goes.
    pub(crate) fn test_luma(&mut self) -> &mut KeptPlane {
        &mut self.test_luma
    }

    /// Takes what the next frame needs of a reference that goes.
    pub(crate) fn leave(&mut self, reference: &Side, position: usize) {
        if self.params.depth_tolerance.is_some() {
            self.reference.depth.take(reference.guides.depth.as_ref(), position);
        }
    }

    /// What the differences of a test were taken along.
    pub(crate) fn guides(&self, method: usize) -> AtdGuides {
        self.tests.get(&method).map(|test| test.guides).unwrap_or_default()
    }

    /// The differences of a pair to the one before it, once both lumas are there; `None` where there is
    /// none before it. The present one is kept for the next.
    pub(crate) fn differences(
        &mut self,
        present: &Present<'_>,
        counted: Counted<'_>,
    ) -> Option<[AtdFrame; 2]> {
        let found = self.compare(present, &counted);
        self.keep(present, counted.finite);
        found
    }

    /// Keeps a pair for the next one, once both lumas are there.
    pub(crate) fn keep(&mut self, present: &Present<'_>, finite: Option<Mask>) {
        let test = self.tests.entry(present.method).or_default();
        std::mem::swap(&mut test.luma, &mut self.test_luma);
        test.at = Some(present.position);
        test.finite = finite;
        if self.params.depth_tolerance.is_some() {
            test.depth.take(present.test.guides.depth.as_ref(), present.position);
        }
    }

    fn compare(&mut self, present: &Present<'_>, counted: &Counted<'_>) -> Option<[AtdFrame; 2]> {
        let before = present.position.checked_sub(1)?;
        let test = self.tests.entry(present.method).or_default();
        let reference = &mut self.reference;
        if test.at != Some(before) || reference.before_at != Some(before) {
            return None;
        }
        let mask_before = match (&test.finite, counted.mask) {
            (Some(finite), Some(mask)) => {
                let mut both = finite.clone();
                both.intersect(mask);
                Some(both)
            }
            (Some(finite), None) => Some(finite.clone()),
            (None, _) => None,
        };
        let mask_before = mask_before.as_ref().or(counted.mask);
        let wants_depth = self.params.depth_tolerance.is_some();
        let depth = |side: &'_ Side, kept: &'_ Depth| -> bool {
            wants_depth && side.guides.depth.is_some() && kept.of(before).is_some()
        };
        let own_depth = depth(present.test, &test.depth);
        let shared_depth = depth(present.reference, &reference.depth);
        let own_motion = present.test.guides.motion.is_some();
        test.guides = AtdGuides {
            motion: source(own_motion, present.reference.guides.motion.is_some()),
            depth: source(own_depth, shared_depth),
        };
        let reference_depth =
            present.reference.guides.depth.as_ref().zip(reference.depth.of(before));
        let reference_depth = reference_depth.filter(|_| shared_depth);
        let link = Link {
            motion: present.reference.guides.motion.as_ref(),
            depth: reference_depth,
            regions: counted.regions,
            mask_before,
        };
        let of_test = (&self.test_luma, &test.luma);
        let of_reference = (&reference.now, &reference.before);
        let params = &self.params;
        // What is not finite is so in a pair: the reference's differences are not those of the next.
        let shared = counted.finite.is_none() && test.finite.is_none();
        let known = reference.differences.clone().filter(|_| shared);
        let (of_reference, of_test) = if own_motion || own_depth {
            let test_depth = present.test.guides.depth.as_ref().zip(test.depth.of(before));
            let own = Link {
                motion: present.test.guides.motion.as_ref().or(link.motion),
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
