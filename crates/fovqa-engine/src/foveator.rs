//! Emulates the frames of one eye's view with one method, in their order.

use std::sync::Arc;

use fovqa_emulate::{EmulateError, EmulationSpec, Emulator, History, Picture, SceneLight};
use fovqa_frame::{Frame, Motion, SignalParams, SignalTables};
use fovqa_vision::{View, ViewSpec};

use crate::error::EngineError;
use crate::load::Fault;

/// Number of gaze positions for which an emulator is kept: the eyes return to earlier positions.
const KEPT: usize = 4;
/// Maximum number of methods of a view that keep emulators. Those of a long sweep would fill the memory.
const MOST_KEEPING: usize = 256;

/// A method with what it keeps from frame to frame.
#[derive(Debug)]
pub(crate) struct Foveator {
    spec: EmulationSpec,
    view: Option<ViewSpec>,
    /// Number of gaze positions for which an emulator is kept.
    kept: usize,
    /// The emulators that were used last, the latest at the end.
    emulators: Vec<(Place, Arc<Emulator>)>,
    history: History,
    /// Position of the last frame.
    last: Option<usize>,
}

/// Size and gaze of frames. The gaze is compared bit by bit.
type Place = ([usize; 2], [u64; 2]);

impl Foveator {
    pub(crate) fn new(spec: EmulationSpec, view: Option<ViewSpec>) -> Self {
        let (emulators, history) = (Vec::new(), History::default());
        Self { spec, view, kept: KEPT, emulators, history, last: None }
    }

    /// One of so many foveators of a view.
    pub(crate) fn one_of(self, methods: usize) -> Self {
        Self { kept: if methods > MOST_KEEPING { 0 } else { KEPT }, ..self }
    }

    /// Whether its temporal filter needs the frame before each frame, and its motion.
    pub(crate) fn is_temporal(&self) -> bool {
        self.spec.is_temporal()
    }

    /// Whether the next frame passes through the temporal filter, because no frame comes directly
    /// before it.
    pub(crate) fn begins_at(&self, position: usize) -> bool {
        position.checked_sub(1) != self.last || self.last.is_none()
    }

    /// The gaze that frames of a size are emulated with; by default the principal point or, without
    /// a view, the centre.
    pub(crate) fn gaze(&self, size: [usize; 2], gaze_px: Option<[f64; 2]>) -> [f64; 2] {
        let view = resolved(self.view.as_ref(), size).unwrap_or_default();
        gaze(view.as_ref(), size, gaze_px)
    }

