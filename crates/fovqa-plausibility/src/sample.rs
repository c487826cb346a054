//! A sparse sample of a pair: bands of rows, cut into windows, with the sums that the checks need.

use fovqa_frame::{Frame, LumaKind, LumaScratch, LumaSignal, Mask, SignalTables};
use multiversion::multiversion;

/// Side of a window in pixels, and the height of a band.
pub(crate) const SIDE: usize = 12;

/// Largest number of bands, which bounds the cost on large frames.
const MOST_BANDS: usize = 20;

/// In frames with many columns of windows, fewer bands have this number of windows.
const ENOUGH: usize = 1800;

/// The smallest number of bands of a high frame.
const FEWEST_BANDS: usize = 14;

/// Luma above this counts as clipped to white.
pub(crate) const WHITE: f32 = 0.99;

/// What a difference of neighbouring pixels has to exceed to count as detail: one code of 8 bits.
const FLOOR: f32 = 1.0 / 255.0;

/// The sums of one window of both pictures. In each pair, index 0 is the reference, 1 the test.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Window {
    /// Whether all of its pixels are scored.
    pub(crate) counts: bool,
    /// Its centre in pixels.
    pub(crate) at: [f32; 2],
    /// Means of the luma of the signal, 0 to 1.
    pub(crate) mean: [f32; 2],
    /// Largest luma.
    pub(crate) high: [f32; 2],
    /// Smallest luma.
    pub(crate) low: [f32; 2],
    /// Fine detail: mean of a concave function of the differences of neighbours.
    pub(crate) detail: [f32; 2],
    /// Mean square of the differences of neighbours.
    pub(crate) energy: [f32; 2],
    /// Variances of the luma.
    pub(crate) variance: [f32; 2],
    /// Covariance of the two.
    pub(crate) covariance: f32,
    /// `sum of g h'`, of the gradients of test (g) and reference (h), row by row.
    pub(crate) gradients: [f32; 4],
    /// `sum of g d` with the difference d of test and reference.
    pub(crate) pull: [f32; 2],
    /// Sums of the products of d with its right neighbour, and of its square.
    pub(crate) residual: [f32; 2],
}

impl Window {
    /// The correlation of the two pictures within the window, or 0 if one of them is flat.
    pub(crate) fn correlation(&self) -> f32 {
        let both = self.variance[0] * self.variance[1];
        if both > 0.0 { (self.covariance / both.sqrt()).clamp(-1.0, 1.0) } else { 0.0 }
    }
}

/// The windows of a pair, on a grid that is symmetric about the middle of the frame.
#[derive(Debug)]
pub(crate) struct Sample {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The number of windows in a band.
    pub(crate) columns: usize,
    /// The windows, band by band from the top.
    pub(crate) windows: Vec<Window>,
}

impl Sample {
    /// Reads the bands of both pictures. `counts` are the pixels that are scored; `None` means all.
    pub(crate) fn new(
        reference: &Frame,
        test: &Frame,
        tables: &SignalTables,
        counts: Option<&Mask>,
    ) -> Self {
        let (width, height) = (reference.width(), reference.height());
        let signals = [reference, test].map(|f| LumaSignal::new(f, tables, LumaKind::Luma));
        let columns = width / SIDE;
        let left = (width - columns * SIDE) / 2;
        let across = columns * SIDE;
        let mut scratch = LumaScratch::new(across);
        let mut row = vec![0.0; across];
        // One value beyond each end of a row, which does not count.
        let stride = across + 2;
        let mut bands = [vec![0.0f32; stride * SIDE], vec![0.0f32; stride * SIDE]];
        let mut windows = Vec::new();
        for top in tops(height, columns) {
            for (signal, band) in signals.iter().zip(&mut bands) {
                for (y, out) in (top..).zip(band.chunks_exact_mut(stride)) {
                    signal.fill_row(y, left..left + across, &mut scratch, &mut row);
                    narrow(&row, &mut out[1..]);
                }
            }
            let first = windows.len();
            windows.resize(first + columns, Window::default());
            let new = &mut windows[first..];
            for (nth, part) in new.chunks_mut(AT_ONCE).enumerate() {
                measure([&bands[0], &bands[1]], stride, nth * COLUMNS, part);
            }
            for (nth, window) in new.iter_mut().enumerate() {
                let x = left + nth * SIDE;
                let all = |mask: &Mask| {
                    (top..top + SIDE).all(|y| mask.row(y)[x..x + SIDE].iter().all(|counts| *counts))
                };
                window.counts = counts.is_none_or(all);
                window.at = [x, top].map(|at| (at + SIDE / 2) as f32);
            }
        }
        Self { width, height, columns, windows }
    }

