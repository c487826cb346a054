//! The sources of one view: reference, tests, motion and depth.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_frame::source::Source;
#[cfg(test)]
use fovqa_frame::source::{Length, Listing, Origin, Picture, PictureGuides, SourceError};

use crate::found_frame::FoundFrame;

/// The sources that the frames of a view come from.
#[derive(Debug, Clone)]
pub struct ViewSources {
    /// The reference.
    pub reference: Arc<dyn Source>,
    /// The tests, by the index of their method.
    pub tests: BTreeMap<usize, Arc<dyn Source>>,
    /// The motion, if it has files of its own.
    pub motion: Option<Arc<dyn Source>>,
    /// The depth, if it has files of its own.
    pub depth: Option<Arc<dyn Source>>,
}

impl ViewSources {
    /// The source of a method's tests.
    pub(crate) fn test(&self, method: usize) -> &dyn Source {
        let Some(source) = self.tests.get(&method) else {
            unreachable!("a frame with a test has its source")
        };
        &**source
    }

    /// All sources of the view.
    pub fn all(&self) -> impl Iterator<Item = &dyn Source> {
        let guides = self.motion.iter().chain(&self.depth);
        [&self.reference].into_iter().chain(self.tests.values()).chain(guides).map(|s| &**s)
    }

    /// The indices of a frame in all sources that it comes from.
    pub fn of_frame<'a>(
        &'a self,
        frame: &'a FoundFrame,
    ) -> impl Iterator<Item = (&'a dyn Source, usize)> {
        let tests = frame.tests.iter().map(|(method, test)| (self.test(*method), *test));
        let motion = self.motion.iter().zip(frame.guides.motion);
        let depth = self.depth.iter().zip(frame.guides.depth);
        let guides = motion.chain(depth).map(|(source, at)| (&**source, at));
        tests.chain([(&*self.reference, frame.reference)]).chain(guides)
    }
}

#[cfg(test)]
impl ViewSources {
    /// Sources for frames that are never read.
    pub(crate) fn empty() -> Self {
        let listing = Listing::counted(String::new(), Length::Whole(0));
        let (tests, reference) = (BTreeMap::new(), Arc::new(Never(listing)));
        Self { reference, tests, motion: None, depth: None }
    }
}

#[cfg(test)]
#[derive(Debug)]
struct Never(Listing);

#[cfg(test)]
impl Source for Never {
    fn listing(&self) -> &Listing {
        &self.0
    }

    fn size(&self, _frame: usize) -> Result<(usize, usize), SourceError> {
        unreachable!()
    }

    fn bytes_per_pixel(&self) -> u64 {
        unreachable!()
    }

    fn read(&self, _frame: usize, _guides: bool) -> Result<Picture, SourceError> {
        unreachable!()
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        unreachable!()
    }

    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        unreachable!()
    }
}