    /// Emulates a frame that stands alone.
    pub(crate) fn alone(
        &self,
        position: usize,
        picture: &Picture,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<Picture, Fault> {
        let size = [picture.width(), picture.height()];
        let emulator = prepare(&self.spec, self.view.as_ref(), size, gaze_px)?;
        Ok(emulator.at_frame(position)?.emulate(picture)?)
    }

    /// Emulates a frame of a scene that stands alone.
    pub(crate) fn alone_of_scene(
        &self,
        frame: usize,
        (scene, size): (&dyn SceneLight, [usize; 2]),
        signal: &SignalParams,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<Picture, Fault> {
        let emulator = prepare(&self.spec, self.view.as_ref(), size, gaze_px)?;
        Ok(emulator.emulate_scene(scene, frame, signal, None, &mut History::default())?)
    }

    /// Emulates a frame of 8-bit codes without a temporal filter: the same codes as by way of
    /// pictures, in much less time.
    pub(crate) fn next_codes8(
        &mut self,
        position: usize,
        frame: &Frame,
        tables: &SignalTables,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<(Frame, Arc<Emulator>), Fault> {
        let emulator = self.emulator([frame.width(), frame.height()], gaze_px)?;
        let shown = emulator.at_frame(position)?.emulate_codes8(frame, tables)?;
        Ok((shown, emulator))
    }

    /// Emulates the next frame. After a gap in the positions, the temporal filter begins again.
    pub(crate) fn next(
        &mut self,
        position: usize,
        picture: &Picture,
        motion: Option<&Motion>,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<(Picture, Arc<Emulator>), Fault> {
        let emulator = self.emulator([picture.width(), picture.height()], gaze_px)?;
        self.begin(position);
        let frame = emulator.at_frame(position)?;
        let shown = frame.emulate_next(picture, motion, &mut self.history)?;
        self.last = Some(position);
        Ok((shown, emulator))
    }

    /// Emulates the next frame of a scene that can be sampled anywhere; `frame` is its index, from 0.
    pub(crate) fn next_of_scene(
        &mut self,
        (position, frame): (usize, usize),
        (scene, size): (&dyn SceneLight, [usize; 2]),
        signal: &SignalParams,
        motion: Option<&Motion>,
        gaze_px: Option<[f64; 2]>,
    ) -> Result<(Picture, Arc<Emulator>), Fault> {
        let emulator = self.emulator(size, gaze_px)?;
        self.begin(position);
        let shown = emulator.emulate_scene(scene, frame, signal, motion, &mut self.history)?;
        self.last = Some(position);
        Ok((shown, emulator))
    }

    /// Forgets the history if the frame before is not the last one. Until the frame is emulated, there
    /// is no last one.
    fn begin(&mut self, position: usize) {
        if self.begins_at(position) {
            self.history = History::default();
        }
        self.last = None;
    }

    fn emulator(
        &mut self,
        size: [usize; 2],
        gaze_px: Option<[f64; 2]>,
    ) -> Result<Arc<Emulator>, Fault> {
        let place = (size, gaze_px.unwrap_or([f64::NAN; 2]).map(f64::to_bits));
        let emulator = match self.emulators.iter().position(|(known, _)| *known == place) {
            Some(index) => self.emulators.remove(index).1,
            None => Arc::new(prepare(&self.spec, self.view.as_ref(), size, gaze_px)?),
        };
        self.emulators.push((place, Arc::clone(&emulator)));
        if self.emulators.len() > self.kept {
            self.emulators.remove(0);
        }
        Ok(emulator)
    }
}

/// Checks an emulation of frames of a size at a gaze; `None` is the principal point.
pub(crate) fn check(
    spec: &EmulationSpec,
    view: Option<&ViewSpec>,
    size: [usize; 2],
    gaze_px: Option<[f64; 2]>,
) -> Result<(), EngineError> {
    let view = resolved(view, size)?;
    Emulator::check(spec, size, view.as_ref(), gaze(view.as_ref(), size, gaze_px))?;
    Ok(())
}

/// The range of budgets of a method for frames of a size at a gaze; `None` is the principal point.
pub(crate) fn budget_range(
    spec: &EmulationSpec,
    view: Option<&ViewSpec>,
    size: [usize; 2],
    gaze_px: Option<[f64; 2]>,
) -> Result<[f64; 2], EngineError> {
    let view = resolved(view, size)?;
    let gaze = gaze(view.as_ref(), size, gaze_px);
    Ok(Emulator::budget_range(spec, size, view.as_ref(), gaze)?)
}

fn prepare(
    spec: &EmulationSpec,
    view: Option<&ViewSpec>,
    size: [usize; 2],
    gaze_px: Option<[f64; 2]>,
) -> Result<Emulator, Fault> {
    let view = resolved(view, size)?;
    Ok(Emulator::new(spec, size, view.as_ref(), gaze(view.as_ref(), size, gaze_px))?)
}

pub(crate) fn resolved(
    view: Option<&ViewSpec>,
    [width, height]: [usize; 2],
) -> Result<Option<View>, EngineError> {
    Ok(view.map(|view| view.resolve(width, height)).transpose()?.map(|resolved| resolved.view))
}

/// The gaze; by default the principal point or, without a view, the centre.
fn gaze(view: Option<&View>, size: [usize; 2], gaze_px: Option<[f64; 2]>) -> [f64; 2] {
    let centre = || size.map(|side| side as f64 / 2.0);
    gaze_px.unwrap_or_else(|| view.map_or_else(centre, |view| view.principal_px))
}

impl From<EngineError> for Fault {
    fn from(error: EngineError) -> Self {
        Self { message: error.to_string(), help: error.help() }
    }
}

impl From<EmulateError> for Fault {
    fn from(error: EmulateError) -> Self {
        EngineError::from(error).into()
    }
}