    /// The windows that count.
    pub(crate) fn counted(&self) -> impl Iterator<Item = &Window> + Clone {
        self.windows.iter().filter(|window| window.counts)
    }

    /// The diagonal of the frame in pixels.
    pub(crate) fn diagonal(&self) -> f32 {
        ((self.width * self.width + self.height * self.height) as f32).sqrt()
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn narrow(values: &[f64], out: &mut [f32]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = *value as f32;
    }
}

/// The first rows of the bands, symmetric about the middle.
fn tops(height: usize, columns: usize) -> impl Iterator<Item = usize> {
    let enough = (ENOUGH / columns.max(1)).clamp(FEWEST_BANDS, MOST_BANDS);
    let bands = (height / SIDE).min(enough);
    (0..bands).map(move |n| (2 * n + 1) * height / (2 * bands) - SIDE / 2)
}

/// Windows that are summed at the same time, so that the sums stay in the nearest cache.
const AT_ONCE: usize = 10;

/// Columns of these windows.
const COLUMNS: usize = AT_ONCE * SIDE;

/// The number of sums of each column.
const SUMS: usize = 25;

/// Sums of each column of some windows.
type ColumnSums = [[f32; COLUMNS]; SUMS];

/// Sums the windows that begin at column `left` of the bands, whose rows have `stride` values and one
/// value beyond each end.
fn measure(bands: [&[f32]; 2], stride: usize, left: usize, windows: &mut [Window]) {
    let mut sums: ColumnSums = [[0.0; COLUMNS]; SUMS];
    sums[LOW] = [f32::INFINITY; COLUMNS];
    sums[LOW + 1] = [f32::INFINITY; COLUMNS];
    let columns = windows.len() * SIDE;
    for y in 0..SIDE {
        let row = |side: usize, y: usize| &bands[side][y * stride + left..][..columns + 2];
        let [r, t] = [0, 1].map(|side| row(side, y));
        add_values([r, t], &mut sums);
        if y % 2 == 0 {
            add_detail([[r, row(0, y + 1)], [t, row(1, y + 1)]], &mut sums);
        }
        if (1..SIDE - 1).contains(&y) {
            let around = [0, 1].map(|side| [row(side, y - 1), row(side, y), row(side, y + 1)]);
            add_gradients(around, &mut sums);
        }
    }
    for (nth, window) in windows.iter_mut().enumerate() {
        finish(&sums, nth * SIDE, window);
    }
}

const MEAN: usize = 0;
const SQUARE: usize = 2;
const PRODUCT: usize = 4;
const HIGH: usize = 5;
const LOW: usize = 7;
const DETAIL: usize = 9;
const ENERGY: usize = 11;
const GRADIENTS: usize = 13;
const PULL: usize = 17;
const SLOPE: usize = 19;
const DIFFERENCE: usize = 21;
const NEXT: usize = 22;
const PRODUCT_OF_NEXT: usize = 23;
const SQUARE_OF_DIFFERENCE: usize = 24;

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn add_values([r, t]: [&[f32]; 2], sums: &mut ColumnSums) {
    let n = r.len() - 2;
    let (r, t) = (&r[1..=n], &t[1..=n]);
    for (side, values) in [r, t].into_iter().enumerate() {
        for (x, v) in values.iter().enumerate().take(COLUMNS) {
            sums[MEAN + side][x] += v;
            sums[SQUARE + side][x] += v * v;
            sums[HIGH + side][x] = sums[HIGH + side][x].max(*v);
            sums[LOW + side][x] = sums[LOW + side][x].min(*v);
        }
    }
    for (x, (r, t)) in r.iter().zip(t).enumerate().take(COLUMNS) {
        sums[PRODUCT][x] += r * t;
    }
}

/// Adds the differences of neighbours in two rows of each picture.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn add_detail(rows: [[&[f32]; 2]; 2], sums: &mut ColumnSums) {
    for (side, [row, below]) in rows.into_iter().enumerate() {
        let n = row.len() - 2;
        let (values, right, below) = (&row[1..=n], &row[2..], &below[1..=n]);
        let values = values.iter().zip(right).zip(below).enumerate().take(COLUMNS);
        for (x, ((v, right), below)) in values {
            // The right neighbour of the last column is in the next window.
            let across = (right - v) * INSIDE_RIGHT[x];
            let down = below - v;
            sums[DETAIL + side][x] += concave(across) + concave(down);
            sums[ENERGY + side][x] += across * across + down * down;
        }
    }
}

