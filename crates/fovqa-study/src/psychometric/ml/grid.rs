//! A grid of parameters, from whose best points the maximum is polished.
//!
//! Logarithms of probabilities are computed once for all bootstrap replicates, which differ in the
//! numbers of correct answers alone.

use super::super::levels::Trials;
use super::super::model::{Curve, Model};
use super::likelihood::{Bounds, log_outcomes};

/// Grid points along m.
const POSITIONS: usize = 61;
/// Grid points along w, equally spaced in ln w.
const WIDTHS: usize = 41;
/// Grid points along λ.
const LAPSES: usize = 7;
/// λ of one position and width, padded to whole vectors.
const LANES: usize = 8;
/// Levels in excess of this many are pooled for the grid; the maximum is polished with all of them.
const MOST_LEVELS: usize = 100;
/// How many of the highest local maxima are polished.
const STARTS: usize = 3;

/// The tabulated grid.
#[derive(Debug)]
pub(super) struct Grid {
    positions: Vec<f64>,
    widths: Vec<f64>,
    lapses: Vec<f64>,
    /// Per level of the table: the level of the grid, if there are too many for the grid.
    parts: Option<Vec<usize>>,
    /// The number of levels of the grid.
    levels: usize,
    /// Per cell (position, width), level and lapse: ln ψ - ln(1-ψ).
    log_odds: Vec<[f64; LANES]>,
    /// Per cell and lapse: Σ n ln(1-ψ).
    all_wrong: Vec<[f64; LANES]>,
}

/// `count` values from the lower to the upper bound; one if they are equal.
fn spaced(bounds: [f64; 2], count: usize) -> Vec<f64> {
    if bounds[1] <= bounds[0] {
        return vec![bounds[0]];
    }
    let step = (bounds[1] - bounds[0]) / (count - 1) as f64;
    let mut values: Vec<f64> = (0..count).map(|i| bounds[0] + step * i as f64).collect();
    values[count - 1] = bounds[1];
    values
}

impl Grid {
    /// The grid of the bounds, for the levels and numbers of trials of `trials`.
    pub(super) fn new(model: &Model, trials: &Trials, bounds: &Bounds) -> Self {
        let positions = spaced(bounds.position, POSITIONS);
        let mut widths: Vec<f64> =
            spaced(bounds.width.map(libm::log), WIDTHS).into_iter().map(libm::exp).collect();
        widths[0] = bounds.width[0];
        if let Some(last) = widths.last_mut() {
            *last = bounds.width[1];
        }
        let lapses = spaced(bounds.lapse, LAPSES);
        let parts = trials.parts(MOST_LEVELS);
        let pooled = parts.as_ref().map(|parts| pooled(trials, parts));
        let trials = pooled.as_ref().unwrap_or(trials);
        let cells = positions.len() * widths.len();
        let mut log_odds = Vec::with_capacity(cells * trials.x.len());
        let mut all_wrong = Vec::with_capacity(cells);
        for &position in &positions {
            for &width in &widths {
                let mut none = [f64::NEG_INFINITY; LANES];
                none[..lapses.len()].fill(0.0);
                for (x, _, count) in trials.iter() {
                    let mut odds = [0.0; LANES];
                    for (lane, &lapse) in lapses.iter().enumerate() {
                        let curve = Curve { position, width, lapse };
                        let (right, wrong) = log_outcomes(model, &curve, x);
                        odds[lane] = right - wrong;
                        none[lane] += count * wrong;
                    }
                    log_odds.push(odds);
                }
                all_wrong.push(none);
            }
        }
        let levels = trials.x.len();
        Self { positions, widths, lapses, parts, levels, log_odds, all_wrong }
    }

