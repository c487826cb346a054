//! Contrast sensitivity: for each temporal channel, a table over luminance, spatial frequency and
//! eccentricity, which is interpolated.
//!
//! The tables are those of FovVideoVDP 1.2 as the ColorVideoVDP project distributes them, under the
//! MIT licence in `csf/LICENSE.ColorVideoVDP.MIT`: log2 S at 32 x 32 x 32 nodes, luminance Y =
//! 10^(-3 + 7i/31) cd/m², frequency ρ = 2^(-4 + 10i/31) cpd, eccentricity (sqrt(120) i/31)²
//! degrees. Values between the nodes are interpolated trilinearly in (log2 ρ, log2 Y, sqrt ecc).
//! This interpolation is part of the metric: evaluating the closed formula behind the tables
//! instead changes results by up to 0.013 JOD.
//!
//! Coordinates run from 0 to 31 along each axis; outside this range the value at the end applies.

use std::sync::LazyLock;

use multiversion::multiversion;

use super::calibration::SENSITIVITY_DB;
use crate::log_exp::{log2, rounded_index};

/// The number of nodes along each axis.
pub(super) const NODES: usize = 32;
/// The number of nodes of a channel's table.
const TABLE: usize = NODES * NODES * NODES;
const LAST_CELL: f32 = (NODES - 2) as f32;
const LAST: f32 = (NODES - 1) as f32;

/// Steps between the nodes of ρ per octave.
pub(super) const RHO_STEPS_PER_OCTAVE: f64 = 3.1;
/// log2 ρ of the first node.
pub(super) const RHO_FROM: f64 = -4.0;
/// Steps between the nodes of Y per octave: 31 / 7 per decade.
const Y_STEPS_PER_OCTAVE: f64 = 31.0 / 7.0 * std::f64::consts::LOG10_2;
/// The coordinate of 1 cd/m².
const Y_OF_ONE: f64 = 3.0 * 31.0 / 7.0;
/// Steps between the nodes of the square root of eccentricity, per square root of a degree: 31 /
/// sqrt(120).
pub(super) const ECC_STEPS: f64 = 2.829_899_880_443;

const FILES: [&[u8]; 2] =
    [include_bytes!("csf/sustained.f32le"), include_bytes!("csf/transient.f32le")];

/// log2 of the corrected sensitivity, one table per channel, `[ρ][ecc][Y]`. The two neighbours in Y
/// are adjacent in memory, because Y changes from pixel to pixel.
static TABLES: LazyLock<[Box<[f32]>; 2]> = LazyLock::new(|| {
    let correction = SENSITIVITY_DB / 20.0 * std::f64::consts::LOG2_10;
    FILES.map(|file| {
        let mut table = vec![0.0; TABLE].into_boxed_slice();
        for (index, bytes) in file.as_chunks::<4>().0.iter().enumerate() {
            let (y, rho, ecc) = (index / (NODES * NODES), index / NODES % NODES, index % NODES);
            let value = f64::from(f32::from_le_bytes(*bytes)) + correction;
            table[(rho * NODES + ecc) * NODES + y] = value as f32;
        }
        table
    })
});

/// The table coordinates of the pixels of a row, along the axes that depend on the view.
#[derive(Debug, Clone, Default)]
pub(super) struct Coordinates {
    /// Coordinates along ρ.
    pub(super) rho: Vec<f32>,
    /// Coordinates along eccentricity.
    pub(super) ecc: Vec<f32>,
}

/// The table cells in which the pixels of a row lie.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    /// Index of the cell's first corner.
    corner: Vec<u32>,
    /// Positions within the cell along ρ, ecc and Y, from 0 to 1.
    rho: Vec<f32>,
    ecc: Vec<f32>,
    y: Vec<f32>,
}

impl Cells {
    pub(super) fn new(columns: usize) -> Self {
        let row = || vec![0.0; columns];
        Self { corner: vec![0; columns], rho: row(), ecc: row(), y: row() }
    }

    /// Finds the cells of a row from log2 of its luminance.
    pub(super) fn find(&mut self, log2_luminance: &[f32], at: &Coordinates) {
        let Self { corner, rho, ecc, y } = self;
        find_cells(log2_luminance, [&at.rho, &at.ecc], corner, [rho, ecc, y]);
    }