/// Adds gradients and differences in the middle one of three rows of each picture.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn add_gradients([r, t]: [[&[f32]; 3]; 2], sums: &mut ColumnSums) {
    let n = (r[1].len() - 2).min(COLUMNS);
    let around = |rows: [&[f32]; 3], x: usize| {
        [rows[1][x + 2] - rows[1][x], rows[2][x + 1] - rows[0][x + 1]]
    };
    for x in 0..n {
        let inside = INSIDE[x];
        let h = around(r, x);
        let g = around(t, x).map(|g| g * inside);
        let e = t[1][x + 1] - r[1][x + 1];
        let next = t[1][x + 2] - r[1][x + 2];
        sums[GRADIENTS][x] += g[0] * h[0];
        sums[GRADIENTS + 1][x] += g[0] * h[1];
        sums[GRADIENTS + 2][x] += g[1] * h[0];
        sums[GRADIENTS + 3][x] += g[1] * h[1];
        sums[PULL][x] += g[0] * e;
        sums[PULL + 1][x] += g[1] * e;
        sums[SLOPE][x] += g[0];
        sums[SLOPE + 1][x] += g[1];
        sums[DIFFERENCE][x] += e * inside;
        sums[NEXT][x] += next * inside;
        sums[PRODUCT_OF_NEXT][x] += e * next * inside;
        sums[SQUARE_OF_DIFFERENCE][x] += e * e * inside;
    }
}

/// 1 in the columns of each window that have a neighbour in it to the right, else 0.
const INSIDE_RIGHT: [f32; COLUMNS] = inside(0, SIDE - 1);

/// 1 in the columns of each window that have neighbours in it on both sides, else 0.
const INSIDE: [f32; COLUMNS] = inside(1, SIDE - 1);

const fn inside(from: usize, to: usize) -> [f32; COLUMNS] {
    let mut inside = [0.0; COLUMNS];
    let mut x = 0;
    while x < COLUMNS {
        if x % SIDE >= from && x % SIDE < to {
            inside[x] = 1.0;
        }
        x += 1;
    }
    inside
}

/// Puts the sums of a window's columns together. The mean difference is taken out of what is about the
/// difference.
fn finish(sums: &ColumnSums, first: usize, window: &mut Window) {
    let columns = first..first + SIDE;
    let sum = |of: usize| sums[of][columns.clone()].iter().sum::<f32>();
    let pixels = (SIDE * SIDE) as f32;
    let differences = (SIDE / 2 * (2 * SIDE - 1)) as f32;
    for side in 0..2 {
        let mean = sum(MEAN + side) / pixels;
        window.mean[side] = mean;
        window.variance[side] = (sum(SQUARE + side) / pixels - mean * mean).max(0.0);
        window.high[side] = sums[HIGH + side][columns.clone()].iter().copied().fold(0.0, f32::max);
        window.low[side] = sums[LOW + side][columns.clone()].iter().copied().fold(1.0, f32::min);
        window.detail[side] = sum(DETAIL + side) / differences;
        window.energy[side] = sum(ENERGY + side) / differences;
    }
    let [mr, mt] = window.mean;
    window.covariance = sum(PRODUCT) / pixels - mr * mt;
    let offset = mt - mr;
    for nth in 0..4 {
        window.gradients[nth] = sum(GRADIENTS + nth);
    }
    for nth in 0..2 {
        window.pull[nth] = sum(PULL + nth) - offset * sum(SLOPE + nth);
    }
    let n = ((SIDE - 2) * (SIDE - 2)) as f32;
    let (e, next) = (sum(DIFFERENCE), sum(NEXT));
    window.residual = [
        sum(PRODUCT_OF_NEXT) - offset * (e + next) + n * offset * offset,
        sum(SQUARE_OF_DIFFERENCE) - 2.0 * offset * e + n * offset * offset,
    ];
}

