//! The metric of one frame written out literally in `f64` from its published formulas: one pixel
//! after another, without logarithms and without rows. It shares nothing with the tested
//! implementation except the bytes of the tables.

use super::Grid;

pub(super) const NODES: usize = 32;

/// log2 of the uncorrected sensitivity; luminance is the slowest index and eccentricity the
/// fastest.
pub(super) struct Table {
    pub(super) log2: Vec<f64>,
}

impl Table {
    pub(super) fn embedded(channel: usize) -> Self {
        let files: [&[u8]; 2] =
            [include_bytes!("../csf/sustained.f32le"), include_bytes!("../csf/transient.f32le")];
        let values = files[channel].as_chunks::<4>().0.iter();
        Self { log2: values.map(|bytes| f64::from(f32::from_le_bytes(*bytes))).collect() }
    }

    pub(super) fn of(log2: impl Fn(usize, usize, usize) -> f64) -> Self {
        let mut table = Vec::new();
        for y in 0..NODES {
            for rho in 0..NODES {
                table.extend((0..NODES).map(|ecc| log2(y, rho, ecc)));
            }
        }
        Self { log2: table }
    }

    pub(super) fn cd_m2(node: usize) -> f64 {
        10f64.powf(-3.0 + 7.0 * node as f64 / 31.0)
    }

    pub(super) fn rho_cpd(node: usize) -> f64 {
        2f64.powf(-4.0 + 10.0 * node as f64 / 31.0)
    }

    pub(super) fn deg(node: usize) -> f64 {
        (120f64.sqrt() * node as f64 / 31.0).powi(2)
    }

    pub(super) fn interpolated(&self, rho_cpd: f64, cd_m2: f64, ecc_deg: f64) -> f64 {
        let axes = [
            (cd_m2.log10() + 3.0) * 31.0 / 7.0,
            // A negative frequency, beyond 90° from the display's centre, is replaced by the
            // lowest.
            if rho_cpd > 0.0 { (rho_cpd.log2() + 4.0) * 31.0 / 10.0 } else { 0.0 },
            ecc_deg.sqrt() * 31.0 / 120f64.sqrt(),
        ];
        let at = axes.map(|at| at.clamp(0.0, 31.0));
        let mut sum = 0.0;
        for corner in 0..8usize {
            let (mut index, mut weight) = (0, 1.0);
            for (axis, at) in at.iter().enumerate() {
                let cell = at.floor().min(30.0);
                let upper = corner >> axis & 1;
                index = index * NODES + cell as usize + upper;
                weight *= if upper == 1 { at - cell } else { 1.0 - (at - cell) };
            }
            sum += weight * self.log2[index];
        }
        sum
    }
}

#[derive(Clone)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    fn of(width: usize, height: usize, value: impl Fn(usize, usize) -> f64) -> Self {
        let values = (0..width * height).map(|i| value(i % width, i / width)).collect();
        Self { width, height, values }
    }

    pub(super) fn of_grid(grid: &Grid) -> Self {
        Self::of(grid.width(), grid.height(), |x, y| f64::from(grid.row(y)[x]))
    }

    fn at(&self, x: usize, y: usize) -> f64 {
        self.values[y * self.width + x]
    }

    fn row(&self, y: usize) -> Vec<f64> {
        (0..self.width).map(|x| self.at(x, y)).collect()
    }

    fn column(&self, x: usize) -> Vec<f64> {
        (0..self.height).map(|y| self.at(x, y)).collect()
    }

    fn of_rows(rows: &[Vec<f64>]) -> Self {
        Self::of(rows[0].len(), rows.len(), |x, y| rows[y][x])
    }

    fn of_columns(columns: &[Vec<f64>]) -> Self {
        Self::of(columns.len(), columns[0].len(), |x, y| columns[x][y])
    }
}

const KERNEL: [f64; 5] = [0.05, 0.25, 0.4, 0.25, 0.05];

fn halved(x: &[f64], odd: bool) -> Vec<f64> {
    let n = x.len();
    let mut y = vec![0.0; n.div_ceil(2)];
    for (i, y) in y.iter_mut().enumerate() {
        for (k, weight) in KERNEL.iter().enumerate() {
            if 2 * i + k >= 2 && 2 * i + k - 2 < n {
                *y += weight * x[2 * i + k - 2];
            }
        }
    }
    y[0] += 0.25 * x[0] + 0.05 * x[1];
    let last = y.len() - 1;
    y[last] += if odd { 0.25 * x[n - 1] + 0.05 * x[n - 2] } else { 0.05 * x[n - 1] };
    y
}

