//! What runs over the frames of a view: one meter for the metrics that share a pass over the pixels.
//!
//! Each meter says what its metrics need, takes pairs in by their order, and gives rows. A meter of what is
//! measured over time has a *lead-in*: pairs before the one it measures that it has to have seen.

mod fidelity;
mod lumas;
mod luminance;
mod own;
mod profiles;
mod temporal;

use std::collections::BTreeSet;
use std::ops::Range;

use fovqa_frame::{Mask, SignalTables};
use fovqa_metrics::{BlockRegions, Map, Metric, Regions, Rows, Scored};
use fovqa_plan::{Plan, Settings};
use fovqa_results::{AtdGuides, FvvdpViewing};

use crate::events::Warnings;
use crate::found::FoundView;
use crate::load::{Fault, Side};
use crate::retina::{Blocks, Retina};
use crate::setup::Setup;
use crate::work::Work;
use fidelity::Fidelity;
use lumas::Lumas;
pub(crate) use luminance::LoadPair;
use luminance::LuminanceMeter;
use own::Own;
use profiles::Profiles;
use temporal::Temporal;

/// A meter.
enum Meter {
    /// What compares the signals of test and reference: one fused pass.
    Fidelity(Fidelity),
    /// What compares them too, each metric in a pass of its own.
    Own(Own),
    /// What is of the light that the display shows.
    Luminance(Box<LuminanceMeter>),
    /// What is measured of each picture by itself.
    Profiles(Profiles),
    /// What is measured of each picture and the one before it.
    Temporal(Box<Temporal>),
}

/// A pair of frames to be measured.
pub(crate) struct Pair<'a> {
    /// Index of the frame in the view.
    pub(crate) frame: usize,
    /// Its position in the sequence.
    pub(crate) position: usize,
    /// Index of the method.
    pub(crate) method: usize,
    /// How many tests the frame has.
    pub(crate) tests: usize,
    pub(crate) reference: &'a Side,
    pub(crate) test: &'a Side,
    pub(crate) gaze_px: [f64; 2],
    pub(crate) tables: &'a SignalTables,
    pub(crate) setup: &'a Setup<'a>,
    pub(crate) retina: &'a Retina,
    /// Which pixels count, and into which band.
    pub(crate) regions: &'a Regions<'a>,
    /// The same of blocks, by how many levels of them a metric needs.
    pub(crate) blocks: &'a Blocks<'a>,
    /// Where both pictures are finite; `None`: everywhere.
    pub(crate) finite: Option<&'a Mask>,
    pub(crate) load: &'a LoadPair<'a>,
}

/// How far the pairs of a method are through.
struct Sequence {
    /// Index of the method.
    method: usize,
    /// How many are.
    done: usize,
    /// The place behind the last that comes.
    end: usize,
    /// Whether some are to be scored.
    goes_on: bool,
}

impl Meter {
    /// Goes on with a method's pairs where some are through: those of them that it has to have seen.
    fn lead_in(&mut self, sequence: &Sequence) -> Range<usize> {
        let &Sequence { method, done, end, goes_on } = sequence;
        match self {
            Meter::Luminance(light) => light.go_on(method, done, end),
            Meter::Temporal(_) if goes_on => done.saturating_sub(1)..done,
            Meter::Temporal(_) | Meter::Fidelity(_) | Meter::Own(_) | Meter::Profiles(_) => {
                done..done
            }
        }
    }
}

impl Pair<'_> {
    /// Bands of so many levels of blocks; `None` of no level.
    fn blocks_of(&self, levels: usize) -> Option<&BlockRegions<'_>> {
        let blocks = self.blocks.get(&levels);
        debug_assert!(levels == 0 || blocks.is_some(), "the blocks of every metric are made");
        blocks
    }
}

/// What was measured of a pair.
#[derive(Default)]
pub(crate) struct Measured {
    pub(crate) rows: Rows,
    pub(crate) maps: Vec<Map>,
}

impl Measured {
    fn add(&mut self, Scored { rows, maps }: Scored) {
        self.rows.extend(&rows);
        self.maps.extend(maps);
    }
}

/// All meters of a view.
pub(crate) struct Meters {
    meters: Vec<Meter>,
    lumas: Lumas,
}

impl Meters {
    /// The meters of some metrics.
    pub(crate) fn new(
        plan: &Plan,
        settings: &Settings,
        metrics: &[Metric],
        view: &FoundView,
        fps: Option<f64>,
    ) -> Self {
        let temporal = Temporal::new(plan, metrics);
        let lumas = Lumas::new(temporal.is_some());
        let meters = [
            Some(Meter::Fidelity(Fidelity::new(plan, metrics))),
            Some(Meter::Own(Own::new(plan, metrics))),
            LuminanceMeter::new(plan, settings, metrics, view, fps)
                .map(|light| Meter::Luminance(light.into())),
            Some(Meter::Profiles(Profiles::new(plan, metrics))),
            temporal.map(|temporal| Meter::Temporal(temporal.into())),
        ];
        Self { meters: meters.into_iter().flatten().collect(), lumas }
    }