/// Grows with the square root of a difference, so that one large step counts less than many small
/// ones of the same sum: blocks of equal pixels have less detail than a slope. Differences below
/// one code grow in proportion, so that rounding changes little.
#[inline(always)]
fn concave(difference: f32) -> f32 {
    (difference.abs() + FLOOR).sqrt() - FLOOR.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_frame::SignalParams;
    use fovqa_testkit::synthetic::{codes, disturbed, rgb8};

    /// The sums of one window as they are defined, pixel by pixel.
    fn defined(r: &[[f32; SIDE]; SIDE], t: &[[f32; SIDE]; SIDE]) -> Window {
        let mut window = Window { low: [1.0; 2], ..Window::default() };
        let n = (SIDE * SIDE) as f32;
        for (side, rows) in [r, t].into_iter().enumerate() {
            let all = rows.as_flattened();
            window.mean[side] = all.iter().sum::<f32>() / n;
            for v in all {
                window.high[side] = window.high[side].max(*v);
                window.low[side] = window.low[side].min(*v);
                window.variance[side] += (v - window.mean[side]).powi(2) / n;
            }
            let mut differences = Vec::new();
            for y in (0..SIDE).step_by(2) {
                differences.extend((1..SIDE).map(|x| rows[y][x] - rows[y][x - 1]));
                differences.extend((0..SIDE).map(|x| rows[y + 1][x] - rows[y][x]));
            }
            let mean = |of: &dyn Fn(f32) -> f32| {
                differences.iter().map(|d| of(*d)).sum::<f32>() / differences.len() as f32
            };
            window.detail[side] = mean(&concave);
            window.energy[side] = mean(&|d| d * d);
        }
        let [mr, mt] = window.mean;
        let d = |x: usize, y: usize| (t[y][x] - mt) - (r[y][x] - mr);
        for y in 0..SIDE {
            for x in 0..SIDE {
                window.covariance += (r[y][x] - mr) * (t[y][x] - mt) / n;
                if !(1..SIDE - 1).contains(&x) || !(1..SIDE - 1).contains(&y) {
                    continue;
                }
                let [g, h] = [t, r].map(|p| [p[y][x + 1] - p[y][x - 1], p[y + 1][x] - p[y - 1][x]]);
                for (nth, sum) in window.gradients.iter_mut().enumerate() {
                    *sum += g[nth / 2] * h[nth % 2];
                }
                for (sum, g) in window.pull.iter_mut().zip(g) {
                    *sum += g * d(x, y);
                }
                window.residual[0] += d(x, y) * d(x + 1, y);
                window.residual[1] += d(x, y) * d(x, y);
            }
        }
        window
    }

    #[test]
    fn sums_are_those_that_are_defined() {
        // More windows than are summed at once, and a border to the left.
        let (width, height) = (SIDE * 19 + 7, SIDE * 2 + 5);
        let first = codes(width, height, 3, 5);
        let second = disturbed(&first, 40.0, 6);
        let [reference, test] = [&first, &second].map(|codes| rgb8(width, height, codes.clone()));
        let tables = SignalTables::new(SignalParams::default());
        let sample = Sample::new(&reference, &test, &tables, None);
        assert_eq!((sample.columns, sample.windows.len()), (19, 38));
        let luma = |frame: &Frame, x: usize, y: usize| {
            let weights = [0.2126, 0.7152, 0.0722];
            (0..3).map(|c| weights[c] * frame.sample(c, x, y) / 255.0).sum::<f32>()
        };
        for window in &sample.windows {
            let [left, top] = window.at.map(|at| at as usize - SIDE / 2);
            let pixels = |frame: &Frame| -> [[f32; SIDE]; SIDE] {
                std::array::from_fn(|y| std::array::from_fn(|x| luma(frame, left + x, top + y)))
            };
            let wanted = defined(&pixels(&reference), &pixels(&test));
            let all = |w: &Window| {
                let pairs =
                    [w.mean, w.high, w.low, w.detail, w.energy, w.variance, w.pull, w.residual];
                let rest =
                    [w.covariance, w.gradients[0], w.gradients[1], w.gradients[2], w.gradients[3]];
                [pairs.as_flattened(), &rest[..]].concat()
            };
            for (nth, (got, wanted)) in all(window).iter().zip(all(&wanted)).enumerate() {
                let error = (got - wanted).abs();
                assert!(error <= 2e-5 * wanted.abs().max(1.0), "{nth}: {got} for {wanted}");
            }
        }
    }

    #[test]
    fn masked_windows_do_not_count() {
        let (width, height) = (SIDE * 4, SIDE * 2);
        let frame = rgb8(width, height, codes(width, height, 3, 5));
        let tables = SignalTables::new(SignalParams::default());
        let valid = (0..width * height).map(|at| at != SIDE * 2 + 3).collect();
        let mask = Mask::new(width, height, valid).unwrap();
        let sample = Sample::new(&frame, &frame, &tables, Some(&mask));
        let counted: Vec<bool> = sample.windows.iter().map(|window| window.counts).collect();
        assert_eq!(counted, [true, true, false, true, true, true, true, true]);
    }
}
