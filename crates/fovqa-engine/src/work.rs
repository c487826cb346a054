//! Which pairs of a view are to be scored, and which come before them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::findings::Outcome;
use crate::found::FoundView;
use crate::load::Step;

/// A view's pairs, and the indices of those to be scored.
pub(crate) struct Work<'a> {
    view: &'a FoundView,
    /// For each frame, the index of its first pair.
    first_pairs: Vec<usize>,
    range: Range<usize>,
    /// Indices of the pairs to be scored, in order.
    pub(crate) todo: Vec<usize>,
    /// Methods of the pairs to be scored.
    of: BTreeSet<usize>,
}

impl<'a> Work<'a> {
    /// Selects the pairs in `range` that are not known yet.
    pub(crate) fn new(
        view: &'a FoundView,
        range: Range<usize>,
        known: &BTreeMap<usize, Box<Outcome>>,
    ) -> Self {
        let mut next = 0;
        let first_pairs = view.frames.iter().map(|frame| {
            next += frame.tests.len();
            next - frame.tests.len()
        });
        let first_pairs = first_pairs.collect();
        let todo: Vec<usize> = range.clone().filter(|index| !known.contains_key(index)).collect();
        let mut work = Self { view, first_pairs, range, todo, of: BTreeSet::new() };
        work.of = work.todo.iter().map(|index| work.method(*index)).collect();
        work
    }

    /// The first pair to be scored; if there is none, the end of the range.
    pub(crate) fn first(&self) -> usize {
        self.todo.first().copied().unwrap_or(self.range.end)
    }

    /// The index of a pair's frame, and its index among the tests of that frame.
    fn place(&self, index: usize) -> (usize, usize) {
        let frame = self.first_pairs.partition_point(|first| *first <= index) - 1;
        (frame, index - self.first_pairs[frame])
    }

    /// The index of a pair's method.
    pub(crate) fn method(&self, index: usize) -> usize {
        let (frame, nth) = self.place(index);
        self.view.frames[frame].tests[nth].0
    }

    /// The methods of the pairs in the range.
    pub(crate) fn methods(&self) -> BTreeSet<usize> {
        self.range.clone().map(|index| self.method(index)).collect()
    }

    /// Whether any pair of a method is to be scored.
    pub(crate) fn is_of(&self, method: usize) -> bool {
        self.of.contains(&method)
    }

    /// The pairs of a method before the pair `end`.
    pub(crate) fn before(&self, end: usize, method: usize) -> Vec<usize> {
        (0..end).filter(|index| self.method(*index) == method).collect()
    }

    /// The index after the last pair of the range.
    pub(crate) fn end(&self) -> usize {
        self.range.end
    }

    /// The step for a pair. It loads the reference unless the reference was already loaded with
    /// `frame`.
    pub(crate) fn step(&self, index: usize, frame: Option<usize>) -> Step<'a> {
        let (of, nth) = self.place(index);
        let found = &self.view.frames[of];
        let (method, test) = found.tests[nth];
        Step { frame: of, found, reference: frame != Some(of), method, test }
    }

    /// The step for the pair at a position in `todo`. The first pair continues after `frame`. Steps are
    /// made when they are needed, because a long sequence has very many.
    pub(crate) fn nth_step(&self, nth: usize, frame: Option<usize>) -> Step<'a> {
        let frame = if nth == 0 { frame } else { Some(self.place(self.todo[nth - 1]).0) };
        self.step(self.todo[nth], frame)
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
        let brings = |work: &Work<'_>, frame| -> Vec<bool> {
            (0..work.todo.len()).map(|nth| work.nth_step(nth, frame).reference).collect()
        };
        assert_eq!(brings(&work, None), [true, false, true, true, false]);
        let methods: Vec<_> = (0..5).map(|index| (work.place(index), work.method(index))).collect();
        let wanted = [((0, 0), 0), ((0, 1), 1), ((1, 0), 1), ((2, 0), 0), ((2, 1), 1)];
        assert_eq!(methods, wanted);
        // The steps begin inside a frame that is loaded already, and inside one that is not.
        let work = Work::new(&view, 4..5, &BTreeMap::new());
        assert_eq!(brings(&work, Some(2)), [false]);
        assert_eq!(brings(&work, Some(1)), [true]);
        assert_eq!((work.first(), work.before(4, 1), work.is_of(0)), (4, vec![1, 2], false));
        assert_eq!(Work::new(&view, 2..2, &BTreeMap::new()).first(), 2);
    }
}
