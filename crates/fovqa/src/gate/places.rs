//! Where in a frame a loss is: the maps of the frame, compared with those of the last good build.

use fovqa_metrics::{MapInfo, MapScale};
use fovqa_results::{Compared, MapBlocks};

use crate::pictures::means;

/// How much is lost in each block of a frame: larger is worse, NaN where there is no value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Losses {
    columns: usize,
    rows: usize,
    /// Side of a block in pixels.
    block: usize,
    values: Vec<f64>,
}

impl Losses {
    /// The losses of a map; `None` if its record is damaged.
    pub(super) fn of(blocks: &MapBlocks, info: &MapInfo) -> Option<Self> {
        let (MapScale::Linear { none, most } | MapScale::Logarithmic { none, most }) = info.scale;
        let sign = if most > none { 1.0 } else { -1.0 };
        let values: Vec<f64> = means(blocks)?.into_iter().map(|mean| sign * mean).collect();
        let is_sound = blocks.columns > 0 && blocks.block > 0 && !values.is_empty();
        let MapBlocks { columns, rows, block, .. } = *blocks;
        is_sound.then_some(Self { columns, rows, block, values })
    }

    /// Whether the blocks of two frames are the same.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (self.columns, self.rows, self.block) == (other.columns, other.rows, other.block)
    }

    /// The place with the largest loss, in pixels, among those for which `is_allowed` holds: compared with
    /// the good frame if there is one, or else with the best of the frames beside it.
    pub(super) fn worst(
        &self,
        good: Option<&Self>,
        beside: &[Self],
        is_allowed: impl Fn([f64; 2]) -> bool + Copy,
    ) -> Option<([f64; 2], Compared)> {
        let good = good.filter(|good| self.is_like(good));
        let beside: Vec<&Self> = beside.iter().filter(|one| self.is_like(one)).collect();
        let (before, compared) = match good {
            Some(good) => (vec![good], Compared::Baseline),
            None if beside.is_empty() => (Vec::new(), Compared::Nothing),
            None => (beside, Compared::Neighbours),
        };
        let growth: Vec<f64> = self
            .values
            .iter()
            .enumerate()
            .map(|(at, now)| {
                let best = before.iter().map(|before| before.values[at]).reduce(f64::min);
                now - best.unwrap_or(0.0)
            })
            .collect();
        let mut worst: Option<(f64, [f64; 2])> = None;
        for at in 0..growth.len() {
            let (column, row) = (at % self.columns, at / self.columns);
            let place = [column, row].map(|index| (index as f64 + 0.5) * self.block as f64);
            let around = self.around(&growth, column, row);
            if around.is_finite()
                && is_allowed(place)
                && worst.is_none_or(|(most, _)| around > most)
            {
                worst = Some((around, place));
            }
        }
        match worst {
            Some((most, place)) if compared == Compared::Nothing || most > 0.0 => {
                Some((place, compared))
            }
            // What is nowhere worse than before is worst where it is worst by itself.
            Some(_) => self.worst(None, &[], is_allowed),
            None => None,
        }
    }

    /// The mean over 3 x 3 blocks: a single block may be an edge that has moved.
    fn around(&self, growth: &[f64], column: usize, row: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0_u32);
        for y in row.saturating_sub(1)..(row + 2).min(self.rows) {
            for x in column.saturating_sub(1)..(column + 2).min(self.columns) {
                let value = growth[y * self.columns + x];
                if !value.is_nan() {
                    sum += value;
                    count += 1;
                }
            }
        }
        if count == 0 { f64::NAN } else { sum / f64::from(count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn losses(values: &[f64]) -> Losses {
        Losses { columns: 6, rows: 4, block: 10, values: values.to_vec() }
    }

    #[test]
    fn a_place_is_where_the_loss_has_grown_and_not_where_it_is_large() {
        let mut before = vec![0.1; 24];
        before[0] = 9.0;
        let mut now = before.clone();
        now[2 * 6 + 4] = 0.6;
        let (good, beside) = (losses(&before), [losses(&before)]);
        let place = losses(&now).worst(Some(&good), &[], |_| true);
        let ([x, y], compared) = place.unwrap();
        // The mean over nine blocks is the same around the block; the first of them counts.
        assert!((x - 45.0).abs() <= 10.0 && (y - 25.0).abs() <= 10.0, "{x} {y}");
        assert_eq!(compared, Compared::Baseline);
        let place = losses(&now).worst(None, &beside, |_| true);
        assert_eq!(place.unwrap().1, Compared::Neighbours);
        let (place, compared) = losses(&now).worst(None, &[], |_| true).unwrap();
        assert!(place[0] < 20.0 && place[1] < 20.0 && compared == Compared::Nothing);
        let (place, compared) = losses(&before).worst(Some(&good), &beside, |_| true).unwrap();
        assert!(place[0] < 20.0 && compared == Compared::Nothing, "nothing is worse than before");
        let (place, compared) = losses(&now).worst(Some(&good), &[], |[x, _]| x < 30.0).unwrap();
        assert!(place[0] < 30.0 && compared == Compared::Nothing, "only elsewhere");
    }

    #[test]
    fn a_frame_of_another_size_is_not_compared() {
        let now = losses(&[0.5; 24]);
        let other = Losses { columns: 4, rows: 6, block: 10, values: vec![0.0; 24] };
        assert_eq!(now.worst(Some(&other), &[], |_| true).unwrap().1, Compared::Nothing);
    }
}
