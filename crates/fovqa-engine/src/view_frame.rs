//! One frame of an eye's view, as emulated methods see it.

use std::sync::Arc;

use fovqa_emulate::{Emulator, Picture, SceneLight};
use fovqa_frame::SignalTables;
use fovqa_gallery::FrameScene;
use fovqa_plan::{EyeView, Gaze};

use crate::events::Warnings;
use crate::found::FoundView;
use crate::foveator::Foveator;
use crate::load::{Fault, Side};

/// A frame of a view with its reference.
#[derive(Clone, Copy)]
pub(crate) struct ViewFrame<'a> {
    pub(crate) view: &'a FoundView,
    /// Index of the frame in the view.
    pub(crate) frame: usize,
    pub(crate) reference: &'a Side,
}

impl ViewFrame<'_> {
    /// The position of the frame in its sequence.
    pub(crate) fn position(&self) -> usize {
        self.view.frames[self.frame].position
    }

    /// The frame whose jitter applies: frames of a built-in scene are numbered from its first one.
    pub(crate) fn jittered(&self) -> usize {
        match &self.view.sources.builtin {
            Some(_) => self.view.frames[self.frame].reference,
            None => self.position(),
        }
    }

    /// The gaze: that of the trace, or else that of all frames, if there is one.
    pub(crate) fn gaze_px(&self, fixed: Option<[f64; 2]>) -> Option<[f64; 2]> {
        self.view.trace.as_ref().map(|trace| trace[self.frame].px).or(fixed)
    }

    /// Checks that the frame can be emulated, and warns of what its temporal filter lacks. `motion` is
    /// whether the frames have motion, as far as is known.
    pub(crate) fn ready(
        &self,
        foveator: &Foveator,
        motion: &mut Option<bool>,
        warnings: &mut Warnings<'_>,
    ) -> Result<(), Fault> {
        self.reference.finite()?;
        if !foveator.is_temporal() {
            return Ok(());
        }
        if !foveator.begins_at(self.position()) {
            let here = self.reference.guides.motion.is_some();
            check_motion(motion, here, &self.reference.file, warnings)?;
        } else if self.frame > 0 {
            warn_of_gap(self.view.frames[self.frame].number, warnings);
        }
        Ok(())
    }

    /// What a method shows of the frame. `before` is the picture of the reference; `None` if the scene
    /// itself is sampled.
    pub(crate) fn show(
        &self,
        foveator: &mut Foveator,
        before: Option<&Picture>,
        tables: &SignalTables,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<(Picture, Arc<Emulator>), Fault> {
        let motion = self.reference.guides.motion.as_ref();
        match (&self.view.sources.builtin, before) {
            (Some(builtin), _) => {
                let index = self.view.frames[self.frame].reference;
                let scene = builtin.frame(index);
                let lit = BuiltinLight(&*scene);
                let seen = (&lit as &dyn SceneLight, <[usize; 2]>::from(self.reference.size()));
                let at = (self.position(), index);
                foveator.next_of_scene(at, seen, tables.params(), motion, gaze_px)
            }
            (None, Some(before)) => foveator.next(self.position(), before, motion, gaze_px),
            (None, None) => unreachable!("a frame that is no scene has a picture"),
        }
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
        Gaze::Centre | Gaze::Builtin | Gaze::Each(_) | Gaze::Trace { .. } => None,
    }
}

/// Warns of a frame at which a temporal filter begins again.
fn warn_of_gap(frame: i64, warnings: &mut Warnings<'_>) {
    let message = format!(
        "no frame comes directly before frame {frame}: the temporal filter begins again there, and wherever frames \
         are missing, left out, or could not be read"
    );
    warnings.once_a_view("temporal filter begins again", &message);
}

/// Warns if a temporal filter has no motion, and refuses frames without motion after frames with it.
fn check_motion(
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
