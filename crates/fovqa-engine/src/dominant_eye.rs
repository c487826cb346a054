//! The dominant eye of a scene, whose frames the methods of the other eye take.

use fovqa_frame::source::{Source, SourceError};
use fovqa_params::Words;
use fovqa_plan::{EyeView, Plan};

use crate::found::{FoundInputs, FoundView};
use crate::load::{LoadError, Loader, Side};

/// The dominant eye, seen from the other one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DominantEye<'a> {
    pub(crate) eye: &'a EyeView,
    /// Its frames; `None` if they were not found.
    view: Option<&'a FoundView>,
}

impl<'a> DominantEye<'a> {
    /// The dominant eye of a view's scene, if methods of the view take from its frames.
    pub(crate) fn of(plan: &'a Plan, found: &'a FoundInputs, view: &FoundView) -> Option<Self> {
        let mut taken = view.sources.emulations().filter_map(|(_, of)| of.reproject());
        let dominant = taken.next()?.dominant;
        let mut eyes = plan.scenes[view.scene].eyes.iter().enumerate();
        let (index, eye) = eyes.find(|(_, eye)| eye.eye == Some(dominant))?;
        let is_it = |other: &&FoundView| (other.scene, other.eye) == (view.scene, index);
        Some(Self { eye, view: found.views.iter().find(is_it) })
    }

    /// Its frame with a number: its view, and the index of the frame there.
    pub(crate) fn frame(&self, number: i64) -> Result<(&'a FoundView, usize), LoadError> {
        let eye = self.eye.eye.map_or("dominant", Words::word);
        let missing = || LoadError::NoDominantFrame { frame: number, eye };
        let view = self.view.ok_or_else(missing)?;
        // Frames are in the order of their numbers.
        let at = view.frames.partition_point(|frame| frame.number < number);
        let found = view.frames.get(at).filter(|frame| frame.number == number);
        found.map(|_| (view, at)).ok_or_else(missing)
    }

    /// Loads the frame with a number, with its motion and depth.
    pub(crate) fn load(&self, number: i64) -> Result<Side, LoadError> {
        let (view, at) = self.frame(number)?;
        let (sources, found) = (&view.sources, &view.frames[at]);
        if let Some(stream) = sources.all().find(|source| source.is_read_once()) {
            return Err(once(stream).into());
        }
        let loader = Loader { settings: &self.eye.settings, sources, guides: true };
        match &sources.builtin {
            // Methods sample the scene itself.
            Some(builtin) => Ok(loader.unlit(builtin, found)),
            None => loader.reference(found, at == 0),
        }
    }
}

fn once(stream: &dyn Source) -> SourceError {
    let message = format!(
        "{}: to reproject from one eye to the other, frames are read once for each eye, but a stream can only be \
         read once",
        stream.listing().argument
    );
    SourceError::new(message, "write it to a file first, or leave reproject out")
}
