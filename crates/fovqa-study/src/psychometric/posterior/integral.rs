//! The integral of the posterior over a region.

use rayon::prelude::*;

use super::marginal::{Density, NodeMasses, bisect};
use super::quadrature::gauss_legendre;
use super::table::{Nuisance, Tables};
use super::target::{Region, Target};

/// The numbers of points along m, w, λ and η.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Resolution {
    pub(super) positions: usize,
    pub(super) widths: usize,
    pub(super) lapses: usize,
    pub(super) etas: usize,
}

/// To find where the posterior is.
const COARSE: Resolution = Resolution { positions: 61, widths: 51, lapses: 12, etas: 8 };
/// For the results.
const FINE: Resolution = Resolution { positions: 141, widths: 121, lapses: 20, etas: 12 };
/// Marginal densities below this share of the highest are left out.
const LEAST_MARGINAL: f64 = 1e-7;
/// The most coarse integrals.
const MOST_PASSES: usize = 6;
/// Widths are equally spaced, or their logarithms, if the largest one is more than this many times the
/// smallest one.
const LINEAR_WIDTHS: f64 = 200.0;
/// A coarse integral that leaves more than this share of every range is the last one.
const ENOUGH: f64 = 0.75;
/// Densities that are smaller than the highest by more than this factor's logarithm are left out.
const NEGLIGIBLE: f64 = 40.0;

/// The posterior on a grid.
#[derive(Debug)]
pub(super) struct Integral {
    positions: Vec<f64>,
    widths: Vec<f64>,
    /// Per m, w and λ: the density, integrated over η and weighted for λ.
    mass: Vec<f64>,
    /// The marginal of λ.
    pub(super) lapse: NodeMasses,
    /// The marginal of η.
    pub(super) eta: NodeMasses,
}

/// Nodes and weights of λ or η; one node if it is fixed.
fn rule(count: usize, [low, high]: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
    if low < high { gauss_legendre(count, low, high) } else { (vec![low], vec![1.0]) }
}

