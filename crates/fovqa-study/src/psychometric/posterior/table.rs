//! Log-likelihoods of single levels, tabulated over z for all pairs of λ and η.
//!
//! The log-likelihood of a level depends on m and w through z alone. A table per level turns the
//! integral over four parameters into sums of interpolated rows.

use super::likelihood::{dispersion, level, normaliser};
use super::target::{Region, Target};

/// The interpolation error of a log-likelihood is about 3 n (distance of points)⁴.
const ERROR: f64 = 1e-3;
/// The fewest and the most points of a table.
const POINTS: [f64; 2] = [8.0, 400.0];

/// The nodes of λ and η.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Nuisance {
    /// λ.
    pub(super) lapses: Vec<f64>,
    /// η.
    pub(super) etas: Vec<f64>,
}

/// The log-likelihoods of one level.
#[derive(Debug)]
struct Table {
    x: f64,
    low: f64,
    points_per_z: f64,
    points: usize,
    /// Per point of z, then λ, then η: the log-likelihood, relative to the highest for that η.
    values: Vec<f32>,
}

/// The tables of all levels.
#[derive(Debug)]
pub(super) struct Tables {
    levels: Vec<Table>,
    sign: f64,
    row: usize,
    /// Per η: what was subtracted from the values.
    pub(super) offsets: Vec<f64>,
}

impl Tables {
    /// The tables for the z that occur in a region.
    pub(super) fn new(target: &Target<'_>, region: &Region, nuisance: &Nuisance) -> Self {
        let mut offsets = vec![0.0; nuisance.etas.len()];
        let sign = target.model.direction.sign();
        let levels = target
            .trials
            .iter()
            .zip(&target.trials.repeats)
            .map(|(level, &repeats)| {
                Table::new(target, region, nuisance, (level, repeats), &mut offsets)
            })
            .collect();
        let row = nuisance.lapses.len() * nuisance.etas.len();
        Self { levels, sign, row, offsets }
    }

    /// The log-likelihoods of all levels at m and w, per λ and η, without the offsets.
    pub(super) fn sum(&self, position: f64, width: f64, sums: &mut [f32]) {
        sums.fill(0.0);
        for table in &self.levels {
            let z = self.sign * (table.x - position) / width;
            let at = ((z - table.low) * table.points_per_z).clamp(0.0, (table.points - 1) as f64);
            let first = (at as usize).clamp(1, table.points - 3) - 1;
            let t = (at - (first + 1) as f64) as f32;
            // The cubic through four points.
            let (a, b, c) = (t + 1.0, t - 1.0, t - 2.0);
            let weights = [t * b * c / -6.0, a * b * c / 2.0, a * t * c / -2.0, a * t * b / 6.0];
            let rows = &table.values[first * self.row..(first + 4) * self.row];
            let (one, rest) = rows.split_at(self.row);
            let (two, rest) = rest.split_at(self.row);
            let (three, four) = rest.split_at(self.row);
            let points = one.iter().zip(two).zip(three).zip(four);
            for (sum, (((one, two), three), four)) in sums.iter_mut().zip(points) {
                *sum +=
                    weights[0] * one + weights[1] * two + weights[2] * three + weights[3] * four;
            }
        }
    }
}

impl Table {
    fn new(
        target: &Target<'_>,
        region: &Region,
        nuisance: &Nuisance,
        ((x, correct, trials), repeats): ((f64, f64, f64), f64),
        offsets: &mut [f64],
    ) -> Self {
        let model = target.model;
        let (least, most) = model.sigmoid.effective_range();
        let z = |position: f64, width: f64| {
            (model.direction.sign() * (x - position) / width).clamp(least, most)
        };
        let [left, right] = region.position;
        let corners = region.width.map(|width| [z(left, width), z(right, width)]);
        let all = corners.iter().flatten().copied();
        let (low, high) = all
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        let span = (high - low).max(1e-9);
        let distance = libm::sqrt(libm::sqrt(ERROR / (3.0 * trials * repeats)));
        let points = (span / distance).ceil().clamp(POINTS[0], POINTS[1]) as usize;
        let points_per_z = (points - 1) as f64 / span;
        let deltas: Vec<f64> = nuisance.etas.iter().map(|&eta| dispersion(eta)).collect();
        let mut exact = Vec::with_capacity(points * nuisance.lapses.len() * deltas.len());
        for index in 0..points {
            let point = model.sigmoid.at(low + index as f64 / points_per_z);
            for &lapse in &nuisance.lapses {
                let (right, wrong) = model.outcomes(point, lapse);
                let of = |&delta: &f64| level(correct, trials, right, wrong, delta);
                exact.extend(deltas.iter().map(|delta| repeats * of(delta)));
            }
        }
        let mut highest = vec![f64::NEG_INFINITY; deltas.len()];
        for row in exact.chunks_exact(deltas.len()) {
            highest.iter_mut().zip(row).for_each(|(high, value)| *high = high.max(*value));
        }
        for ((offset, high), &delta) in offsets.iter_mut().zip(&highest).zip(&deltas) {
            *offset += high - repeats * normaliser(trials, delta);
        }
        let relative = exact.iter().zip(highest.iter().cycle());
        let values = relative.map(|(value, high)| (value - high) as f32).collect();
        Self { x, low, points_per_z, points, values }
    }
}
