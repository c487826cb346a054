//! The region of the parameters in which the posterior is not negligible.

use super::super::model::Curve;
use super::target::{Parameters, Region, Target};

/// Points whose density is smaller than the highest one by more than exp(-30) are left out.
const DEPTH: f64 = 30.0;
/// Points along m, w, λ and η of one pass.
const POINTS: [usize; 4] = [17, 15, 5, 4];
/// The most passes.
const MOST_PASSES: usize = 40;
/// A pass that leaves more than this share of every range is the last one.
const ENOUGH: f64 = 0.8;

/// The region around the mode outside of which the density is negligible. A coarse grid, to which the
/// mode is added, is narrowed until it fits.
pub(super) fn region(target: &Target<'_>, mode: &Parameters, density: f64) -> Region {
    let support = target.support();
    let mut limits = [support.position, support.width.map(libm::log), support.lapse, support.eta];
    let at = [mode.curve.position, libm::log(mode.curve.width), mode.curve.lapse, mode.eta];
    for _ in 0..MOST_PASSES {
        let axes = [0, 1, 2, 3].map(|axis| nodes(axis, limits[axis], at[axis]));
        let highest = profiles(target, &axes);
        let mut narrowed = false;
        for axis in 0..4 {
            let [low, high] = limits[axis];
            let next = kept(&axes[axis], &highest[axis], density - DEPTH);
            narrowed |= next[1] - next[0] < ENOUGH * (high - low);
            limits[axis] = next;
        }
        if !narrowed {
            break;
        }
    }
    let [position, log_width, lapse, eta] = limits;
    Region { position, width: log_width.map(libm::exp), lapse, eta }
}

/// Points along one axis, among them the mode. Those of λ and η are denser at the lower end.
fn nodes(axis: usize, [low, high]: [f64; 2], mode: f64) -> Vec<f64> {
    if low >= high {
        return vec![low];
    }
    let count = POINTS[axis];
    let share = |i: usize| {
        let t = i as f64 / (count - 1) as f64;
        if axis < 2 { t } else { t * t }
    };
    let mut nodes: Vec<f64> = (0..count).map(|i| low + (high - low) * share(i)).collect();
    nodes[count - 1] = high;
    nodes.push(mode.clamp(low, high));
    nodes.sort_by(f64::total_cmp);
    nodes.dedup();
    nodes
}

/// The highest logarithm of the density at each point of each axis.
fn profiles(target: &Target<'_>, axes: &[Vec<f64>; 4]) -> [Vec<f64>; 4] {
    let mut highest = [0, 1, 2, 3].map(|axis| vec![f64::NEG_INFINITY; axes[axis].len()]);
    for (i, &position) in axes[0].iter().enumerate() {
        for (j, log_width) in axes[1].iter().enumerate() {
            let width = libm::exp(*log_width);
            for (k, &lapse) in axes[2].iter().enumerate() {
                for (l, &eta) in axes[3].iter().enumerate() {
                    let curve = Curve { position, width, lapse };
                    let density = target.log_density(&Parameters { curve, eta });
                    for (profile, index) in highest.iter_mut().zip([i, j, k, l]) {
                        profile[index] = profile[index].max(density);
                    }
                }
            }
        }
    }
    highest
}

/// From the point before the first one that is high enough to the point after the last one.
fn kept(nodes: &[f64], highest: &[f64], least: f64) -> [f64; 2] {
    let enough = |&index: &usize| highest[index] >= least;
    let first = (0..nodes.len()).find(enough).unwrap_or(0);
    let last = (0..nodes.len()).rfind(enough).unwrap_or(nodes.len() - 1);
    [nodes[first.saturating_sub(1)], nodes[(last + 1).min(nodes.len() - 1)]]
}
