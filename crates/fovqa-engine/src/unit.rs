//! Units of work that can be scored independently, here or in another process.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::found::{FoundInputs, FoundView};
use crate::share::{Shard, shares};

/// A unit of work: a range of the pairs of one sequence. Temporal metrics also need frames before
/// the range, which are read again when the unit is run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unit {
    /// Index of the scene in the plan.
    pub scene: usize,
    /// Index of the eye's view in it.
    pub eye: usize,
    /// Indices among the pairs of the view. The pairs are ordered by frame, and within a frame by
    /// method.
    pub pairs: Range<usize>,
}

impl Unit {
    /// Splits the unit into pieces of at most `most` pairs.
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

/// The units of the frames that were found, one per sequence, or those of a shard: the pairs of all
/// views are put in one sequence, which is cut into as many ranges as there are shards.
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
