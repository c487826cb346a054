//! What the methods of an eye take from the frames of the dominant eye: these are emulated again here, with
//! their own gaze, view and history, so that both eyes can be scored apart.

use std::collections::BTreeMap;

use fovqa_emulate::{EyeFrame, Picture, Reprojected, reproject};
use fovqa_frame::{Plane, SignalTables};
use fovqa_plan::{EyeView, Reproject};
use fovqa_vision::{View, ViewSpec};

use crate::dominant_eye::DominantEye;
use crate::events::Warnings;
use crate::found::FoundView;
use crate::foveator::{Foveator, resolved};
use crate::load::{Fault, LoadError, Side, Step};
use crate::view_frame::{ViewFrame, fixed_gaze};

/// The frames of the dominant eye as the methods of the other one need them.
pub(crate) struct Reprojector<'a> {
    dominant: DominantEye<'a>,
    /// The view of the other eye.
    own_view: Option<&'a ViewSpec>,
    /// For each method, what is emulated for the dominant eye.
    foveators: BTreeMap<usize, Foveator>,
    tables: SignalTables,
    /// Its present frame.
    present: Option<Result<Side, Fault>>,
    /// The picture of that frame, made once for all methods.
    picture: Option<Picture>,
    /// Whether its frames have motion, as far as is known.
    motion: Option<bool>,
}

impl<'a> Reprojector<'a> {
    /// For the methods of the eye `own`.
    pub(crate) fn new(dominant: DominantEye<'a>, own: &'a EyeView, view: &FoundView) -> Self {
        let settings = &dominant.eye.settings;
        let foveators = view.sources.emulations().filter_map(|(method, emulation)| {
            let spec = emulation.reproject()?.spec.clone();
            Some((method, Foveator::new(spec, settings.view.clone())))
        });
        Self {
            own_view: own.settings.view.as_ref(),
            foveators: foveators.collect(),
            tables: SignalTables::new(settings.signal),
            present: None,
            picture: None,
            motion: None,
            dominant,
        }
    }

    /// Keeps the dominant eye's frame of the next step.
    pub(crate) fn enter(&mut self, frame: Option<Result<Side, LoadError>>) {
        self.picture = None;
        self.present = frame.map(|frame| frame.map_err(Fault::from));
    }

    /// Fills the frame that a method shows the other eye, `own` with its reference, from what it shows the
    /// dominant one.
    pub(crate) fn fill(
        &mut self,
        step: &Step<'_>,
        how: &Reproject,
        (own, reference): (&Picture, &Side),
        warnings: &mut Warnings<'_>,
    ) -> Result<Reprojected, Fault> {
        let side = match &self.present {
            Some(Ok(side)) => side,
            Some(Err(fault)) => return Err(fault.clone()),
            None => unreachable!("the dominant eye's frame comes with the reference"),
        };
        let Some(foveator) = self.foveators.get_mut(&step.method) else {
            unreachable!("a method that takes from the dominant eye emulates it")
        };
        let (view, frame) = self.dominant.frame(step.found.number)?;
        let at = ViewFrame { view, frame, reference: side };
        at.ready(foveator, &mut self.motion, warnings)?;
        let gaze_px = at.gaze_px(fixed_gaze(self.dominant.eye));
        let (tables, picture) = (&self.tables, &mut self.picture);
        let before = match &view.sources.builtin {
            Some(_) => None,
            None => Some(&*picture.get_or_insert_with(|| Picture::from_frame(&side.frame, tables))),
        };
        let (shown, _) = at.show(foveator, before, tables, gaze_px)?;
        let views =
            [seen(self.dominant.eye.settings.view.as_ref(), &shown)?, seen(self.own_view, own)?];
        let from = EyeFrame { picture: &shown, depth: depth(side)?, view: &views[0] };
        let to = EyeFrame { picture: own, depth: depth(reference)?, view: &views[1] };
        Ok(reproject(&from, &to, how.baseline())?)
    }
}

fn seen(spec: Option<&ViewSpec>, picture: &Picture) -> Result<View, Fault> {
    resolved(spec, [picture.width(), picture.height()])?.ok_or_else(|| Fault {
        message: "reproject needs the focal length of both eyes, but there is no view".to_owned(),
        help: "give {view}".to_owned(),
    })
}

fn depth(side: &Side) -> Result<&Plane, Fault> {
    side.guides.depth.as_ref().ok_or_else(|| Fault {
        message: format!("{} has no depth, which reproject compares between both eyes", side.file),
        help: "render depth into the OpenEXR files of both eyes, or name it with {depth}"
            .to_owned(),
    })
}
