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
    /// Index distance to the farthest corner of a cell, plus one.
    const REACH: usize = NODES * NODES + NODES + 2;
    let n = out.len();
    let (corner, rho, ecc, y) = (&corner[..n], &rho[..n], &ecc[..n], &y[..n]);
    for x in 0..n {
        let from = corner[x] as usize;
        let c = &table[from..from + REACH];
        let along_y = |at: usize| c[at] + (c[at + 1] - c[at]) * y[x];
        let along_ecc = |at: usize| {
            let (from, to) = (along_y(at), along_y(at + NODES));
            from + (to - from) * ecc[x]
        };
        let (from, to) = (along_ecc(0), along_ecc(NODES * NODES));
        out[x] = from + (to - from) * rho[x];
    }
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