fn doubled(x: &[f64], n: usize) -> Vec<f64> {
    let mut z = vec![0.0; n + 4];
    for (j, x) in x.iter().enumerate() {
        z[2 + 2 * j] = *x;
    }
    z[0] = x[0];
    z[if n.is_multiple_of(2) { n + 2 } else { n + 3 }] = x[x.len() - 1];
    (0..n).map(|i| 2.0 * (0..5).map(|k| KERNEL[k] * z[i + k]).sum::<f64>()).collect()
}

pub(super) fn reduced(fine: &Plane, exact_edges: bool) -> Plane {
    let columns: Vec<_> =
        (0..fine.width).map(|x| halved(&fine.column(x), fine.height % 2 == 1)).collect();
    let odd = if exact_edges { fine.width % 2 == 1 } else { fine.height % 2 == 1 };
    let low = Plane::of_columns(&columns);
    Plane::of_rows(&(0..low.height).map(|y| halved(&low.row(y), odd)).collect::<Vec<_>>())
}

pub(super) fn expanded(coarse: &Plane, width: usize, height: usize) -> Plane {
    let columns: Vec<_> = (0..coarse.width).map(|x| doubled(&coarse.column(x), height)).collect();
    let tall = Plane::of_columns(&columns);
    Plane::of_rows(&(0..height).map(|y| doubled(&tall.row(y), width)).collect::<Vec<_>>())
}

/// The literal metric for a field, given by the tangents of the angles to its sides: left, right,
/// up, down.
#[derive(Clone, Copy)]
pub(super) struct Oracle {
    pub(super) tangents: [f64; 4],
    pub(super) ppd: f64,
    /// `None` means foveal vision at every pixel.
    pub(super) gaze_px: Option<[f64; 2]>,
    pub(super) exact_edges: bool,
}

pub(super) struct OracleScore {
    pub(super) q: f64,
    /// Q for each level and channel.
    pub(super) q_of_bands: Vec<Vec<f64>>,
    pub(super) differences: Vec<Vec<Plane>>,
    /// The heat map.
    pub(super) map: Plane,
}

const BETA: f64 = 1.52134;

impl Oracle {
    /// The frequencies of the bands for frames of a size.
    pub(super) fn frequencies_cpd(&self, width: usize, height: usize) -> Vec<f64> {
        let all: Vec<f64> = (0..15)
            .map(|l| match l {
                0 => self.ppd / 2.0,
                l => 0.3228 * 2f64.powi(1 - l) * self.ppd / 2.0,
            })
            .collect();
        let most = (width.min(height) as f64).log2().floor() as usize - 1;
        let lowest = all.iter().position(|cpd| *cpd <= 0.5).unwrap_or(most);
        all[..(lowest + 1).min(most)].to_vec()
    }

