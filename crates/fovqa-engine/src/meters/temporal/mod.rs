//! Keeps data of frames for the frames after them, and measures the change from one to the next.

mod history;

use std::collections::BTreeMap;

use fovqa_frame::{Guides, Mask, Motion, Plane};
use fovqa_metrics::temporal::{FrameBefore, KeptPlane, Picture, TimeInput};
use fovqa_metrics::{Image, Metric, MetricKind, Params, Rows};
use fovqa_plan::Plan;
use fovqa_results::{GuideSource, GuideSources};

use super::{Lumas, Pair};
use crate::events::Warnings;
use crate::load::{Fault, Side};
use history::{Extent, History, Kept};

/// The frames before the present one: of the reference, and of each test.
pub(super) struct Temporal {
    metrics: Vec<Metric>,
    params: Params,
    extent: Extent,
    reference: Reference,
    tests: BTreeMap<usize, Test>,
}

/// The reference.
struct Reference {
    history: History,
    carries: Carries,
    /// The values of the present reference, where they are the same for all tests.
    known: BTreeMap<Metric, Rows>,
}

/// A test.
struct Test {
    history: History,
    carries: Carries,
    guides: GuideSources,
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

    fn check(&mut self, side: &Side, first: bool, metrics: &[Metric]) -> Result<(), Fault> {
        let Guides { motion, depth } = &side.guides;
        let agree = |all: &mut Option<bool>, here: bool, what: &str| {
            if *all.get_or_insert(here) == here {
                Ok(())
            } else {
                Err(differ(here, side, what, metrics))
            }
        };
        if !first {
            agree(&mut self.motion, motion.is_some(), "motion vectors")?;
        }
        agree(&mut self.depth, depth.is_some(), "depth")
    }
}

/// The error that a frame has what earlier ones lack, or lacks what they have.
fn differ(here: bool, side: &Side, what: &str, metrics: &[Metric]) -> Fault {
    let file = &side.file;
    let message = if here {
        format!("{file} has {what}, but earlier frames have none")
    } else {
        format!("{file} has no {what}, but earlier frames have some")
    };
    let names: Vec<&str> = metrics.iter().map(|metric| metric.key()).collect();
    let names = names.join(" and ");
    let help = format!("render them for all frames, or leave {names} out of {{metrics}}");
    Fault { message, help }
}

/// The warning that metrics are measured without motion vectors.
fn no_motion(metrics: &[Metric]) -> String {
    let names: Vec<&str> = metrics.iter().map(|metric| metric.info().label).collect();
    let names = names.join(" and ");
    let are = if metrics.len() == 1 { "is" } else { "are" };
    format!("{names} {are} computed without motion vectors: all movement counts as a difference")
}

impl Temporal {
    /// Creates the meter; `None` if no metric is temporal.
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Option<Self> {
        let metrics = metrics.iter().copied().filter(|metric| metric.is(MetricKind::Temporal));
        let metrics: Vec<Metric> = metrics.collect();
        let needed = metrics.iter().map(|metric| plan.params.frames_needed(*metric)).max()?;
        let depth = plan.params.atd.depth_tolerance.is_some();
        let extent = Extent { frames: needed - 1, depth };
        let history = History::new(extent);
        let carries = Carries::default();
        Some(Self {
            metrics,
            params: (*plan.params).clone(),
            extent,
            reference: Reference { history, carries, known: BTreeMap::new() },
            tests: BTreeMap::new(),
        })
    }

    /// The number of frames before the present one that are needed.
    pub(super) fn reach(&self) -> usize {
        self.extent.frames
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
        self.reference.carries.check(reference, first, &self.metrics)?;
        let of = self.tests.entry(method).or_insert_with(|| Test::new(self.extent));
        of.carries.check(test, first, &self.metrics)
    }

    /// Keeps what later frames need of a reference that is about to be dropped.
    pub(super) fn leave(&mut self, reference: &Side, position: usize, lumas: &mut Lumas) {
        self.reference.known.clear();
        if lumas.is_of(position) {
            let history = &mut self.reference.history;
            let swap = |plane: &mut _| lumas.swap_reference(plane);
            history.push(position, &reference.guides, None, swap);
        }
    }

    /// Which motion and depth the metrics of a test used.
    pub(super) fn guides(&self, method: usize) -> GuideSources {
        self.tests.get(&method).map(|test| test.guides).unwrap_or_default()
    }

    /// Measures the change from the pairs before a pair. The luma of both images must be ready.
    /// Metrics without enough pairs before it have no rows. The present pair is kept for later ones.
    pub(super) fn measure(
        &mut self,
        pair: &Pair<'_>,
        lumas: &mut Lumas,
        rows: &mut Rows,
        warnings: &mut Warnings<'_>,
    ) {
        let mut is_measured = false;
        for metric in self.metrics.clone() {
            if let Some(found) = self.compare(metric, pair, lumas) {
                is_measured = true;
                for of in &found {
                    rows.extend(of);
                }
            }
        }
        if is_measured && self.guides(pair.method).motion == GuideSource::None {
            warnings.once_a_view("no motion", &no_motion(&self.metrics));
        }
        self.take_in(pair, lumas);
    }

