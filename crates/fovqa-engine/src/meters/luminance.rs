//! Metrics based on the luminance that the display shows: FovVideoVDP and PU-PSNR.

mod sequence;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use fovqa_frame::{Frame, LuminanceTables};
use fovqa_metrics::fvvdp::{
    DifferenceMap, Fvvdp, FvvdpFrame, FvvdpReference, FvvdpRegions, Grid, MapContext, Params,
    Photometry, Stream,
};
use fovqa_metrics::{Map, Metric, pu_psnr};
use fovqa_plan::{Plan, Settings};
use fovqa_results::FvvdpViewing;

use super::{Measured, Pair};
use crate::events::Warnings;
use crate::found::FoundView;
use crate::load::Fault;
use crate::timing::timings;
use sequence::{Missing, Sequence, State};

/// The warning if linear files are shown in cd/m² and none of their values is above 1.
const CANDELA: &str = "no pixel of the reference is brighter than 1 cd/m²: linear values are read as cd/m² on this display; \
     if a value of 1 stands for white or for another luminance, give that luminance with fvvdp.cd_m2_per_unit";

/// Keeps the luminance of a view's frames as long as it is needed.
pub(super) struct LuminanceMeter {
    params: Params,
    photometry: Photometry,
    tables: LuminanceTables,
    pu_psnr: bool,
    /// Index of the present frame, and the luminance of its reference.
    reference: Option<(usize, Arc<Grid>)>,
    /// Sequences of FovVideoVDP by the index of their method; empty if the metric is not requested.
    sequences: BTreeMap<usize, Sequence>,
    /// The most recently processed reference, for the other tests of the same frame.
    prepared: Option<(Seen, FvvdpReference)>,
}

/// The frames that a processed reference is made from, and the gaze.
#[derive(Debug, PartialEq)]
struct Seen(Vec<usize>, [u64; 2]);

/// Loads the reference and the test for another frame of the view (first argument) and a method
/// (second argument).
pub(crate) type LoadPair<'a> = dyn Fn(usize, usize) -> Result<[Frame; 2], Fault> + 'a;

impl LuminanceMeter {
    /// Creates the meter; `None` if no metric is based on luminance.
    pub(super) fn new(
        plan: &Plan,
        settings: &Settings,
        metrics: &[Metric],
        view: &FoundView,
        fps: Option<f64>,
    ) -> Option<Self> {
        if !metrics.iter().any(|metric| metric.info().needs.luminance) {
            return None;
        }
        let params = plan.params.fvvdp;
        let photometry = Photometry::new(settings.photometry()?);
        // The timing of the sequences was already checked when their frames were found.
        let timings = timings(view, fps, &params).unwrap_or_default().into_iter();
        let sequences = timings.map(|(method, timing)| (method, Sequence::new(timing)));
        let wants_fvvdp = metrics.contains(&Metric::Fvvdp);
        Some(Self {
            params,
            photometry,
            tables: photometry.tables(settings.signal, &params),
            pu_psnr: metrics.contains(&Metric::PuPsnr),
            reference: None,
            sequences: sequences.filter(|_| wants_fvvdp).collect(),
            prepared: None,
        })
    }

    /// Continues a method's sequence of which `done` frames are finished, up to `end`. Returns
    /// those of the finished frames that must be read again, without being scored.
    pub(super) fn go_on(&mut self, method: usize, done: usize, end: usize) -> Range<usize> {
        let sequence = self.sequences.get_mut(&method);
        sequence.map_or(done..done, |sequence| sequence.go_on(done, end))
    }

    /// Adds a pair to its sequence without measuring it.
    pub(super) fn take_in(&mut self, pair: &Pair<'_>) {
        if self.sequences.contains_key(&pair.method) && pair.setup.fvvdp().is_some() {
            let reference = self.luminance_of_reference(pair.frame, &pair.reference.frame);
            self.step(pair, &reference, &self.luminance(&pair.test.frame));
        }
    }

    /// Whether pixel values are read as cd/m² by default and none is brighter than 1. The scene is
    /// then most likely in other units.
    fn is_dim(&self, reference: &Frame) -> bool {
        let unsaid = self.params.cd_m2_per_unit.is_none() && self.tables.is_absolute(reference);
        unsaid && {
            let brightest = self.tables.luminance(reference).brightest();
            f64::from(brightest) - self.photometry.black_cd_m2() <= 1.0 + 1e-6
        }
    }

    fn luminance_of_reference(&mut self, index: usize, frame: &Frame) -> Arc<Grid> {
        match &self.reference {
            Some((known, luminance)) if *known == index => Arc::clone(luminance),
            _ => {
                let luminance = self.luminance(frame);
                self.reference = Some((index, Arc::clone(&luminance)));
                luminance
            }
        }
    }

    fn luminance(&self, frame: &Frame) -> Arc<Grid> {
        Arc::new(Grid::luminance(frame, &self.tables))
    }

    /// Warns if a reference seems to be in other units than the display.
    pub(super) fn foresee(&self, reference: &Frame, warnings: &mut Warnings<'_>) {
        if self.is_dim(reference) {
            warnings.once_a_view("candela", CANDELA);
        }
    }