    /// The direction of a point that is given as shares of width and height.
    pub(super) fn direction_deg(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, right, up, down] = self.tangents;
        [
            (x * (left + right) - left).atan().to_degrees(),
            (up - y * (up + down)).atan().to_degrees(),
        ]
    }

    fn magnification(&self, direction: [f64; 2]) -> f64 {
        let a = direction[0].hypot(direction[1]).min(89.9).to_radians();
        let delta = (0.5 / self.ppd).to_radians();
        ((a + delta).tan() - a.tan()) / delta.tan()
    }

    /// The score of a frame from the luminance of its sustained channel, or of the sustained and
    /// the transient channel.
    pub(super) fn score(&self, reference: &[Plane], test: &[Plane]) -> OracleScore {
        let (width, height) = (reference[0].width, reference[0].height);
        let tables = [0, 1].map(Table::embedded);
        let (mut reference, mut test) = (reference.to_vec(), test.to_vec());
        let (mut differences, mut q_of_bands) = (Vec::new(), Vec::new());
        for (level, cpd) in self.frequencies_cpd(width, height).into_iter().enumerate() {
            let Plane { width: w, height: h, .. } = reference[0];
            let gaze = self.gaze_px.map(|[x, y]| {
                (self.direction_deg([x / width as f64, y / height as f64]), [w as f64, h as f64])
            });
            let below = |planes: &[Plane]| -> Vec<Plane> {
                planes.iter().map(|plane| reduced(plane, self.exact_edges)).collect()
            };
            let (coarse_reference, coarse_test) = (below(&reference), below(&test));
            let low = |planes: &[Plane]| -> Vec<Plane> {
                planes.iter().map(|plane| expanded(plane, w, h)).collect()
            };
            let (low_reference, low_test) = (low(&coarse_reference), low(&coarse_test));
            let of_channel = |c: usize| {
                Plane::of(w, h, |x, y| {
                    let background = low_reference[0].at(x, y).max(0.1);
                    let gain = if level == 0 { 1.0 } else { 2.0 };
                    let contrast = |fine: &Plane, low: &Plane| {
                        ((fine.at(x, y) - low.at(x, y)) / background).min(1000.0) * gain
                    };
                    let (rho, ecc) = match gaze {
                        None => (cpd, 0.0),
                        Some((gaze, [w, h])) => {
                            let d =
                                self.direction_deg([(x as f64 + 0.5) / w, (y as f64 + 0.5) / h]);
                            let ecc = (d[0] - gaze[0]).hypot(d[1] - gaze[1]);
                            (cpd * self.magnification(d), ecc)
                        }
                    };
                    let log2 = tables[c].interpolated(rho, background, ecc);
                    let sensitivity = 10f64.powf(16.2596 / 20.0) * log2.exp2();
                    let t = contrast(&test[c], &low_test[c]) * sensitivity;
                    let r = contrast(&reference[c], &low_reference[c]) * sensitivity;
                    let masker = 10f64.powf(-0.973_838) * t.abs().min(r.abs());
                    let q = [2.43685, 4.946][c];
                    ((t - r).abs().powf(2.4) / (1.0 + masker.powf(q))).min(1e4)
                })
            };
            let planes: Vec<Plane> = (0..reference.len()).map(of_channel).collect();
            q_of_bands.push(planes.iter().map(over_pixels).collect::<Vec<f64>>());
            differences.push(planes);
            (reference, test) = (coarse_reference, coarse_test);
        }
        let of_channel = |c: usize| {
            [1.0, 0.25][c] * q_of_bands.iter().map(|channels: &Vec<f64>| channels[c]).sum::<f64>()
        };
        let q = if q_of_bands[0].len() == 1 {
            of_channel(0)
        } else {
            (of_channel(0).powf(0.666_092) + of_channel(1).powf(0.666_092)).powf(1.0 / 0.666_092)
        };
        let map = heat_map(&differences);
        OracleScore { q, q_of_bands, differences, map }
    }
}

fn over_pixels(differences: &Plane) -> f64 {
    let sum: f64 = differences.values.iter().map(|d| d.powf(BETA)).sum();
    (sum / differences.values.len() as f64).powf(1.0 / BETA)
}

/// The sum of D^β over the pixels that count; `counts` gets the position of a pixel in its level.
pub(super) fn power_where(differences: &Plane, counts: impl Fn(usize, usize) -> bool) -> f64 {
    let Plane { width, values, .. } = differences;
    let counted = values.iter().enumerate().filter(|(i, _)| counts(i % width, i / width));
    counted.map(|(_, d)| d.powf(BETA)).sum()
}

fn heat_map(differences: &[Vec<Plane>]) -> Plane {
    let level = |l: usize, x: usize, y: usize| {
        let of_channels = differences[l].iter().zip([1.0, 0.25]);
        let sum: f64 = of_channels.map(|(plane, weight)| weight * plane.at(x, y)).sum();
        if l == 0 { sum } else { sum / 2.0 }
    };
    let mut map: Option<Plane> = None;
    for l in (0..differences.len()).rev() {
        let Plane { width, height, .. } = differences[l][0];
        let below = map.map(|coarse| expanded(&coarse, width, height));
        map = Some(Plane::of(width, height, |x, y| {
            level(l, x, y) + below.as_ref().map_or(0.0, |plane| plane.at(x, y))
        }));
    }
    let sum = map.expect("at least one level");
    Plane::of(sum.width, sum.height, |x, y| 0.016_171_3 * sum.at(x, y).powf(0.591_562))
}
