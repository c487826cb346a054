//! Opens the sources of a view once, before any frame is read.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use fovqa_frame::source::{InputId, Source};
use fovqa_gallery::{Builtin, BuiltinSource};
use fovqa_io::sequence::pair;
use fovqa_io::{
    DepthChannels, GuideOptions, MotionChannels, ReadOptions, SourceOptions, id_of, open_source,
};
use fovqa_metrics::Needs;
use fovqa_plan::{EyeView, Plan, SourceSpec};
use fovqa_vision::View;

use crate::error::EngineError;
use crate::found_frame::{FoundFrame, GuideFrames};
use crate::test_source::TestSource;

/// Sources that a plan names but does not contain ([`SourceSpec::Given`]), by their names.
pub type Given = BTreeMap<String, Arc<dyn Source>>;

/// Opens the sources of a view.
pub(crate) struct Opener<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) view: &'a EyeView,
    pub(crate) given: &'a Given,
    /// The built-in scene of the reference, if it is one ([`builtin`]).
    pub(crate) builtin: Option<Arc<Builtin>>,
}

impl Opener<'_> {
    /// Opens the reference.
    pub(crate) fn reference(&self) -> Result<Arc<dyn Source>, EngineError> {
        self.open(&self.view.reference, self.view.settings.read.layer.as_deref())
    }

    /// Opens the tests of a method.
    pub(crate) fn test(&self, method: usize, spec: &SourceSpec) -> Result<TestSource, EngineError> {
        if let SourceSpec::Emulated(emulation) = spec {
            return Ok(TestSource::Emulated(Arc::new((**emulation).clone())));
        }
        let own = self.view.test_layers.get(&method).map(String::as_str);
        let source = self.open(spec, own.or(self.view.settings.read.layer.as_deref()))?;
        Ok(TestSource::Read(source))
    }

    fn open(&self, spec: &SourceSpec, layer: Option<&str>) -> Result<Arc<dyn Source>, EngineError> {
        let read = ReadOptions {
            layer: layer.map(str::to_owned),
            guides: self.beside_colour(),
            ..self.view.settings.read.clone()
        };
        match spec {
            SourceSpec::Files(path) => Ok(open_source(path, self.options(read))?),
            SourceSpec::Given(name) => self.given(name),
            SourceSpec::Builtin(frames) => {
                let Some(builtin) = self.builtin.clone() else {
                    unreachable!("the scene was prepared before it is opened")
                };
                let made = serde_json::to_vec(&(
                    frames,
                    builtin.view().focal_px,
                    builtin.view().principal_px,
                ));
                // Writing to memory and reading from it do not fail.
                let id = id_of(made.unwrap_or_default().as_slice())
                    .unwrap_or(InputId { bytes: 0, sha256: String::new() });
                Ok(Arc::new(BuiltinSource::new(builtin, id)))
            }
            SourceSpec::Emulated(_) => Err(EngineError::EmulatedReference),
        }
    }

    fn given(&self, name: &str) -> Result<Arc<dyn Source>, EngineError> {
        let source = self.given.get(name);
        source.cloned().ok_or_else(|| EngineError::NotGiven { name: name.to_owned() })
    }

    /// The mask, if the program gives it.
    pub(crate) fn given_mask(&self) -> Result<Option<Arc<dyn Source>>, EngineError> {
        self.view.settings.given_mask.as_deref().map(|name| self.given(name)).transpose()
    }

    fn options(&self, read: ReadOptions) -> SourceOptions {
        SourceOptions { base: self.plan.base.clone(), read, hash: self.plan.hash_inputs }
    }

    /// Which motion and depth to look for in the same files as the colour. The user's channel names
    /// for separate files are not used here, because they may be names of colour channels in these
    /// files.
    fn beside_colour(&self) -> GuideOptions {
        let settings = &self.view.settings;
        let mut wanted = settings.guides.clone();
        let is_named =
            matches!(wanted.motion, MotionChannels::Named(_) | MotionChannels::NamedAs(..));
        if settings.motion_files.is_some() && is_named {
            wanted.motion = MotionChannels::None;
        }
        if settings.depth_files.is_some() && matches!(wanted.depth, DepthChannels::Named(_)) {
            wanted.depth = DepthChannels::None;
        }
        wanted
    }

    /// Opens the files of motion and depth, if there are any and a metric or a method uses them, and finds
    /// those that belong to each reference. A frame may have none: whether that is an error depends
    /// on the whole sequence.
    pub(crate) fn guides(
        &self,
        reference: &dyn Source,
        frames: &mut [FoundFrame],
    ) -> Result<[Option<Arc<dyn Source>>; 2], EngineError> {
        let filters = |(_, test): &(usize, SourceSpec)| match test {
            SourceSpec::Emulated(emulation) => emulation.uses_guides(),
            SourceSpec::Files(_) | SourceSpec::Given(_) | SourceSpec::Builtin(_) => false,
        };
        let wanted = Needs::of(self.plan.metrics.metrics()).guides;
        if !wanted && !self.view.tests.iter().any(filters) {
            return Ok([None, None]);
        }
        let settings = &self.view.settings;
        let (motion, depth) = (settings.guides.motion.clone(), settings.guides.depth.clone());
        let motion = GuideOptions { motion, ..GuideOptions::default() };
        let depth = GuideOptions { depth, ..GuideOptions::default() };
        let motion = self.own_files(settings.motion_files.as_ref(), motion, reference)?;
        let depth = self.own_files(settings.depth_files.as_ref(), depth, reference)?;
        for frame in frames {
            let of = |found: &Option<OwnFiles>| {
                found.as_ref().and_then(|(_, places)| places.get(&frame.reference)).copied()
            };
            frame.guides = GuideFrames { motion: of(&motion), depth: of(&depth) };
        }
        Ok([motion, depth].map(|found| found.map(|(source, _)| source)))
    }

    fn own_files(
        &self,
        files: Option<&PathBuf>,
        guides: GuideOptions,
        reference: &dyn Source,
    ) -> Result<Option<OwnFiles>, EngineError> {
        let Some(files) = files else { return Ok(None) };
        let read = ReadOptions { guides, ..self.view.settings.read.clone() };
        let source = open_source(files, self.options(read))?;
        let pairs = pair(reference.listing(), source.listing())?.pairs.into_iter();
        Ok(Some((source, pairs.map(|pair| (pair.reference, pair.test)).collect())))
    }
}

/// Files of motion or depth, and the index of the file for each reference.
type OwnFiles = (Arc<dyn Source>, BTreeMap<usize, usize>);

/// The built-in sequence of a reference as an eye sees it; `None` if the reference is another. A scene
/// without a view, such as a flat pattern, is seen from anywhere.
pub(crate) fn builtin(eye: &EyeView) -> Result<Option<Arc<Builtin>>, EngineError> {
    let SourceSpec::Builtin(frames) = &eye.reference else { return Ok(None) };
    let [width, height] = frames.size;
    let view = if let Some(spec) = &eye.settings.view {
        spec.resolve(width, height)?.view
    } else {
        let (w, h) = (width as f64, height as f64);
        let focal_px = [h.max(1.0) / 2.0; 2];
        View { width, height, focal_px, principal_px: [w / 2.0, h / 2.0] }
    };
    Ok(Some(Arc::new(Builtin::new(&frames.spec, view, frames.eye_m)?)))
}
