//! One row of the SSIM map from the rows around it.

use multiversion::multiversion;

/// Moments that are windowed: u, v, u², v².
pub(crate) const MOMENTS: usize = 4;

/// Radius of the standard window, for which the taps are unrolled.
const STANDARD_RADIUS: usize = 5;

/// The last rows of the moments, for each plane: `2 radius + 1` of them, a ring.
#[derive(Debug)]
pub(crate) struct Ring {
    values: Vec<f32>,
    stride: usize,
    slots: usize,
}

impl Ring {
    pub(crate) fn new(planes: usize, radius: usize, stride: usize) -> Self {
        let slots = 2 * radius + 1;
        Self { values: vec![0.0; planes * MOMENTS * slots * stride], stride, slots }
    }

    fn start(&self, plane: usize, moment: usize, y: usize) -> usize {
        ((plane * MOMENTS + moment) * self.slots + y % self.slots) * self.stride
    }

    /// Row `y` of a moment, which must be among the last ones pushed.
    pub(crate) fn row(&self, plane: usize, moment: usize, y: usize, length: usize) -> &[f32] {
        let start = self.start(plane, moment, y);
        &self.values[start..start + length]
    }

    /// Takes in row `y`: sum and difference of one plane; with `squares`, their squares too.
    pub(crate) fn push(&mut self, plane: usize, y: usize, u: &[f32], v: &[f32], squares: bool) {
        for (moment, row) in [u, v].into_iter().enumerate() {
            let start = self.start(plane, moment, y);
            self.values[start..start + row.len()].copy_from_slice(row);
            if squares {
                let start = self.start(plane, moment + 2, y);
                square(row, &mut self.values[start..start + row.len()]);
            }
        }
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn square(row: &[f32], out: &mut [f32]) {
    for (out, v) in out.iter_mut().zip(row) {
        *out = v * v;
    }
}

/// C1, C2 and the window for a signal of a given peak.
#[derive(Debug, Clone)]
pub(crate) struct Constants {
    pub(crate) c1: f32,
    pub(crate) c2: f32,
    pub(crate) peak: f32,
    pub(crate) taps: Vec<f32>,
}

impl Constants {
    pub(crate) fn new(params: &super::Params, peak: f32) -> Self {
        let squared = |k: f64| {
            let k = k * f64::from(peak);
            (k * k) as f32
        };
        Self { c1: squared(params.k1), c2: squared(params.k2), peak, taps: params.taps() }
    }

    pub(crate) fn radius(&self) -> usize {
        self.taps.len() - 1
    }
}

/// Room for the steps of one row.
#[derive(Debug)]
pub(crate) struct Scratch {
    columns: Vec<f32>,
    moments: [Vec<f32>; MOMENTS],
}

impl Scratch {
    pub(crate) fn new(stride: usize) -> Self {
        Self { columns: vec![0.0; stride], moments: std::array::from_fn(|_| vec![0.0; stride]) }
    }
}

/// A row of the map: SSIM, and its contrast-structure factor.
#[derive(Debug)]
pub(crate) struct MapRow<'a> {
    pub(crate) ssim: &'a mut [f32],
    pub(crate) contrast_structure: &'a mut [f32],
}

/// Computes the row of the map around row `y` of the ring for one plane. The ring's rows are
/// `2 radius` longer than the map's.
pub(crate) fn map_row(
    ring: &Ring,
    plane: usize,
    y: usize,
    constants: &Constants,
    scratch: &mut Scratch,
    out: MapRow<'_>,
) {
    let length = out.ssim.len() + 2 * constants.radius();
    for moment in 0..MOMENTS {
        let columns = &mut scratch.columns[..length];
        let windowed = &mut scratch.moments[moment][..out.ssim.len()];
        if let &[c0, c1, c2, c3, c4, c5] = constants.taps.as_slice() {
            let rows = std::array::from_fn(|k| {
                ring.row(plane, moment, y + k - STANDARD_RADIUS, length)
            });
            let taps = [c0, c1, c2, c3, c4, c5];
            vertical_standard(rows, taps, columns);
            horizontal_standard(columns, taps, windowed);
        } else {
            vertical(ring, plane, moment, y, &constants.taps, columns);
            horizontal(columns, &constants.taps, windowed);
        }
    }
    let moments = scratch.moments.each_ref().map(|m| &m[..out.ssim.len()]);
    quotients(moments, constants.c1, constants.c2, constants.peak, out.ssim, out.contrast_structure);
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn vertical_standard(rows: [&[f32]; 11], taps: [f32; 6], out: &mut [f32]) {
    let n = out.len();
    let rows = rows.map(|row| &row[..n]);
    for (x, out) in out.iter_mut().enumerate() {
        let mut sum = taps[0] * rows[5][x];
        for k in 1..6 {
            sum += taps[k] * (rows[5 - k][x] + rows[5 + k][x]);
        }
        *out = sum;
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn horizontal_standard(row: &[f32], taps: [f32; 6], out: &mut [f32]) {
    let n = out.len();
    let shifted: [&[f32]; 11] = std::array::from_fn(|k| &row[k..k + n]);
    for (x, out) in out.iter_mut().enumerate() {
        let mut sum = taps[0] * shifted[5][x];
        for k in 1..6 {
            sum += taps[k] * (shifted[5 - k][x] + shifted[5 + k][x]);
        }
        *out = sum;
    }
}

/// [`vertical_standard`] for any radius.
fn vertical(ring: &Ring, plane: usize, moment: usize, y: usize, taps: &[f32], out: &mut [f32]) {
    let n = out.len();
    for (out, v) in out.iter_mut().zip(ring.row(plane, moment, y, n)) {
        *out = taps[0] * v;
    }
    for (k, tap) in taps.iter().enumerate().skip(1) {
        let above = ring.row(plane, moment, y - k, n);
        let below = ring.row(plane, moment, y + k, n);
        for ((out, a), b) in out.iter_mut().zip(above).zip(below) {
            *out += tap * (a + b);
        }
    }
}

/// [`horizontal_standard`] for any radius.
fn horizontal(row: &[f32], taps: &[f32], out: &mut [f32]) {
    let radius = taps.len() - 1;
    for (x, out) in out.iter_mut().enumerate() {
        let at = x + radius;
        *out = taps[0] * row[at];
        for (k, tap) in taps.iter().enumerate().skip(1) {
            *out += tap * (row[at - k] + row[at + k]);
        }
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512vl+avx512bw+avx512dq"))]
fn quotients(
    moments: [&[f32]; MOMENTS],
    c1: f32,
    c2: f32,
    peak: f32,
    ssim: &mut [f32],
    contrast_structure: &mut [f32],
) {
    let n = ssim.len();
    let [u, v, uu, vv] = moments.map(|m| &m[..n]);
    let contrast_structure = &mut contrast_structure[..n];
    for x in 0..n {
        let (mean_u, mean_v) = (u[x] + peak, v[x]);
        let (mean_uu, mean_vv) = (mean_u * mean_u, mean_v * mean_v);
        let (var_u, var_v) = (uu[x] - u[x] * u[x], vv[x] - mean_vv);
        let luminance = (0.5 * (mean_uu - mean_vv) + c1) / (0.5 * (mean_uu + mean_vv) + c1);
        let structure = (0.5 * (var_u - var_v) + c2) / (0.5 * (var_u + var_v) + c2);
        contrast_structure[x] = structure;
        ssim[x] = luminance * structure;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::ssim::Params;

    /// The window of any radius and the unrolled one give the same bits.
    #[test]
    fn the_unrolled_window_is_the_general_one() {
        let width = 47;
        let mut ring = Ring::new(1, STANDARD_RADIUS, width);
        for y in 0..11 {
            let row = |s: usize| {
                (0..width).map(|x| ((x * 37 + y * 101 + s) % 97) as f32 / 97.0 - 0.5).collect::<Vec<_>>()
            };
            ring.push(0, y, &row(0), &row(5), true);
        }
        let taps = Params::default().taps();
        let (mut general, mut columns) = (vec![0.0; 37], vec![0.0; width]);
        let mut unrolled_columns = vec![0.0; width];
        let mut unrolled = vec![0.0; 37];
        let six: [f32; 6] = taps.clone().try_into().unwrap();
        for moment in 0..MOMENTS {
            vertical(&ring, 0, moment, 5, &taps, &mut columns);
            horizontal(&columns, &taps, &mut general);
            let rows = std::array::from_fn(|k| ring.row(0, moment, k, width));
            vertical_standard(rows, six, &mut unrolled_columns);
            horizontal_standard(&unrolled_columns, six, &mut unrolled);
            assert_eq!(general, unrolled);
        }
    }

    #[test]
    fn the_window_adds_up_to_one() {
        for sigma in [0.3, 1.5, 4.0] {
            let taps = Params { sigma, ..Params::default() }.taps();
            let total = taps[0] + 2.0 * taps[1..].iter().sum::<f32>();
            assert!((total - 1.0).abs() < 1e-6);
        }
        assert_eq!(Params::default().window_side(), 11);
    }
}