    /// Goes on without the metrics that do not fit the frames.
    pub(crate) fn settle(&mut self, plan: &Plan, metrics: &[Metric]) {
        for meter in &mut self.meters {
            match meter {
                Meter::Fidelity(fidelity) => *fidelity = Fidelity::new(plan, metrics),
                Meter::Own(own) => *own = Own::new(plan, metrics),
                Meter::Profiles(profiles) => *profiles = Profiles::new(plan, metrics),
                Meter::Luminance(_) | Meter::Temporal(_) => {}
            }
        }
    }

    /// The pairs before the first that is to be scored that have to be taken in: those of each method
    /// that a meter's lead-in reaches back to.
    pub(crate) fn lead_in(&mut self, work: &Work<'_>) -> BTreeSet<usize> {
        let mut pairs = BTreeSet::new();
        for method in work.methods() {
            let before = work.before(work.first(), method);
            let end = work.before(work.end(), method).len();
            let sequence =
                Sequence { method, done: before.len(), end, goes_on: work.is_of(method) };
            for meter in &mut self.meters {
                pairs.extend(&before[meter.lead_in(&sequence)]);
            }
        }
        pairs
    }

    /// Whether a pair tells what the frames of the reference carry; or those of its method's tests.
    pub(crate) fn lacks(&self, method: usize, first: bool) -> [bool; 2] {
        self.temporal().map_or([false; 2], |temporal| temporal.lacks(method, first))
    }

    /// Checks that a pair carries what those before it did.
    pub(crate) fn check(
        &mut self,
        method: usize,
        sides: [&Side; 2],
        first: bool,
    ) -> Result<(), Fault> {
        let temporal = self.meters.iter_mut().find_map(|meter| match meter {
            Meter::Temporal(temporal) => Some(temporal),
            _ => None,
        });
        temporal.map_or(Ok(()), |temporal| temporal.check(method, sides, first))
    }

    /// Takes what the next frame needs of a reference that goes.
    pub(crate) fn leave(&mut self, reference: &Side, position: usize) {
        for meter in &mut self.meters {
            match meter {
                Meter::Profiles(profiles) => profiles.leave(),
                Meter::Temporal(temporal) => temporal.leave(reference, position),
                Meter::Fidelity(_) | Meter::Own(_) | Meter::Luminance(_) => {}
            }
        }
    }

    /// Measures a pair.
    pub(crate) fn measure(
        &mut self,
        pair: &Pair<'_>,
        warnings: &mut Warnings<'_>,
    ) -> Result<Measured, Fault> {
        let mut measured = Measured::default();
        for meter in &mut self.meters {
            match meter {
                Meter::Fidelity(fidelity) => measured.add(fidelity.measure(pair)?),
                Meter::Own(own) => {
                    for scored in own.measure(pair, true) {
                        measured.add(scored?);
                    }
                }
                Meter::Luminance(light) => light.measure(pair, &mut measured, warnings),
                Meter::Profiles(profiles) => {
                    profiles.measure(pair, &mut self.lumas, &mut measured.rows);
                }
                Meter::Temporal(temporal) => {
                    temporal.measure(pair, &mut self.lumas, &mut measured.rows, warnings);
                }
            }
        }
        Ok(measured)
    }

    /// Takes a pair in without measuring it: for those after it.
    pub(crate) fn take_in(&mut self, pair: &Pair<'_>) -> Result<(), Fault> {
        for meter in &mut self.meters {
            match meter {
                // Whether too much is left out is a matter of this pair alone, and costs those after
                // it too.
                Meter::Fidelity(fidelity) if pair.finite.is_some() => fidelity.check(pair)?,
                Meter::Own(own) if pair.finite.is_some() => {
                    own.measure(pair, false).try_for_each(|scored| scored.map(|_| ()))?;
                }
                Meter::Fidelity(_) | Meter::Own(_) => {}
                Meter::Luminance(light) => light.take_in(pair),
                Meter::Profiles(_) => profiles::take_in(pair, &mut self.lumas),
                Meter::Temporal(temporal) => temporal.take_in(pair, &mut self.lumas),
            }
        }
        Ok(())
    }

    /// What the differences over time of a method were taken along.
    pub(crate) fn atd_guides(&self, method: usize) -> AtdGuides {
        self.temporal().map(|temporal| temporal.guides(method)).unwrap_or_default()
    }

    /// How FovVideoVDP sees the sequence of a method, where it is asked for.
    pub(crate) fn fvvdp(&self, method: usize, setup: &Setup<'_>) -> Option<FvvdpViewing> {
        self.light()?.sight(method, setup.fvvdp()?)
    }

    /// Why FovVideoVDP has no value for the sequence of a method, as far as it goes here.
    pub(crate) fn missing(
        &self,
        method: usize,
        number: impl Fn(usize) -> String,
    ) -> Option<String> {
        self.light()?.missing(method, number)
    }

    fn light(&self) -> Option<&LuminanceMeter> {
        self.meters.iter().find_map(|meter| match meter {
            Meter::Luminance(light) => Some(&**light),
            _ => None,
        })
    }

    fn temporal(&self) -> Option<&Temporal> {
        self.meters.iter().find_map(|meter| match meter {
            Meter::Temporal(temporal) => Some(&**temporal),
            _ => None,
        })
    }
}
