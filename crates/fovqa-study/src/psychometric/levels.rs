//! The trials of a psychometric function, pooled by level.

use serde::Serialize;

use crate::options::Sigmoid;

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
}

impl Trials {
    /// The trials of pooled levels, for a sigmoid.
    pub(crate) fn new(levels: &[Level], sigmoid: Sigmoid) -> Self {
        Self {
            x: levels.iter().map(|level| sigmoid.scale(level.level)).collect(),
            correct: levels.iter().map(|level| level.correct as f64).collect(),
            trials: levels.iter().map(|level| level.trials as f64).collect(),
        }
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
        let usable = range.is_finite() && gap > 0.0 && gap >= range * 1e-9 && range > 1e-150;
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
    fn the_span_needs_two_levels_and_finite_gaps() {
        let of = |levels: &[f64]| {
            let level = |&level| Level { level, correct: 1, trials: 2 };
            Trials::new(&levels.iter().map(level).collect::<Vec<_>>(), Sigmoid::Logistic).span()
        };
        assert_eq!(of(&[1.0]), None);
        assert_eq!(of(&[-1e308, 1e308]), None);
        assert_eq!(of(&[0.0, 1e-12, 1.0]), None);
        assert_eq!(
            of(&[1.0, 2.0, 4.0]),
            Some(Span { first: 1.0, last: 4.0, range: 3.0, gap: 1.0 })
        );
    }
}
