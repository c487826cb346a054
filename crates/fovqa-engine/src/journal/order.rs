//! The order of the lines in a journal. If a run was never interrupted, its lines are in the order of a
//! finished journal already, apart from the inputs: then their bytes are copied and not made again.

use std::collections::BTreeMap;
use std::ops::Range;

use fovqa_plan::{Eye, Plan};

use crate::findings::{Entry, ViewIndex};

/// The position of a line behind the inputs: the view, the kind of line and the step.
type Position = (ViewIndex, Kind, usize);

/// The kinds of lines of a view, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Before,
    Pair,
    Failed,
    Settled,
}

/// The lines of a journal so far.
#[derive(Debug)]
pub(super) struct Order {
    views: BTreeMap<(String, Option<Eye>), ViewIndex>,
    length: u64,
    last: Option<Position>,
    pairs: usize,
    /// The bytes of all lines behind the inputs; `None` once a line is out of order.
    ranges: Option<Vec<Range<u64>>>,
}

impl Order {
    /// The order of a journal of which only the first line is written.
    pub(super) fn new(plan: &Plan, first_line: usize) -> Self {
        let scenes = plan.scenes.iter().enumerate();
        let views = scenes.flat_map(|(index, scene)| {
            let eyes = scene.eyes.iter().enumerate();
            eyes.map(move |(eye, view)| ((scene.name.clone(), view.eye), (index, eye)))
        });
        Self {
            views: views.collect(),
            length: first_line as u64,
            last: None,
            pairs: 0,
            ranges: Some(Vec::new()),
        }
    }

    /// Adds an entry that was written with so many bytes.
    pub(super) fn add(&mut self, entry: &Entry<'_>, bytes: usize) {
        let range = self.length..self.length + bytes as u64;
        self.length = range.end;
        let (scene, eye, kind, step) = match entry {
            // They are written first, in an order of their own.
            Entry::Problem(..) | Entry::Input(_) => return,
            Entry::Before(named, _) => (named.scene, named.eye, Kind::Before, 0),
            Entry::Pair(pair) => (pair.named.scene, pair.named.eye, Kind::Pair, pair.step),
            Entry::ViewFailed(scene, eye, _) => (*scene, *eye, Kind::Failed, 0),
            Entry::Settled(scene, eye, ..) => (*scene, *eye, Kind::Settled, 0),
        };
        let view = self.views.get(&(scene.to_owned(), eye)).copied();
        let position = view.map(|view| (view, kind, step));
        let is_next = match (self.last, position) {
            (_, None) => false,
            (None, _) => true,
            // A view that failed loses what was known of it.
            (Some((last, ..)), Some((view, Kind::Failed, _))) => last < view,
            (Some(last), Some(position)) => {
                last < position || (last == position && kind == Kind::Before)
            }
        };
        self.last = position;
        self.pairs += usize::from(kind == Kind::Pair);
        match &mut self.ranges {
            Some(ranges) if is_next => match ranges.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                _ => ranges.push(range),
            },
            ranges => *ranges = None,
        }
    }

    /// The bytes of all lines behind the inputs, if they are in order and are of so many pairs.
    pub(super) fn ranges_of(&self, pairs: usize) -> Option<&[Range<u64>]> {
        self.ranges.as_deref().filter(|_| self.pairs == pairs)
    }
}
