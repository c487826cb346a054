//! Meters measure the frames of a view. One meter serves all metrics that share a pass over the
//! pixels.
//!
//! Each meter states what its metrics need, receives pairs in order, and returns rows. A meter for
//! temporal metrics has a *lead-in*: the pairs before the measured one that it must have read.

mod fidelity;
mod lumas;
mod luminance;
mod own;
mod profiles;
mod temporal;

use std::collections::BTreeSet;
use std::ops::Range;

use fovqa_frame::{Frame, Mask, SignalTables};
use fovqa_metrics::{BlockRegions, Map, Metric, Regions, Rows, Scored};
use fovqa_plan::{Plan, Settings};
use fovqa_results::{FvvdpViewing, GuideSources};

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

/// One group of metrics that share a pass over the pixels.
enum Meter {
    /// Metrics that compare the signals of test and reference in one common pass.
    Fidelity(Fidelity),
    /// Metrics that also compare them, each in a pass of its own.
    Own(Own),
    /// Metrics based on the luminance that the display shows.
    Luminance(Box<LuminanceMeter>),
    /// Measures of each image by itself.
    Profiles(Profiles),
    /// The change from earlier images to the present one.
    Temporal(Box<Temporal>),
}

/// A pair of frames to be measured.
pub(crate) struct Pair<'a> {
    /// Index of the frame in the view.
    pub(crate) frame: usize,
    /// Position of the frame in the sequence.
    pub(crate) position: usize,
    /// Index of the method.
    pub(crate) method: usize,
    /// Number of tests of the frame.
    pub(crate) tests: usize,
    pub(crate) reference: &'a Side,
    pub(crate) test: &'a Side,
    pub(crate) gaze_px: [f64; 2],
    pub(crate) tables: &'a SignalTables,
    pub(crate) setup: &'a Setup<'a>,
    pub(crate) retina: &'a Retina,
    /// The pixels that count, and the band of each.
    pub(crate) regions: &'a Regions<'a>,
    /// The regions of blocks, by the number of block levels that a metric needs.
    pub(crate) blocks: &'a Blocks<'a>,
    /// Where both images are finite; `None` means everywhere.
    pub(crate) finite: Option<&'a Mask>,
    pub(crate) load: &'a LoadPair<'a>,
    /// Whether maps are made of it.
    pub(crate) maps: bool,
}

/// The progress through the pairs of a method.
struct Sequence {
    /// Index of the method.
    method: usize,
    /// Number of pairs that are finished.
    done: usize,
    /// The index after the last pair that is read.
    end: usize,
    /// Whether any of the pairs are to be scored.
    goes_on: bool,
}

impl Meter {
    /// Continues a method's pairs, of which some are finished. Returns those of them that the meter
    /// must read again.
    fn lead_in(&mut self, sequence: &Sequence) -> Range<usize> {
        let &Sequence { method, done, end, goes_on } = sequence;
        match self {
            Meter::Luminance(light) => light.go_on(method, done, end),
            Meter::Temporal(of) if goes_on => done.saturating_sub(of.reach())..done,
            Meter::Temporal(_) | Meter::Fidelity(_) | Meter::Own(_) | Meter::Profiles(_) => {
                done..done
            }
        }
    }
}

impl Pair<'_> {
    /// The bands for `levels` levels of blocks; `None` for zero levels.
    fn blocks_of(&self, levels: usize) -> Option<&BlockRegions<'_>> {
        let blocks = self.blocks.get(&levels);
        debug_assert!(levels == 0 || blocks.is_some(), "the blocks of every metric are made");
        blocks
    }
}

/// The measurements of a pair.
#[derive(Default)]
pub(crate) struct Measured {
    pub(crate) rows: Rows,
    pub(crate) maps: Vec<Map>,
}

impl Measured {
    fn add(&mut self, Scored { rows, maps, warnings: said }: Scored, warnings: &mut Warnings<'_>) {
        self.rows.extend(&rows);
        self.maps.extend(maps);
        for warning in said {
            warnings.once_a_view(warning, warning);
        }
    }
}

/// All meters of a view.
pub(crate) struct Meters {
    meters: Vec<Meter>,
    lumas: Lumas,
}

impl Meters {
    /// Creates the meters for some metrics.
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

    /// Continues without the metrics that do not fit the frames.
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

    /// The pairs before the first pair to be scored that must be read. For each method, these are
    /// the pairs in the lead-in of a meter.
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

    /// Whether a pair would tell what the frames of the reference carry (first value) and what the
    /// tests of its method carry (second value), which is not known yet.
    pub(crate) fn lacks(&self, method: usize, first: bool) -> [bool; 2] {
        self.temporal().map_or([false; 2], |temporal| temporal.lacks(method, first))
    }

    /// Checks that a pair carries the same motion and depth as the pairs before it.
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

    /// Keeps what the next frame needs of a reference that is about to be dropped.
    pub(crate) fn leave(&mut self, reference: &Side, position: usize) {
        for meter in &mut self.meters {
            match meter {
                Meter::Profiles(profiles) => profiles.leave(),
                Meter::Temporal(temporal) => {
                    temporal.leave(reference, position, &mut self.lumas);
                }
                Meter::Fidelity(_) | Meter::Own(_) | Meter::Luminance(_) => {}
            }
        }
    }

    /// Reports the warnings that a reference brings before anything is measured.
    pub(crate) fn foresee(&self, reference: &Frame, warnings: &mut Warnings<'_>) {
        if let Some(light) = self.light() {
            light.foresee(reference, warnings);
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
                Meter::Fidelity(fidelity) => measured.add(fidelity.measure(pair)?, warnings),
                Meter::Own(own) => {
                    for scored in own.measure(pair, true) {
                        measured.add(scored?, warnings);
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

    /// Processes a pair without measuring it, for the pairs after it.
    pub(crate) fn take_in(&mut self, pair: &Pair<'_>) -> Result<(), Fault> {
        for meter in &mut self.meters {
            match meter {
                // Whether too many pixels are left out depends on this pair alone, but later pairs
                // cannot be scored without it either.
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

    /// Which motion and depth the temporal metrics of a method used.
    pub(crate) fn guide_sources(&self, method: usize) -> GuideSources {
        self.temporal().map(|temporal| temporal.guides(method)).unwrap_or_default()
    }

    /// The viewing conditions of FovVideoVDP for the sequence of a method, if the metric is
    /// requested.
    pub(crate) fn fvvdp(&self, method: usize, setup: &Setup<'_>) -> Option<FvvdpViewing> {
        self.light()?.sight(method, setup.fvvdp()?)
    }

    /// Why FovVideoVDP has no value for the sequence of a method, as far as the sequence was read
    /// here.
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