    /// log2 of the sensitivity of a channel at each pixel.
    pub(super) fn log2_sensitivity(&self, channel: usize, out: &mut [f32]) {
        trilinear(&TABLES[channel], &self.corner, [&self.rho, &self.ecc, &self.y], out);
    }
}

#[inline(always)]
fn cell(coordinate: f32) -> (u32, f32) {
    let kept = coordinate.clamp(0.0, LAST);
    // Half a step is subtracted, so that the nearest whole number is the one below.
    let index = rounded_index((kept - 0.5).clamp(0.0, LAST_CELL));
    (index, kept - index as i32 as f32)
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn find_cells(
    log2_luminance: &[f32],
    [at_rho, at_ecc]: [&[f32]; 2],
    corner: &mut [u32],
    [rho, ecc, y]: [&mut [f32]; 3],
) {
    let n = log2_luminance.len();
    let (at_rho, at_ecc, corner) = (&at_rho[..n], &at_ecc[..n], &mut corner[..n]);
    let (rho, ecc, y) = (&mut rho[..n], &mut ecc[..n], &mut y[..n]);
    for x in 0..n {
        let (i, f) = cell(at_rho[x]);
        let (j, g) = cell(at_ecc[x]);
        let (k, h) = cell(log2_luminance[x] * Y_STEPS_PER_OCTAVE as f32 + Y_OF_ONE as f32);
        corner[x] = (i * NODES as u32 + j) * NODES as u32 + k;
        (rho[x], ecc[x], y[x]) = (f, g, h);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn trilinear(table: &[f32], corner: &[u32], [rho, ecc, y]: [&[f32]; 3], out: &mut [f32]) {
    let whole = out.len() / STRETCH * STRETCH;
    let stretches = corner.as_chunks().0.iter().zip(rho.as_chunks().0).zip(ecc.as_chunks().0);
    let stretches = stretches.zip(y.as_chunks().0).zip(out.as_chunks_mut().0);
    for ((((corner, rho), ecc), y), out) in stretches {
        interpolate_stretch(table, corner, [rho, ecc, y], out);
    }
    for x in whole..out.len() {
        out[x] = interpolate(table, corner[x], [rho[x], ecc[x], y[x]]);
    }
}

/// The number of pixels that are interpolated together: a vector of the widest kind.
const STRETCH: usize = 16;

/// The distances in a table from a cell's first corner to its lower corners in Y.
const CORNERS: [usize; 4] = [0, NODES, NODES * NODES, NODES * NODES + NODES];

/// Interpolates neighbours. Most of them lie in one cell, or in two cells that are adjacent in Y,
/// because rho and ecc change slowly along a row, as does the luminance of a low-pass. The nodes of
/// these cells are then loaded once for all pixels.
#[inline(always)]
fn interpolate_stretch(
    table: &[f32],
    corner: &[u32; STRETCH],
    [rho, ecc, y]: [&[f32; STRETCH]; 3],
    out: &mut [f32; STRETCH],
) {
    let (mut first, mut last) = (corner[0], corner[0]);
    for &corner in corner {
        first = first.min(corner);
        last = last.max(corner);
    }
    if last - first > 1 {
        for x in 0..STRETCH {
            out[x] = interpolate(table, corner[x], [rho[x], ecc[x], y[x]]);
        }
        return;
    }
    let (below, above) = (first as usize, last as usize);
    let [a, b, c, d] =
        CORNERS.map(|at| [table[below + at], table[below + at + 1], table[above + at + 1]]);
    for x in 0..STRETCH {
        let is_above = corner[x] != first;
        let near = between(along_y(a, is_above, y[x]), along_y(b, is_above, y[x]), ecc[x]);
        let far = between(along_y(c, is_above, y[x]), along_y(d, is_above, y[x]), ecc[x]);
        out[x] = between(near, far, rho[x]);
    }
}

/// Interpolates along Y between the first two of three nodes, or between the last two.
#[inline(always)]
fn along_y([low, middle, high]: [f32; 3], is_above: bool, y: f32) -> f32 {
    let (from, to) = if is_above { (middle, high) } else { (low, middle) };
    between(from, to, y)
}

/// Interpolates in a single cell.
#[inline(always)]
fn interpolate(table: &[f32], corner: u32, [rho, ecc, y]: [f32; 3]) -> f32 {
    /// Index distance to the farthest corner of a cell, plus one.
    const REACH: usize = NODES * NODES + NODES + 2;
    let c = &table[corner as usize..][..REACH];
    let [a, b, d, e] = CORNERS;
    let near = between(between(c[a], c[a + 1], y), between(c[b], c[b + 1], y), ecc);
    let far = between(between(c[d], c[d + 1], y), between(c[e], c[e + 1], y), ecc);
    between(near, far, rho)
}

#[inline(always)]
fn between(from: f32, to: f32, weight: f32) -> f32 {
    from + (to - from) * weight
}

/// The sensitivity of a band for which frequency and eccentricity are the same at all pixels: a
/// line over luminance for each channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line([[f32; NODES]; 2]);

impl Line {
    /// The line for foveal vision at a frequency.
    pub(super) fn foveal(rho_cpd: f64) -> Self {
        let coordinate = (libm::log2(rho_cpd) - RHO_FROM) * RHO_STEPS_PER_OCTAVE;
        let (index, fraction) = cell(coordinate as f32);
        Self([0, 1].map(|channel| {
            let node = |rho: usize, y: usize| TABLES[channel][rho * NODES * NODES + y];
            std::array::from_fn(|y| {
                let (from, to) = (node(index as usize, y), node(index as usize + 1, y));
                from + (to - from) * fraction
            })
        }))
    }

    /// log2 of the sensitivity of a channel at each pixel, from log2 of its luminance.
    pub(super) fn log2_sensitivity(&self, channel: usize, log2_luminance: &[f32], out: &mut [f32]) {
        linear(&self.0[channel], log2_luminance, out);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn linear(line: &[f32; NODES], log2_luminance: &[f32], out: &mut [f32]) {
    for (out, log2_luminance) in out.iter_mut().zip(log2_luminance) {
        let (index, fraction) = cell(log2_luminance * Y_STEPS_PER_OCTAVE as f32 + Y_OF_ONE as f32);
        // An index of five bits needs no check in a table of 32, and the cell index 31 never
        // occurs.
        let from = line[index as usize % NODES];
        let to = line[(index as usize + 1) % NODES];
        *out = from + (to - from) * fraction;
    }
}

/// The sensitivity of a channel at a frequency, a luminance and an eccentricity, including the
/// correction of the calibration.
pub fn sensitivity(channel: usize, rho_cpd: f64, luminance_cd_m2: f64, ecc_deg: f64) -> f64 {
    let at = Coordinates {
        rho: vec![((libm::log2(rho_cpd) - RHO_FROM) * RHO_STEPS_PER_OCTAVE) as f32],
        ecc: vec![(ecc_deg.sqrt() * ECC_STEPS) as f32],
    };
    let (mut cells, mut out) = (Cells::new(1), [0.0]);
    cells.find(&[log2(luminance_cd_m2 as f32)], &at);
    cells.log2_sensitivity(channel, &mut out);
    libm::exp2(f64::from(out[0]))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "neighbours must not change a value")]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_the_same_alone_and_beside_others() {
        const PIXELS: usize = 5 * STRETCH + 3;
        // A stretch in one cell, in two cells in Y, in three, and at both ends of the table; the
        // last one crosses cells of rho.
        let corner = |x: usize| match x / STRETCH {
            0 => 4321,
            1 => 4321 + x as u32 % 2,
            2 => 4321 + x as u32 % 3,
            3 => 0,
            _ => (30 * NODES as u32 + 30) * NODES as u32 + 30 - (x as u32 % 2) * 1024,
        };
        let part = |x: usize, step: usize| (x * step % 97) as f32 / 96.0;
        let corners: Vec<u32> = (0..PIXELS).map(corner).collect();
        let [rho, ecc, y] =
            [31, 53, 71].map(|step| (0..PIXELS).map(|x| part(x, step)).collect::<Vec<f32>>());
        for table in &*TABLES {
            let mut together = vec![0.0; PIXELS];
            trilinear(table, &corners, [&rho, &ecc, &y], &mut together);
            for x in 0..PIXELS {
                assert_eq!(together[x], interpolate(table, corners[x], [rho[x], ecc[x], y[x]]));
            }
        }
    }
}