/// `count` equally spaced values.
fn spaced([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let step = (high - low) / (count - 1) as f64;
    (0..count).map(|i| low + step * i as f64).collect()
}

/// Widths over a range.
fn spaced_widths(range: [f64; 2], count: usize) -> Vec<f64> {
    if range[1] <= LINEAR_WIDTHS * range[0] {
        return spaced(range, count);
    }
    spaced(range.map(libm::log), count).into_iter().map(libm::exp).collect()
}

impl Integral {
    /// Integrates over the part of a region in which the marginals are not negligible. `highest` is the
    /// logarithm of the density at the mode.
    pub(super) fn new(target: &Target<'_>, mut region: Region, highest: f64) -> Self {
        for _ in 0..MOST_PASSES {
            let next = Self::over(target, &region, highest, COARSE).occupied(&region);
            let narrowed = narrowed(&region, &next);
            region = next;
            if !narrowed {
                break;
            }
        }
        Self::over(target, &region, highest, FINE)
    }

    /// Integrates over a region.
    fn over(target: &Target<'_>, region: &Region, highest: f64, resolution: Resolution) -> Self {
        let (lapses, lapse_weights) = rule(resolution.lapses, region.lapse);
        let (etas, eta_weights) = rule(resolution.etas, region.eta);
        let positions = spaced(region.position, resolution.positions);
        let widths = spaced_widths(region.width, resolution.widths);
        let nuisance = Nuisance { lapses, etas };
        let tables = Tables::new(target, region, &nuisance);
        let offsets = nuisance_logs(target, &nuisance, &tables.offsets, highest);
        let rows: Vec<Row> = positions
            .par_iter()
            .map(|&position| {
                let curve_logs: Vec<f64> =
                    widths.iter().map(|&width| target.curve_prior(position, width)).collect();
                let weights = (&lapse_weights[..], &eta_weights[..]);
                Row::new(&tables, position, &widths, &curve_logs, &offsets, weights)
            })
            .collect();
        let mut out = Self {
            lapse: NodeMasses {
                masses: vec![0.0; nuisance.lapses.len()],
                nodes: nuisance.lapses,
                weights: lapse_weights,
                low: region.lapse[0],
            },
            eta: NodeMasses {
                masses: vec![0.0; nuisance.etas.len()],
                nodes: nuisance.etas,
                weights: eta_weights,
                low: region.eta[0],
            },
            positions,
            widths,
            mass: Vec::new(),
        };
        out.add_up(&rows);
        out
    }

    /// The part of the region in which the marginal densities are not negligible.
    fn occupied(&self, region: &Region) -> Region {
        Region {
            position: self.position().occupied(LEAST_MARGINAL).unwrap_or(region.position),
            width: self.width().occupied(LEAST_MARGINAL).unwrap_or(region.width),
            lapse: self.lapse.occupied(LEAST_MARGINAL, region.lapse),
            eta: self.eta.occupied(LEAST_MARGINAL, region.eta),
        }
    }

    fn add_up(&mut self, rows: &[Row]) {
        let steps = trapezoid(&self.widths);
        for (index, row) in rows.iter().enumerate() {
            // The trapezoid rule along m has half steps at its ends.
            let end = index == 0 || index + 1 == rows.len();
            let share = if end { 0.5 } else { 1.0 };
            let etas = self.eta.masses.len();
            for (cell, step) in steps.iter().enumerate() {
                let part = &row.eta_mass[cell * etas..(cell + 1) * etas];
                for (sum, mass) in self.eta.masses.iter_mut().zip(part) {
                    *sum += share * step * mass;
                }
                let lapses = self.lapse.masses.len();
                let part = &row.lapse_mass[cell * lapses..(cell + 1) * lapses];
                for (sum, mass) in self.lapse.masses.iter_mut().zip(part) {
                    *sum += share * step * mass;
                }
            }
            self.mass.extend_from_slice(&row.lapse_mass);
        }
    }

    /// The marginal of m.
    pub(super) fn position(&self) -> Density {
        let steps = trapezoid(&self.widths);
        let lapses = self.lapse.nodes.len();
        let density = self
            .mass
            .chunks_exact(self.widths.len() * lapses)
            .map(|row| {
                row.chunks_exact(lapses)
                    .zip(&steps)
                    .map(|(l, step)| step * l.iter().sum::<f64>())
                    .sum()
            })
            .collect();
        Density::new(self.positions.clone(), density)
    }

    /// The marginal of w.
    pub(super) fn width(&self) -> Density {
        let lapses = self.lapse.nodes.len();
        let mut density = vec![0.0; self.widths.len()];
        for (index, cell) in self.mass.chunks_exact(lapses).enumerate() {
            let row = index / self.widths.len();
            let end = row == 0 || row + 1 == self.positions.len();
            let share = if end { 0.5 } else { 1.0 };
            density[index % self.widths.len()] += share * cell.iter().sum::<f64>();
        }
        Density::new(self.widths.clone(), density)
    }

    /// Quantiles of the x at which the performance is reached: the positions plus `shift` times the
    /// width, which depends on λ and is infinite where the performance is not reached.
    pub(super) fn shifted_quantiles(&self, shifts: &[f64], shares: [f64; 3]) -> [f64; 3] {
        let steps = trapezoid(&self.widths);
        let lapses = self.lapse.nodes.len();
        let stride = self.widths.len() * lapses;
        let mut columns = Vec::new();
        let (mut never_low, mut never_high) = (0.0, 0.0);
        for (w, (&width, step)) in self.widths.iter().zip(&steps).enumerate() {
            for (l, &shift) in shifts.iter().enumerate() {
                let values = self.mass.iter().skip(w * lapses + l).step_by(stride);
                let column =
                    Density::new(self.positions.clone(), values.map(|mass| mass * step).collect());
                if shift == f64::INFINITY {
                    never_high += column.mass();
                } else if shift == f64::NEG_INFINITY {
                    never_low += column.mass();
                } else {
                    columns.push((width * shift, column));
                }
            }
        }
        let reached: f64 = columns.iter().map(|(_, column)| column.mass()).sum();
        let total = never_low + reached + never_high;
        let ends = columns.iter().map(|(shift, _)| *shift);
        let (least, most) = ends.fold((0.0_f64, 0.0_f64), |(a, b), s| (a.min(s), b.max(s)));
        let low = self.positions[0] + least;
        let high = self.positions[self.positions.len() - 1] + most;
        shares.map(|share| {
            let wanted = share * total - never_low;
            if wanted <= 0.0 && never_low > 0.0 {
                return f64::NEG_INFINITY;
            }
            if wanted > reached {
                return f64::INFINITY;
            }
            let below = |x: f64| -> f64 {
                columns.iter().map(|(shift, column)| column.mass_below(x - shift)).sum()
            };
            bisect(low, high, |x| below(x) >= wanted)
        })
    }
}

/// True if a range has become clearly shorter.
fn narrowed(before: &Region, after: &Region) -> bool {
    let shorter =
        |before: [f64; 2], after: [f64; 2]| after[1] - after[0] < ENOUGH * (before[1] - before[0]);
    shorter(before.position, after.position)
        || shorter(before.width.map(libm::log), after.width.map(libm::log))
        || shorter(before.lapse, after.lapse)
        || shorter(before.eta, after.eta)
}

/// The weights of the trapezoid rule.
fn trapezoid(points: &[f64]) -> Vec<f64> {
    let last = points.len() - 1;
    let step = |i: usize| 0.5 * (points[(i + 1).min(last)] - points[i.saturating_sub(1)]);
    (0..points.len()).map(step).collect()
}

/// Per λ and η: the logarithm of their priors and of what the tables leave out, relative to the
/// density at the mode.
fn nuisance_logs(
    target: &Target<'_>,
    nuisance: &Nuisance,
    offsets: &[f64],
    highest: f64,
) -> Vec<f64> {
    let mut logs = Vec::new();
    for &lapse in &nuisance.lapses {
        for (&eta, offset) in nuisance.etas.iter().zip(offsets) {
            logs.push(target.nuisance_prior(lapse, eta) + offset - highest);
        }
    }
    logs
}

/// The masses at one position, for all widths.
struct Row {
    lapse_mass: Vec<f64>,
    eta_mass: Vec<f64>,
}

impl Row {
    fn new(
        tables: &Tables,
        position: f64,
        widths: &[f64],
        curve_logs: &[f64],
        offsets: &[f64],
        (lapse_weights, eta_weights): (&[f64], &[f64]),
    ) -> Self {
        let (lapses, etas) = (lapse_weights.len(), eta_weights.len());
        let mut lapse_mass = vec![0.0; widths.len() * lapses];
        let mut eta_mass = vec![0.0; widths.len() * etas];
        let mut sums = vec![0.0_f32; offsets.len()];
        for (w, (&width, &curve_log)) in widths.iter().zip(curve_logs).enumerate() {
            if curve_log == f64::NEG_INFINITY {
                continue;
            }
            tables.sum(position, width, &mut sums);
            let eta_part = &mut eta_mass[w * etas..(w + 1) * etas];
            for (l, &lapse_weight) in lapse_weights.iter().enumerate() {
                let mut sum = 0.0;
                for (e, &eta_weight) in eta_weights.iter().enumerate() {
                    let index = l * etas + e;
                    let log = f64::from(sums[index]) + offsets[index] + curve_log;
                    if log > -NEGLIGIBLE {
                        let mass = libm::exp(log) * lapse_weight * eta_weight;
                        eta_part[e] += mass;
                        sum += mass;
                    }
                }
                lapse_mass[w * lapses + l] = sum;
            }
        }
        Self { lapse_mass, eta_mass }
    }
}
