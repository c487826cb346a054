//! The tests that are emulated from the reference of a frame, for all methods of a view.

use std::collections::BTreeMap;

use fovqa_emulate::{Picture, SceneLight, WriteFrameError};
use fovqa_frame::{Frame, Samples, SignalTables, Transfer};
use fovqa_gallery::FrameScene;
use fovqa_plan::{EyeView, Gaze};

use crate::events::Warnings;
use crate::found::FoundView;
use crate::foveator::Foveator;
use crate::load::{Fault, Made, Side, Step};

/// The emulated methods of a view. The picture of the present reference is made once for all of them.
#[derive(Debug)]
pub(crate) struct EmulatedMethods {
    foveators: BTreeMap<usize, Foveator>,
    /// The picture of the present reference.
    picture: Option<Picture>,
    /// Whether a metric needs linear light of linear input.
    needs_light: bool,
    fixed_gaze: Option<[f64; 2]>,
    /// Whether the frames of the reference have motion, as far as is known.
    motion: Option<bool>,
}

impl EmulatedMethods {
    pub(crate) fn new(view: &FoundView, eye: &EyeView, needs_light: bool) -> Self {
        let foveator = |(method, emulation): (usize, &fovqa_plan::Emulation)| {
            (method, Foveator::new(emulation.spec.clone(), eye.settings.view.clone()))
        };
        Self {
            foveators: view.sources.emulations().map(foveator).collect(),
            picture: None,
            needs_light,
            fixed_gaze: fixed_gaze(eye),
            motion: None,
        }
    }

    /// Forgets the picture of a reference that is about to be dropped.
    pub(crate) fn leave(&mut self) {
        self.picture = None;
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
        reference.finite()?;
        let position = view.frames[step.frame].position;
        let motion = reference.guides.motion.as_ref();
        if foveator.is_temporal() && !foveator.begins_at(position) {
            check_motion(&mut self.motion, motion.is_some(), &reference.file, warnings)?;
        }
        if foveator.is_temporal() && step.frame > 0 && foveator.begins_at(position) {
            warn_of_gap(view.frames[step.frame].number, warnings);
        }
        let gaze_px = view.trace.as_ref().map(|trace| trace[step.frame].px).or(self.fixed_gaze);
        let emulation = view.sources.test(step.method).emulation();
        let keeps = emulation.is_some_and(|emulation| emulation.keep_frames);
        let file = view.sources.test_name(step.method, step.test);
        if let Some(builtin) = &view.sources.builtin {
            let scene = builtin.frame(step.test);
            let lit = BuiltinLight(&*scene);
            let (width, height) = reference.size();
            let (at, seen) = ((position, step.test), (&lit as &dyn SceneLight, [width, height]));
            let signal = tables.params();
            let (shown, emulator) = foveator.next_of_scene(at, seen, signal, motion, gaze_px)?;
            let frame = linear(shown.to_linear(signal), &shown, self.needs_light)?;
            let made = Made {
                counts: emulator.counts().clone(),
                kept: keeps.then(|| kept(&shown, &frame)),
            };
            return Ok(Side::emulated(file, frame, reference.pixel_aspect, made));
        }
        if matches!(reference.frame.samples(), Samples::U8(_)) && !foveator.is_temporal() {
            let (frame, emulator) =
                foveator.next_codes8(position, &reference.frame, tables, gaze_px)?;
            let kept = keeps.then(|| frame.clone());
            let made = Made { counts: emulator.counts().clone(), kept };
            return Ok(Side::emulated(file, frame, reference.pixel_aspect, made));
        }
        let before =
            self.picture.get_or_insert_with(|| Picture::from_frame(&reference.frame, tables));
        let (shown, emulator) = foveator.next(position, before, motion, gaze_px)?;
        let frame = frame_of(&shown, before, &reference.frame, tables, self.needs_light)?;
        let made =
            Made { counts: emulator.counts().clone(), kept: keeps.then(|| kept(&shown, &frame)) };
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

/// A frame of a built-in scene, as emulation asks for it.
pub(crate) struct BuiltinLight<'a>(pub(crate) &'a dyn FrameScene);

impl SceneLight for BuiltinLight<'_> {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        self.0.light(x, y)
    }
}

/// The gaze of all frames, if the user gave one.
pub(crate) fn fixed_gaze(eye: &EyeView) -> Option<[f64; 2]> {
    match eye.settings.gaze {
        Gaze::Point(px) => Some(px),
        Gaze::Centre | Gaze::Builtin | Gaze::Trace { .. } => None,
    }
}

/// Warns of a frame at which a temporal filter begins again.
pub(crate) fn warn_of_gap(frame: i64, warnings: &mut Warnings<'_>) {
    let message = format!(
        "no frame comes directly before frame {frame}: the temporal filter begins again there, and wherever frames \
         are missing, left out, or could not be read"
    );
    warnings.once_a_view("temporal filter begins again", &message);
}

/// Warns if a temporal filter has no motion, and refuses frames without motion after frames with it.
pub(crate) fn check_motion(
    all: &mut Option<bool>,
    here: bool,
    file: &str,
    warnings: &mut Warnings<'_>,
) -> Result<(), Fault> {
    if *all.get_or_insert(here) != here {
        let message = if here {
            format!("{file} has motion vectors, but earlier frames have none")
        } else {
            format!("{file} has no motion vectors, but earlier frames have some")
        };
        let help = "render them for all frames, or leave the temporal filter out".to_owned();
        return Err(Fault { message, help });
    }
    if !here {
        let message = "the frames have no motion vectors: the temporal filter takes every pixel as standing \
                       still; if there are some, name them with {motion}";
        warnings.once_a_view("temporal filter without motion", message);
    }
    Ok(())
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