    /// Measures a pair. The frames of a sequence must come in order; a missing frame ends the
    /// sequence.
    pub(super) fn measure(
        &mut self,
        pair: &Pair<'_>,
        measured: &mut Measured,
        warnings: &mut Warnings<'_>,
    ) {
        self.foresee(&pair.reference.frame, warnings);
        let (reference, test) = (&pair.reference.frame, &pair.test.frame);
        if self.pu_psnr {
            pu_psnr::rows(reference, test, &self.tables, pair.regions, &mut measured.rows);
        }
        let Some((metric, regions)) = pair.setup.fvvdp().zip(pair.retina.fvvdp.as_ref()) else {
            return;
        };
        let reference = self.luminance_of_reference(pair.frame, reference);
        if self.step(pair, &reference, &self.luminance(test)) {
            let (frame, map) = self.score(pair, metric, regions);
            frame.rows(pair.setup.bands(), &mut measured.rows);
            measured.maps.extend(map);
        }
    }

    /// Adds a frame to its sequence. Returns whether the sequence continues.
    fn step(&mut self, pair: &Pair<'_>, reference: &Arc<Grid>, test: &Arc<Grid>) -> bool {
        let &Pair { frame, method, load, .. } = pair;
        let Some(mut sequence) = self.sequences.remove(&method) else { return false };
        let place = sequence.timing.frames.binary_search(&frame).unwrap_or(usize::MAX);
        match &mut sequence.state {
            State::New if place == sequence.start => {
                sequence.state = self.begin(&sequence, method, reference, test, load);
            }
            State::Going { reference: before, test: test_before, done } if *done == place => {
                before.push(place, Arc::clone(reference));
                test_before.push(place, Arc::clone(test));
                *done += 1;
            }
            State::New | State::Going { .. } => {
                let next = sequence.timing.frames[sequence.done()];
                sequence.state = State::Broken(Missing::Frame(next));
            }
            State::Broken(_) => {}
        }
        let goes_on = matches!(sequence.state, State::Going { .. });
        self.sequences.insert(method, sequence);
        goes_on
    }

    fn begin(
        &self,
        Sequence { timing, start, .. }: &Sequence,
        method: usize,
        reference: &Arc<Grid>,
        test: &Arc<Grid>,
        load: &LoadPair<'_>,
    ) -> State {
        let time = match &timing.time {
            Ok(time) => time,
            Err(gap) => return State::Broken(Missing::Said(gap.to_string())),
        };
        if *start > 0 {
            let begun = |luminance| Stream::begin_at(time, *start, luminance);
            return State::Going {
                reference: begun(reference),
                test: begun(test),
                done: start + 1,
            };
        }
        let mut before = [BTreeMap::new(), BTreeMap::new()];
        for frame in time.before_first() {
            let pair = match load(timing.frames[frame], method) {
                Ok(pair) => pair,
                Err(fault) => return State::Broken(Missing::Said(fault.message)),
            };
            for (before, picture) in before.iter_mut().zip(&pair) {
                if (picture.width(), picture.height()) != (reference.width(), reference.height()) {
                    let sizes = "its frames have different sizes".to_owned();
                    return State::Broken(Missing::Said(sizes));
                }
                before.insert(frame, self.luminance(picture));
            }
        }
        State::Going {
            reference: Stream::begin(time, reference, &before[0]),
            test: Stream::begin(time, test, &before[1]),
            done: 1,
        }
    }

    fn score(
        &mut self,
        pair: &Pair<'_>,
        metric: &Fvvdp,
        regions: &FvvdpRegions,
    ) -> (FvvdpFrame, Option<Map>) {
        let Some(Sequence { timing, state: State::Going { reference, test, .. }, .. }) =
            self.sequences.get(&pair.method)
        else {
            unreachable!("the sequence goes on")
        };
        let Ok(time) = &timing.time else { unreachable!("the sequence can be filtered") };
        let frames = reference.frames().into_iter().map(|place| timing.frames[place]);
        let seen = Seen(frames.collect(), pair.gaze_px.map(f64::to_bits));
        if self.prepared.as_ref().is_none_or(|(before, _)| *before != seen) {
            // Free the old reference first, so that the two do not use memory at the same time.
            self.prepared = None;
            let channels = reference.channels(time);
            let prepared = metric.reference(channels, pair.gaze_px, pair.tests > 1);
            self.prepared = Some((seen, prepared));
        }
        let Some((_, prepared)) = &self.prepared else { unreachable!("it has been prepared") };
        let channels = test.channels(time);
        let mut differences = pair.maps.then(DifferenceMap::default);
        let frame = metric.score(prepared, &channels, regions, differences.as_mut());
        let map = differences.map(|differences| {
            let context = match self.params.map_context {
                MapContext::Test => &channels[0],
                MapContext::Reference => prepared.sustained(),
            };
            differences.map(context)
        });
        if pair.tests == 1 {
            self.prepared = None;
        }
        (frame, map)
    }

    /// Why a method's sequence has no value, as far as the sequence was read here. `number` gives
    /// the names of its frames.
    pub(super) fn missing(
        &self,
        method: usize,
        number: impl Fn(usize) -> String,
    ) -> Option<String> {
        self.sequences.get(&method)?.missing(number)
    }

    /// The viewing conditions for a method's sequence.
    pub(super) fn sight(&self, method: usize, metric: &Fvvdp) -> Option<FvvdpViewing> {
        let sequence = self.sequences.get(&method)?;
        Some(FvvdpViewing {
            pixels_per_degree: metric.geometry().pixels_per_degree,
            peak_cd_m2: self.photometry.peak_cd_m2(),
            black_cd_m2: self.photometry.black_cd_m2(),
            foveated: self.params.foveated,
            frequencies_cpd: metric.frequencies_cpd().collect(),
            fps: sequence.timing.fps,
            missing: None,
            eyes_jod: None,
        })
    }
}
