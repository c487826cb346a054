//! Which pairs of a view are to be scored, and which come before them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::findings::Outcome;
use crate::found::FoundView;
use crate::load::Step;

/// A view's pairs, and those of them that are to be scored: places among all pairs of the view.
pub(crate) struct Work<'a> {
    view: &'a FoundView,
    /// Each pair's frame, and its place among the tests of that frame.
    pairs: Vec<(usize, usize)>,
    range: Range<usize>,
    /// Those that are to be scored, in order.
    pub(crate) todo: Vec<usize>,
    /// Their methods.
    of: BTreeSet<usize>,
}

impl<'a> Work<'a> {
    /// Of the pairs in `range`, those that are not known.
    pub(crate) fn new(
        view: &'a FoundView,
        range: Range<usize>,
        known: &BTreeMap<usize, Outcome>,
    ) -> Self {
        let frames = view.frames.iter().enumerate();
        let pairs =
            frames.flat_map(|(frame, found)| (0..found.tests.len()).map(move |n| (frame, n)));
        let todo: Vec<usize> = range.clone().filter(|index| !known.contains_key(index)).collect();
        let mut work = Self { view, pairs: pairs.collect(), range, todo, of: BTreeSet::new() };
        work.of = work.todo.iter().map(|index| work.method(*index)).collect();
        work
    }

    /// The first that is to be scored; behind the last of the range, where there is none.
    pub(crate) fn first(&self) -> usize {
        self.todo.first().copied().unwrap_or(self.range.end)
    }

    /// The index of a pair's method.
    fn method(&self, index: usize) -> usize {
        let (frame, nth) = self.pairs[index];
        self.view.frames[frame].tests[nth].0
    }

    /// The methods of the range.
    pub(crate) fn methods(&self) -> BTreeSet<usize> {
        self.range.clone().map(|index| self.method(index)).collect()
    }

    /// Whether a pair of a method is to be scored.
    pub(crate) fn is_of(&self, method: usize) -> bool {
        self.of.contains(&method)
    }

    /// The pairs of a method before some pair.
    pub(crate) fn before(&self, end: usize, method: usize) -> Vec<usize> {
        (0..end).filter(|index| self.method(*index) == method).collect()
    }

    /// Behind the last pair of the range.
    pub(crate) fn end(&self) -> usize {
        self.range.end
    }

    /// A pair, with its reference unless that has come with `frame` before.
    pub(crate) fn step(&self, index: usize, frame: Option<usize>) -> Step<'a> {
        let (of, nth) = self.pairs[index];
        let found = &self.view.frames[of];
        let (method, test) = found.tests[nth];
        Step { frame: of, found, reference: frame != Some(of), method, test }
    }

    /// All that is to be scored, behind `frame`, with their places.
    pub(crate) fn steps(&self, mut frame: Option<usize>) -> Vec<(usize, Step<'a>)> {
        let step = |&index: &usize| {
            let step = self.step(index, frame);
            frame = Some(step.frame);
            (index, step)
        };
        self.todo.iter().map(step).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::found_frame::{FoundFrame, GuideFrames};
    use crate::view_sources::ViewSources;

    /// Three frames, of which the second has one test.
    fn view() -> FoundView {
        let frame = |number: usize, methods: &[usize]| FoundFrame {
            number: number as i64,
            position: number,
            reference: number,
            guides: GuideFrames::default(),
            tests: methods.iter().map(|method| (*method, number)).collect(),
        };
        let frames = vec![frame(0, &[0, 1]), frame(1, &[1]), frame(2, &[0, 1])];
        FoundView {
            scene: 0,
            eye: 0,
            sources: ViewSources::empty(),
            frames,
            fps: None,
            trace: None,
            passed_over: 0,
            remarks: Vec::new(),
        }
    }

    #[test]
    fn each_frame_brings_its_reference_once() {
        let view = view();
        let work = Work::new(&view, 0..5, &BTreeMap::new());
        let brings = |steps: Vec<(usize, Step<'_>)>| -> Vec<bool> {
            steps.iter().map(|(_, step)| step.reference).collect()
        };
        assert_eq!(brings(work.steps(None)), [true, false, true, true, false]);
        // From within a frame that is there already, and from one that is not.
        let work = Work::new(&view, 4..5, &BTreeMap::new());
        assert_eq!(brings(work.steps(Some(2))), [false]);
        assert_eq!(brings(work.steps(Some(1))), [true]);
        assert_eq!((work.first(), work.before(4, 1), work.is_of(0)), (4, vec![1, 2], false));
        assert_eq!(Work::new(&view, 2..2, &BTreeMap::new()).first(), 2);
    }
}