    /// The highest local maxima of the grid for these numbers of correct answers, best first.
    pub(super) fn best(&self, correct: &[f64]) -> Vec<Curve> {
        let summed = self.parts.as_ref().map(|parts| sums(correct, parts, self.levels));
        let correct = summed.as_deref().unwrap_or(correct);
        let profile: Vec<(f64, usize)> = (0..self.all_wrong.len())
            .map(|cell| {
                let mut sums = self.all_wrong[cell];
                let levels = &self.log_odds[cell * correct.len()..(cell + 1) * correct.len()];
                for (odds, &correct) in levels.iter().zip(correct) {
                    for (sum, odds) in sums.iter_mut().zip(odds) {
                        *sum += correct * odds;
                    }
                }
                highest(&sums)
            })
            .collect();
        let mut maxima: Vec<usize> =
            (0..profile.len()).filter(|&cell| self.is_local_maximum(&profile, cell)).collect();
        maxima.sort_by(|&a, &b| profile[b].0.total_cmp(&profile[a].0));
        maxima.truncate(STARTS);
        let curve = |cell: usize| Curve {
            position: self.positions[cell / self.widths.len()],
            width: self.widths[cell % self.widths.len()],
            lapse: self.lapses[profile[cell].1],
        };
        maxima.into_iter().map(curve).collect()
    }

    fn is_local_maximum(&self, profile: &[(f64, usize)], cell: usize) -> bool {
        let (row, column) = (cell / self.widths.len(), cell % self.widths.len());
        let rows = row.saturating_sub(1)..=(row + 1).min(self.positions.len() - 1);
        let columns = column.saturating_sub(1)..=(column + 1).min(self.widths.len() - 1);
        rows.flat_map(|r| columns.clone().map(move |c| r * self.widths.len() + c))
            .all(|other| profile[other].0 <= profile[cell].0)
    }
}

/// The trials of each part of the span, at the mean of its levels. Parts without levels have none.
fn pooled(trials: &Trials, parts: &[usize]) -> Trials {
    let of = |values: &[f64]| sums(values, parts, MOST_LEVELS);
    let counts = of(&vec![1.0; parts.len()]);
    let mean = |(sum, count): (f64, &f64)| if *count > 0.0 { sum / count } else { trials.x[0] };
    Trials {
        x: of(&trials.x).into_iter().zip(&counts).map(mean).collect(),
        correct: of(&trials.correct),
        trials: of(&trials.trials),
        repeats: vec![1.0; MOST_LEVELS],
    }
}

/// The sums of the values of each part.
fn sums(values: &[f64], parts: &[usize], count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for (value, &part) in values.iter().zip(parts) {
        sums[part] += value;
    }
    sums
}

/// The largest value and its index, the first of equal ones.
fn highest(values: &[f64; LANES]) -> (f64, usize) {
    let mut best = (values[0], 0);
    for (lane, &value) in values.iter().enumerate().skip(1) {
        if value > best.0 {
            best = (value, lane);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::super::super::levels::Level;
    use super::super::likelihood::log_likelihood;
    use super::*;

    #[test]
    fn the_best_point_is_the_best_of_all_points() {
        let level = |level, correct| Level { level, correct, trials: 20 };
        let levels = [level(1.0, 11), level(2.0, 14), level(3.0, 19), level(4.0, 20)];
        let model = Model::default();
        let trials = Trials::new(&levels, model.sigmoid);
        let bounds = Bounds::new(&trials.span().unwrap(), [0.0, 0.06]);
        let grid = Grid::new(&model, &trials, &bounds);
        let found = log_likelihood(&model, &trials, &grid.best(&trials.correct)[0]);
        for &position in &grid.positions {
            for &width in &grid.widths {
                for &lapse in &grid.lapses {
                    let curve = Curve { position, width, lapse };
                    assert!(log_likelihood(&model, &trials, &curve) <= found + 1e-9);
                }
            }
        }
        let ends = (grid.positions[0], grid.positions[60], grid.widths[0], grid.widths[40]);
        assert_eq!(ends, (-0.5, 5.5, 1.0, 9.0));
    }
}
