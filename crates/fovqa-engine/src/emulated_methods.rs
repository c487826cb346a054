//! The tests that are emulated from the reference of a frame, for all methods of a view.

use std::collections::BTreeMap;

use fovqa_emulate::{Picture, SceneLight, WriteFrameError};
use fovqa_frame::{Frame, Samples, SignalTables, Transfer};
use fovqa_plan::{Emulation, EyeView};

use crate::dominant_eye::DominantEye;
use crate::events::Warnings;
use crate::found::FoundView;
use crate::foveator::Foveator;
use crate::load::{Fault, LoadError, Made, Side, Step};
use crate::reprojector::Reprojector;
use crate::view_frame::{BuiltinLight, ViewFrame, fixed_gaze};

/// The emulated methods of a view. The picture of the present reference is made once for all of them.
pub(crate) struct EmulatedMethods<'a> {
    foveators: BTreeMap<usize, Foveator>,
    /// The picture of the present reference.
    picture: Option<Picture>,
    /// Whether a metric needs linear light of linear input.
    needs_light: bool,
    fixed_gaze: Option<[f64; 2]>,
    /// Whether the frames of the reference have motion, as far as is known.
    motion: Option<bool>,
    /// What methods take from the dominant eye.
    reprojector: Option<Reprojector<'a>>,
}

impl<'a> EmulatedMethods<'a> {
    pub(crate) fn new(
        view: &FoundView,
        eye: &'a EyeView,
        dominant: Option<DominantEye<'a>>,
        needs_light: bool,
    ) -> Self {
        let methods = view.sources.emulations().count();
        let foveator = |(method, emulation): (usize, &Emulation)| {
            let foveator = Foveator::new(emulation.spec.clone(), eye.settings.view.clone());
            (method, foveator.one_of(methods))
        };
        Self {
            foveators: view.sources.emulations().map(foveator).collect(),
            picture: None,
            needs_light,
            fixed_gaze: fixed_gaze(eye),
            motion: None,
            reprojector: dominant.map(|dominant| Reprojector::new(dominant, eye, view)),
        }
    }

    /// Goes on to another frame: forgets the picture of the reference that is dropped, and keeps the frame
    /// of the dominant eye, if it was loaded.
    pub(crate) fn enter(&mut self, dominant: Option<Result<Side, LoadError>>) {
        self.picture = None;
        if let Some(reprojector) = &mut self.reprojector {
            reprojector.enter(dominant);
        }
    }

    /// Emulates the test of a step from its reference.
    pub(crate) fn next(
        &mut self,
        step: &Step<'_>,
        reference: &Side,
        view: &FoundView,
        tables: &SignalTables,
        warnings: &mut Warnings<'_>,
    ) -> Result<Side, Fault> {
        let Some(foveator) = self.foveators.get_mut(&step.method) else {
            unreachable!("a test that is not read is emulated")
        };
        let at = ViewFrame { view, frame: step.frame, reference };
        at.ready(foveator, &mut self.motion, warnings)?;
        let emulation = view.sources.test(step.method).emulation();
        let keeps = emulation.is_some_and(|emulation| emulation.keep_frames);
        let reproject = emulation.and_then(Emulation::reproject);
        let file = view.sources.test_name(step.method, step.test);
        let gaze_px = at.gaze_px(self.fixed_gaze);
        let is_scene = view.sources.builtin.is_some();
        let is_alone = !foveator.is_temporal() && reproject.is_none();
        if matches!(reference.frame.samples(), Samples::U8(_)) && is_alone && !is_scene {
            let (frame, emulator) =
                foveator.next_codes8(at.position(), &reference.frame, tables, gaze_px)?;
            let kept = keeps.then(|| frame.clone());
            let (counts, budget) = (emulator.counts().clone(), emulator.budget().cloned());
            let borders = emulator.borders();
            let made = Made { counts, reshaded_share: None, budget, kept, borders };
            return Ok(Side::emulated(file, frame, reference.pixel_aspect, made));
        }
        let picture = || Picture::from_frame(&reference.frame, tables);
        let before = (!is_scene).then(|| &*self.picture.get_or_insert_with(picture));
        let (mut shown, emulator) = at.show(foveator, before, tables, gaze_px)?;
        let (mut counts, mut reshaded_share) = (emulator.counts().clone(), None);
        if let (Some(reproject), Some(reprojector)) = (reproject, &mut self.reprojector) {
            let taken = reprojector.fill(step, reproject, (&shown, reference), warnings)?;
            let shaded = emulator.samples_on(at.jittered(), &taken.reshaded)?;
            reshaded_share = Some(shaded / counts.all());
            counts = counts.reshaded(shaded);
            shown = taken.picture;
        }
        let frame = match before {
            Some(before) => frame_of(&shown, before, &reference.frame, tables, self.needs_light)?,
            None => linear(shown.to_linear(tables.params()), &shown, self.needs_light)?,
        };
        let budget = emulator.budget().cloned();
        let kept = keeps.then(|| kept(&shown, &frame));
        let borders = emulator.borders();
        let made = Made { counts, reshaded_share, budget, kept, borders };
        Ok(Side::emulated(file, frame, reference.pixel_aspect, made))
    }