    /// Keeps a pair for later ones. The luma of both images must be ready.
    pub(super) fn take_in(&mut self, pair: &Pair<'_>, lumas: &mut Lumas) {
        let test = self.tests.entry(pair.method).or_insert_with(|| Test::new(self.extent));
        let mask = pair.finite.cloned().map(|mut finite| {
            if let Some(mask) = pair.setup.mask() {
                finite.intersect(mask);
            }
            finite
        });
        let swap = |plane: &mut _| lumas.swap_test(plane);
        test.history.push(pair.position, &pair.test.guides, mask, swap);
    }

    /// The values of reference and test; `None` without the frames that the metric needs.
    fn compare(&mut self, metric: Metric, pair: &Pair<'_>, lumas: &Lumas) -> Option<[Rows; 2]> {
        let before = self.params.frames_needed(metric) - 1;
        let test = self.tests.entry(pair.method).or_insert_with(|| Test::new(self.extent));
        let reference = &mut self.reference;
        let reference_before = reference.history.before(pair.position, before)?;
        let test_before = test.history.before(pair.position, before)?;
        let depth = self.extent.depth;
        let shared = Guided::new(&pair.reference.guides, &reference_before, depth);
        let own = Guided::new(&pair.test.guides, &test_before, depth);
        test.guides = GuideSources {
            motion: source(own.has_motion(), shared.has_motion()),
            depth: source(own.has_depth(), shared.has_depth()),
        };
        // Which pixels count may depend on the pair, and so their mask is kept with the test.
        let view_mask = pair.setup.mask();
        let is_shared = pair.finite.is_none() && test_before.iter().all(|kept| kept.mask.is_none());
        let masks = test_before.iter().map(|kept| kept.mask.as_ref().or(view_mask));
        let masks: Vec<Option<&Mask>> = masks.collect();
        let of_reference = picture(Image::Reference, lumas.reference(), &reference_before);
        let of_test = picture(Image::Test, lumas.test(), &test_before);
        let params = &self.params;
        let follow = |guided: &Guided<'_>, pictures: &[Picture<'_>]| {
            let before = guided.before(&masks);
            let (motion, depth) = (guided.motion, guided.depth);
            let input =
                TimeInput { motion, depth, regions: pair.regions, before: &before, pictures };
            params.follow(metric, &input).unwrap_or_default()
        };
        let known = reference.known.get(&metric).cloned().filter(|_| is_shared);
        let is_own = own.has_motion() || own.has_depth();
        let (of_reference, of_test) = if is_own || known.is_some() {
            let guided = if is_own { own.or(&shared) } else { shared.clone() };
            let known = known.or_else(|| follow(&shared, &[of_reference]).pop());
            (known?, follow(&guided, &[of_test]).pop()?)
        } else {
            let mut both = follow(&shared, &[of_reference, of_test]);
            let of_test = both.pop()?;
            (both.pop()?, of_test)
        };
        if is_shared {
            reference.known.insert(metric, of_reference.clone());
        }
        Some([of_reference, of_test])
    }
}

impl Test {
    fn new(extent: Extent) -> Self {
        let (history, carries) = (History::new(extent), Carries::default());
        Self { history, carries, guides: GuideSources::default() }
    }
}

/// The luma of a picture over time.
fn picture<'a>(image: Image, luma: &'a KeptPlane, before: &[&'a Kept]) -> Picture<'a> {
    let lumas = std::iter::once(luma).chain(before.iter().map(|kept| &kept.luma));
    Picture { image, lumas: lumas.collect() }
}

/// The motion and depth of a sequence, in the present frame and in those before it.
#[derive(Clone)]
struct Guided<'a> {
    motion: Option<&'a Motion>,
    depth: Option<&'a Plane>,
    motion_before: Vec<&'a Kept>,
    depth_before: Vec<&'a Kept>,
}

impl<'a> Guided<'a> {
    fn new(guides: &'a Guides, before: &[&'a Kept], depth: bool) -> Self {
        let kept = before.iter().all(|kept| kept.depth().is_some());
        Self {
            motion: guides.motion.as_ref(),
            depth: guides.depth.as_ref().filter(|_| depth && kept),
            motion_before: before.to_vec(),
            depth_before: before.to_vec(),
        }
    }

    fn has_motion(&self) -> bool {
        self.motion.is_some()
    }

    fn has_depth(&self) -> bool {
        self.depth.is_some()
    }

    /// Takes from another sequence what this one lacks.
    fn or(self, other: &Self) -> Self {
        let (motion, motion_before) = match self.motion {
            Some(_) => (self.motion, self.motion_before),
            None => (other.motion, other.motion_before.clone()),
        };
        let (depth, depth_before) = match self.depth {
            Some(_) => (self.depth, self.depth_before),
            None => (other.depth, other.depth_before.clone()),
        };
        Self { motion, depth, motion_before, depth_before }
    }

    /// The frames before the present one. `masks` has the pixels of each that count.
    fn before(&self, masks: &[Option<&'a Mask>]) -> Vec<FrameBefore<'a>> {
        let kept = self.motion_before.iter().zip(&self.depth_before).zip(masks.iter().copied());
        let frame = |((motion, depth), mask): ((&&'a Kept, &&'a Kept), Option<&'a Mask>)| {
            let depth = depth.depth().filter(|_| self.has_depth());
            FrameBefore { motion: motion.motion(), depth, mask }
        };
        kept.map(frame).collect()
    }
}

fn source(own: bool, shared: bool) -> GuideSource {
    match (own, shared) {
        (true, _) => GuideSource::Test,
        (false, true) => GuideSource::Reference,
        (false, false) => GuideSource::None,
    }
}
