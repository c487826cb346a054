//! Units of work: what can be done by itself, here or elsewhere.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::found::{FoundInputs, FoundView};
use crate::share::{Shard, shares};

/// A unit of work: a stretch of the pairs of one sequence. The frames before it that its measures over time
/// have to have seen are read by whoever runs it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unit {
    /// Index of the scene in the plan.
    pub scene: usize,
    /// Index of the eye's view in it.
    pub eye: usize,
    /// Places among the pairs of the view: frame by frame, and of each frame method by method.
    pub pairs: Range<usize>,
}

impl Unit {
    /// The same in pieces of so many pairs at most.
    pub fn pieces(&self, most: usize) -> Vec<Unit> {
        let most = most.max(1);
        let starts = self.pairs.clone().step_by(most);
        let piece = |start: usize| Unit {
            pairs: start..(start + most).min(self.pairs.end),
            ..self.clone()
        };
        starts.map(piece).collect()
    }
}

/// The units of what was found, one a sequence, or those of a shard of it: all pairs of all views, one
/// behind the other, are cut into as many stretches as there are shards.
pub fn units(found: &FoundInputs, shard: Option<Shard>) -> Vec<Unit> {
    let pairs: Vec<usize> = found.views.iter().map(FoundView::pairs).collect();
    let units = found.views.iter().zip(shares(shard, &pairs));
    let units = units.map(|(view, pairs)| Unit { scene: view.scene, eye: view.eye, pairs });
    units.filter(|unit| !unit.pairs.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_together_what_was_cut() {
        let unit = Unit { scene: 1, eye: 0, pairs: 3..10 };
        let pieces: Vec<_> = unit.pieces(3).into_iter().map(|piece| piece.pairs).collect();
        assert_eq!(pieces, [3..6, 6..9, 9..10]);
        assert_eq!(unit.pieces(0).len(), 7);
        assert_eq!(unit.pieces(100), [unit]);
    }
}