    /// Emulates a test of another frame, for code that looks ahead in a sequence.
    pub(crate) fn alone(
        &self,
        method: usize,
        frame: usize,
        reference: &Frame,
        view: &FoundView,
        tables: &SignalTables,
    ) -> Result<Frame, Fault> {
        let Some(foveator) = self.foveators.get(&method) else {
            unreachable!("a test that is not read is emulated")
        };
        let picture = Picture::from_frame(reference, tables);
        let gaze_px = view.trace.as_ref().map(|trace| trace[frame].px).or(self.fixed_gaze);
        if let Some(builtin) = &view.sources.builtin {
            let index = view.frames[frame].reference;
            let scene = builtin.frame(index);
            let size = [reference.width(), reference.height()];
            let seen = (&BuiltinLight(&*scene) as &dyn SceneLight, size);
            let shown = foveator.alone_of_scene(index, seen, tables.params(), gaze_px)?;
            return linear(shown.to_linear(tables.params()), &shown, self.needs_light);
        }
        let shown = foveator.alone(view.frames[frame].position, &picture, gaze_px)?;
        frame_of(&shown, &picture, reference, tables, self.needs_light)
    }
}

/// The frame that an emulated picture stands for: codes of as many bits as the reference has, and
/// otherwise floats that are not rounded. Where emulation has changed nothing, it is the reference.
fn frame_of(
    shown: &Picture,
    before: &Picture,
    reference: &Frame,
    tables: &SignalTables,
    needs_light: bool,
) -> Result<Frame, Fault> {
    let is_same = |(now, then): (&f32, &f32)| now.to_bits() == then.to_bits();
    if shown.values().iter().zip(before.values()).all(is_same) {
        return Ok(reference.clone());
    }
    match reference.samples() {
        Samples::U8(_) => return Ok(shown.to_codes8()),
        Samples::U16(_) => return Ok(shown.to_codes16()),
        Samples::F16(_) | Samples::F32(_) => {}
    }
    let signal = tables.params();
    if signal.transfer_of(reference) != Transfer::Linear {
        return Ok(shown.to_signal());
    }
    linear(shown.to_linear_from(signal, before, reference), shown, needs_light)
}

/// Linear light, or the encoded signal where a tone map cannot be undone and no metric needs light.
fn linear(
    light: Result<Frame, WriteFrameError>,
    shown: &Picture,
    needs_light: bool,
) -> Result<Frame, Fault> {
    match light {
        Ok(frame) => Ok(frame),
        // Metrics of the encoded signal need no linear light.
        Err(_) if !needs_light => Ok(shown.to_signal()),
        Err(error) => Err(Fault {
            message: error.to_string(),
            help: "choose another tone map, or leave out the metrics of luminance".to_owned(),
        }),
    }
}

/// The frame as a picture file holds it: floats that are encoded for display become codes of 16 bits.
fn kept(shown: &Picture, frame: &Frame) -> Frame {
    let is_float = !frame.samples().is_integer();
    if is_float && frame.is_encoded() { shown.to_codes16() } else { frame.clone() }
}
