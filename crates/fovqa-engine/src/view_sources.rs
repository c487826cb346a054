//! The sources of one view: reference, tests, motion and depth.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_frame::source::Source;
#[cfg(test)]
use fovqa_frame::source::{Length, Listing, Origin, Picture, PictureGuides, SourceError};
use fovqa_gallery::Builtin;
use fovqa_plan::Emulation;

use crate::found_frame::FoundFrame;
use crate::test_source::TestSource;

/// The sources that the frames of a view come from.
#[derive(Debug, Clone)]
pub struct ViewSources {
    /// The reference.
    pub reference: Arc<dyn Source>,
    /// The built-in scene that the reference is drawn from, if it is: methods sample the scene itself.
    pub builtin: Option<Arc<Builtin>>,
    /// The tests, by the index of their method.
    pub tests: BTreeMap<usize, TestSource>,
    /// The motion, if it has files of its own.
    pub motion: Option<Arc<dyn Source>>,
    /// The depth, if it has files of its own.
    pub depth: Option<Arc<dyn Source>>,
    /// The mask, if the program gives it instead of a file.
    pub mask: Option<Arc<dyn Source>>,
}

impl ViewSources {
    /// The source of a method's tests.
    pub(crate) fn test(&self, method: usize) -> &TestSource {
        let Some(source) = self.tests.get(&method) else {
            unreachable!("a frame with a test has its source")
        };
        source
    }

    /// The name of a method's test in results.
    pub(crate) fn test_name(&self, method: usize, test: usize) -> String {
        self.test(method).name(self.reference.listing(), test)
    }

    /// The emulated methods, by their indices.
    pub(crate) fn emulations(&self) -> impl Iterator<Item = (usize, &Emulation)> {
        self.tests.iter().filter_map(|(method, test)| Some((*method, test.emulation()?)))
    }

    /// Whether a method's temporal filter needs the frames before each frame.
    pub(crate) fn is_temporal(&self, method: usize) -> bool {
        self.tests.get(&method).and_then(TestSource::emulation).is_some_and(Emulation::is_temporal)
    }

    /// All sources of the view that are read.
    pub fn all(&self) -> impl Iterator<Item = &dyn Source> {
        let guides = self.motion.iter().chain(&self.depth).map(|source| &**source);
        let tests = self.tests.values().filter_map(TestSource::read);
        [&*self.reference].into_iter().chain(tests).chain(guides)
    }

    /// The indices of a frame in all sources that are read for it.
    pub fn of_frame<'a>(
        &'a self,
        frame: &'a FoundFrame,
    ) -> impl Iterator<Item = (&'a dyn Source, usize)> {
        let read = |(method, test): &(usize, usize)| Some((self.test(*method).read()?, *test));
        let tests = frame.tests.iter().filter_map(read);
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
        Self { reference, builtin: None, tests, motion: None, depth: None, mask: None }
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
