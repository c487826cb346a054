//! The trials of a psychometric function, pooled by level.

use serde::Serialize;

use crate::options::Sigmoid;

/// The fewest parts of the span in which levels are condensed.
const FEWEST_PARTS: usize = 40;

/// The trials at one level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Level {
    /// The level of the stimulus, in the unit of the table.
    pub level: f64,
    /// The number of correct answers.
    pub correct: u64,
    /// The number of trials.
    pub trials: u64,
}

/// Adds up the trials of equal levels. Levels ascend; those without trials are left out.
pub fn pool(rows: impl IntoIterator<Item = Level>) -> Vec<Level> {
    let mut rows: Vec<Level> = rows.into_iter().filter(|row| row.trials > 0).collect();
    // Zero has one sign only.
    for row in &mut rows {
        row.level += 0.0;
    }
    rows.sort_by(|a, b| a.level.total_cmp(&b.level));
    let mut pooled: Vec<Level> = Vec::new();
    for row in rows {
        match pooled.last_mut() {
            Some(last) if last.level.total_cmp(&row.level).is_eq() => {
                last.correct = last.correct.saturating_add(row.correct);
                last.trials = last.trials.saturating_add(row.trials);
            }
            _ => pooled.push(row),
        }
    }
    pooled
}

/// Trials on the scale of the fit, with the span and the least gap of their levels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trials {
    /// x, ascending: levels, or their logarithms.
    pub(crate) x: Vec<f64>,
    /// Correct answers at each x.
    pub(crate) correct: Vec<f64>,
    /// Trials at each x.
    pub(crate) trials: Vec<f64>,
    /// How many levels of the table each x stands for: 1, but for condensed trials.
    pub(crate) repeats: Vec<f64>,
}

impl Trials {
    /// The trials of pooled levels, for a sigmoid.
    pub(crate) fn new(levels: &[Level], sigmoid: Sigmoid) -> Self {
        Self {
            x: levels.iter().map(|level| sigmoid.scale(level.level)).collect(),
            correct: levels.iter().map(|level| level.correct as f64).collect(),
            trials: levels.iter().map(|level| level.trials as f64).collect(),
            repeats: vec![1.0; levels.len()],
        }
    }

    /// The part of the span to which each level belongs, if there are more than `most` levels. The span
    /// has `most` parts of equal width.
    pub(crate) fn parts(&self, most: usize) -> Option<Vec<usize>> {
        let span = self.span().filter(|_| self.x.len() > most)?;
        let part = |x: &f64| {
            let share = (x - span.first) / span.range;
            ((share * most as f64) as usize).min(most - 1)
        };
        Some(self.x.iter().map(part).collect())
    }

    /// The same with at most `most` levels, or little more. Levels with equal counts that lie near to
    /// each other become one level at their mean, which is repeated: the blocks of trials remain.
    pub(crate) fn condensed(&self, most: usize) -> Self {
        let mut parts = most;
        while let Some(of) = self.parts(parts).filter(|_| self.x.len() > most) {
            let condensed = self.pooled_by_counts(&of);
            if condensed.x.len() <= most || parts <= FEWEST_PARTS {
                return condensed;
            }
            parts = (parts / 2).max(FEWEST_PARTS);
        }
        self.clone()
    }

    fn pooled_by_counts(&self, parts: &[usize]) -> Self {
        let mut order: Vec<usize> = (0..self.x.len()).collect();
        let key = |i: usize| (parts[i], self.trials[i] as u64, self.correct[i] as u64);
        order.sort_by_key(|&i| key(i));
        let mut out =
            Self { x: Vec::new(), correct: Vec::new(), trials: Vec::new(), repeats: Vec::new() };
        for run in order.chunk_by(|&a, &b| key(a) == key(b)) {
            let count = run.len() as f64;
            out.x.push(run.iter().map(|&i| self.x[i] / count).sum());
            out.correct.push(self.correct[run[0]]);
            out.trials.push(self.trials[run[0]]);
            out.repeats.push(count);
        }
        out
    }

    /// x, correct answers and trials of each level.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let counts = self.correct.iter().zip(&self.trials);
        self.x.iter().zip(counts).map(|(&x, (&correct, &trials))| (x, correct, trials))
    }

    /// The span of x, if it can be fitted: two or more levels with a finite range, and gaps that do
    /// not vanish beside it.
    pub(crate) fn span(&self) -> Option<Span> {
        let (&first, &last) = (self.x.first()?, self.x.last()?);
        let range = last - first;
        let gaps = self.x.windows(2).map(|pair| pair[1] - pair[0]);
        let gap = gaps.fold(f64::INFINITY, f64::min);
        let usable = range.is_finite() && gap > 0.0 && gap >= range * 1e-12 && range > 1e-150;
        (self.x.len() > 1 && usable).then_some(Span { first, last, range, gap })
    }
}

/// The span of the levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// The lowest x.
    pub(crate) first: f64,
    /// The highest x.
    pub(crate) last: f64,
    /// r: the distance between them.
    pub(crate) range: f64,
    /// g: the least distance of two neighbours.
    pub(crate) gap: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_levels_are_pooled_and_ascend() {
        let row = |level, correct, trials| Level { level, correct, trials };
        let pooled = pool([row(2.0, 1, 1), row(-0.0, 0, 1), row(2.0, 0, 1), row(0.0, 1, 3)]);
        assert_eq!(pooled, [row(0.0, 1, 4), row(2.0, 1, 2)]);
        assert_eq!(pool([row(1.0, 0, 0)]), []);
    }

    #[test]
    fn many_levels_are_condensed_without_losing_trials() {
        let level =
            |i: u32| Level { level: f64::from(i) * 0.01, correct: u64::from(i % 2), trials: 1 };
        let levels: Vec<Level> = (0..1000).map(level).collect();
        let trials = Trials::new(&levels, Sigmoid::Logistic);
        let condensed = trials.condensed(160);
        assert!((100..=160).contains(&condensed.x.len()), "{}", condensed.x.len());
        assert!((condensed.repeats.iter().sum::<f64>() - 1000.0).abs() < 1e-9);
        assert_eq!(trials.condensed(1000), trials);
    }

    #[test]
    fn the_span_needs_two_levels_and_finite_gaps() {
        let of = |levels: &[f64]| {
            let level = |&level| Level { level, correct: 1, trials: 2 };
            Trials::new(&levels.iter().map(level).collect::<Vec<_>>(), Sigmoid::Logistic).span()
        };
        assert_eq!(of(&[1.0]), None);
        assert_eq!(of(&[-1e308, 1e308]), None);
        assert_eq!(of(&[0.0, 1e-13, 1.0]), None);
        assert_eq!(
            of(&[1.0, 2.0, 4.0]),
            Some(Span { first: 1.0, last: 4.0, range: 3.0, gap: 1.0 })
        );
    }
}
