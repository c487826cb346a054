//! The quality of windows of wavelet coefficients (Wang, Bovik 2002): correlation and contrast, times brightness.

use multiversion::multiversion;

use super::wavelet::Plane;

/// Side of a window, and how far it reaches from its centre.
pub(super) const WINDOW: usize = 11;
pub(super) const REACH: usize = WINDOW / 2;

/// A denominator below this is that of a flat window. Rounding leaves up to 1e-14 there.
const NOTHING: f64 = 1e-12;

/// The number of windows that are computed from one shift.
const TILE: usize = 64;

/// Computes rows of qualities.
#[derive(Debug)]
pub(super) struct Qualities {
    /// Sums over the rows of a window, for each column: of a, b, a², b² and a b.
    sums: [[f64; TILE + 2 * REACH]; 5],
}

impl Qualities {
    pub(super) fn new() -> Self {
        Self { sums: [[0.0; TILE + 2 * REACH]; 5] }
    }

    /// The qualities of the windows around row `y`, from the first column at which they fit. Moments are computed from
    /// the distances to a value nearby, so that they keep their digits.
    pub(super) fn fill(&mut self, [a, b]: [&Plane; 2], y: usize, out: &mut [f64]) {
        for (tile, out) in out.chunks_mut(TILE).enumerate() {
            let columns = tile * TILE..tile * TILE + out.len() + 2 * REACH;
            let shift = a.row(y)[usize::midpoint(columns.start, columns.end)];
            let sums = &mut self.sums;
            for sum in sums.iter_mut() {
                sum[..columns.len()].fill(0.0);
            }
            for row in y - REACH..=y + REACH {
                add_row(&a.row(row)[columns.clone()], &b.row(row)[columns.clone()], shift, sums);
            }
            qualities(sums, shift, out);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn add_row(a: &[f64], b: &[f64], shift: f64, sums: &mut [[f64; TILE + 2 * REACH]; 5]) {
    let n = a.len();
    let b = &b[..n];
    let [of_a, of_b, of_aa, of_bb, of_ab] = sums.each_mut().map(|sum| &mut sum[..n]);
    for x in 0..n {
        let (a, b) = (a[x] - shift, b[x] - shift);
        of_a[x] += a;
        of_b[x] += b;
        of_aa[x] += a * a;
        of_bb[x] += b * b;
        of_ab[x] += a * b;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn qualities(sums: &[[f64; TILE + 2 * REACH]; 5], shift: f64, out: &mut [f64]) {
    const COUNT: f64 = (WINDOW * WINDOW) as f64;
    for (x, out) in out.iter_mut().enumerate().take(TILE) {
        let [a, b, aa, bb, ab] = sums.each_ref().map(|sum| {
            let mut total = 0.0;
            for k in 0..WINDOW {
                total += sum[x + k];
            }
            total / COUNT
        });
        let (of_a, of_b, of_both) = (aa - a * a, bb - b * b, ab - a * b);
        let (a, b) = (a + shift, b + shift);
        let (spread, brightness) = (of_a + of_b, a * a + b * b);
        let structure = if spread < NOTHING { 1.0 } else { 2.0 * of_both / spread };
        let brightness = if brightness < NOTHING { 1.0 } else { 2.0 * a * b / brightness };
        *out = structure * brightness;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn literal(a: &Plane, b: &Plane, x: usize, y: usize) -> f64 {
        let window = |plane: &Plane| -> Vec<f64> {
            (y - REACH..=y + REACH)
                .flat_map(|y| plane.row(y)[x - REACH..=x + REACH].to_vec())
                .collect()
        };
        let (a, b) = (window(a), window(b));
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        let (ma, mb) = (mean(&a), mean(&b));
        let about = |p: &[f64], mp: f64, q: &[f64], mq: f64| {
            mean(&p.iter().zip(q).map(|(p, q)| (p - mp) * (q - mq)).collect::<Vec<_>>())
        };
        let spread = about(&a, ma, &a, ma) + about(&b, mb, &b, mb);
        let factor = |above: f64, below: f64| if below < 1e-12 { 1.0 } else { above / below };
        factor(2.0 * about(&a, ma, &b, mb), spread) * factor(2.0 * ma * mb, ma * ma + mb * mb)
    }

    #[test]
    fn windows_are_the_definition() {
        let (width, height) = (150, 13);
        let plane = |seed: usize, mean: f64| Plane {
            width,
            values: (0..width * height)
                .map(|i| {
                    let flat = i % width < 14;
                    let noise = ((i * seed) % 1009) as f64 / 1009.0 - 0.5;
                    mean + if flat { 0.0 } else { noise * 0.1 }
                })
                .collect(),
        };
        for (a, b) in [
            (plane(7919, 15.0), plane(7907, 15.01)),
            (plane(7919, 0.0), plane(7907, 0.0)),
            (plane(7919, 0.0), plane(7919, 0.0)),
        ] {
            let mut found = vec![0.0; width - 2 * REACH];
            for y in REACH..height - REACH {
                Qualities::new().fill([&a, &b], y, &mut found);
                for (x, found) in (REACH..).zip(&found) {
                    let wanted = literal(&a, &b, x, y);
                    assert!((found - wanted).abs() < 1e-9, "{x},{y}: {found} for {wanted}");
                }
            }
        }
    }
}
