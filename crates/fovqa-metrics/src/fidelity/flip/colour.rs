//! The colour spaces of FLIP, and the difference of two pixels.
//!
//! Opponent channels here are `y`, `x - y` and `y - z` of XYZ relative to white: YCxCz without its factors
//! and offset, which filters do not change.

use multiversion::multiversion;

use super::filters::LANES;
use crate::log_exp::{exp2, log2};

/// XYZ of linear RGB, in units of 1 / 24577794 (Rec.709 primaries, D65).
const XYZ_OF_RGB: [[f64; 3]; 3] = [
    [10_135_552.0, 8_788_810.0, 4_435_075.0],
    [5_226_144.0, 17_577_620.0, 1_774_030.0],
    [475_104.0, 8_788_810.0 / 3.0, 70_074_185.0 / 3.0],
];

type Matrix = [[f32; 3]; 3];

/// The end of the straight part of L*a*b*, (6/29)³.
const STRAIGHT_END: f32 = (6.0 * 6.0 * 6.0) / (29.0 * 29.0 * 29.0);
/// Its slope, 1 / (3 (6/29)²), and its value at 0.
const SLOPE: f32 = 29.0 * 29.0 / (3.0 * 6.0 * 6.0);
const AT_ZERO: f32 = 4.0 / 29.0;

/// The exponent of the colour difference.
const EXPONENT: f32 = 0.7;
/// The share of the largest difference at which the steep part of the scale ends, and the value there.
const KNEE: f64 = 0.4;
const AT_KNEE: f64 = 0.95;

/// The conversions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Colours {
    /// Linear RGB to XYZ relative to white, and back.
    to_relative: Matrix,
    to_rgb: Matrix,
    /// The colour difference at which the steep part of the scale ends, and the slopes before and behind it.
    knee: f32,
    steep: f32,
    gentle: f32,
}

impl Colours {
    /// The conversions of FLIP.
    pub(crate) fn new() -> Self {
        let relative = XYZ_OF_RGB.map(|row| row.map(|value| value / row.iter().sum::<f64>()));
        let to_relative = relative.map(|row| row.map(|value| value as f32));
        let to_rgb = inverse(relative).map(|row| row.map(|value| value as f32));
        let lab = |rgb: [f64; 3]| lab_of_relative(relative.map(|row| dot(row, rgb)));
        let most = libm::pow(hyab(lab([0.0, 1.0, 0.0]), lab([0.0, 0.0, 1.0])), 0.7);
        let knee = KNEE * most;
        Self {
            to_relative,
            to_rgb,
            knee: knee as f32,
            steep: (AT_KNEE / knee) as f32,
            gentle: ((1.0 - AT_KNEE) / (most - knee)) as f32,
        }
    }
}

fn dot(row: [f64; 3], v: [f64; 3]) -> f64 {
    row[0] * v[0] + row[1] * v[1] + row[2] * v[2]
}

/// The inverse of a matrix, by its cofactors.
fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |row: usize, column: usize| {
        let at = |r: usize, c: usize| m[(row + r) % 3][(column + c) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant = (0..3).map(|column| m[0][column] * cofactor(0, column)).sum::<f64>();
    std::array::from_fn(|row| std::array::from_fn(|column| cofactor(column, row) / determinant))
}

/// L*a*b* of XYZ relative to white, with chroma scaled by lightness (Hunt effect).
fn lab_of_relative(xyz: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = xyz.map(|v| {
        let straight = v * f64::from(SLOPE) + 4.0 / 29.0;
        if v > 216.0 / 24_389.0 { libm::cbrt(v) } else { straight }
    });
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)]
}

/// The distance of two colours (HyAB).
fn hyab(p: [f64; 3], q: [f64; 3]) -> f64 {
    (p[0] - q[0]).abs() + libm::hypot(p[1] - q[1], p[2] - q[2])
}

/// Converts linear RGB to opponent channels, in place.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn to_opponents(colours: &Colours, [r, g, b]: [&[f32]; 3], out: [&mut [f32]; 3]) {
    let n = r.len();
    let (g, b) = (&g[..n], &b[..n]);
    let [y, cx, cz] = out.map(|plane| &mut plane[..n]);
    for i in 0..n {
        let [x_, y_, z_] = multiply(&colours.to_relative, [r[i], g[i], b[i]]);
        y[i] = y_;
        cx[i] = x_ - y_;
        cz[i] = y_ - z_;
    }
}

#[inline(always)]
fn multiply(matrix: &Matrix, [a, b, c]: [f32; 3]) -> [f32; 3] {
    let row = |m: &[f32; 3]| m[0] * a + m[1] * b + m[2] * c;
    [row(&matrix[0]), row(&matrix[1]), row(&matrix[2])]
}

/// The filtered rows of one picture.
#[derive(Debug, Clone)]
pub(crate) struct Filtered {
    /// Opponent channels.
    pub(crate) opponents: [Vec<f32>; 3],
    /// The magnitude of edges and of points.
    pub(crate) features: [Vec<f32>; 2],
}

impl Filtered {
    /// Rows of a length.
    pub(crate) fn new(columns: usize) -> Self {
        let row = || vec![0.0; columns];
        Self { opponents: [row(), row(), row()], features: [row(), row()] }
    }
}

/// The FLIP map of a row of two filtered pictures, as many values as fill whole vectors.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn compare(colours: &Colours, reference: &Filtered, test: &Filtered, out: &mut [f32]) {
    let vectors = |picture: &'_ Filtered, at: usize| -> [[f32; LANES]; 5] {
        let [y, cx, cz] = picture.opponents.each_ref().map(|row| vector(row, at));
        let [edges, points] = picture.features.each_ref().map(|row| vector(row, at));
        [y, cx, cz, edges, points]
    };
    for (at, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let (r, t) = (vectors(reference, at), vectors(test, at));
        for i in 0..LANES {
            let p = lab(colours, [r[0][i], r[1][i], r[2][i]]);
            let q = lab(colours, [t[0][i], t[1][i], t[2][i]]);
            let (a, b) = (p[1] - q[1], p[2] - q[2]);
            let distance = (p[0] - q[0]).abs() + (a * a + b * b).sqrt();
            let (edges, points) = ((r[3][i] - t[3][i]).abs(), (r[4][i] - t[4][i]).abs());
            let feature = if edges > points { edges } else { points };
            let sharpened = 1.0 - (feature * std::f32::consts::FRAC_1_SQRT_2).sqrt();
            let colour = scale(colours, exp2(EXPONENT * log2(distance)));
            let value = exp2(sharpened * log2(colour));
            // The logarithm of 0 is not infinite here.
            out[i] = if distance > 0.0 { value } else { 0.0 };
        }
    }
}

#[inline(always)]
fn vector(row: &[f32], at: usize) -> [f32; LANES] {
    row.as_chunks().0[at]
}

/// The colour difference from 0 to 1.
#[inline(always)]
fn scale(colours: &Colours, error: f32) -> f32 {
    let below = error * colours.steep;
    let above = AT_KNEE as f32 + (error - colours.knee) * colours.gentle;
    let scaled = if error < colours.knee { below } else { above };
    if scaled < 1.0 { scaled } else { 1.0 }
}

/// L*a*b* of opponent channels within the gamut, with chroma scaled by lightness.
#[inline(always)]
fn lab(colours: &Colours, [y, cx, cz]: [f32; 3]) -> [f32; 3] {
    let rgb = multiply(&colours.to_rgb, [cx + y, y, y - cz]);
    let rgb = rgb.map(|v| {
        let v = if v > 0.0 { v } else { 0.0 };
        if v < 1.0 { v } else { 1.0 }
    });
    let [x, y, z] = multiply(&colours.to_relative, rgb).map(lab_curve);
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * (500.0 * (x - y)), hunt * (200.0 * (y - z))]
}

#[inline(always)]
fn lab_curve(v: f32) -> f32 {
    let root = cbrt(if v > STRAIGHT_END { v } else { STRAIGHT_END });
    if v > STRAIGHT_END { root } else { v * SLOPE + AT_ZERO }
}

/// The cube root of a number from about 0.01 to 1, with a relative error below 5e-7.
#[inline(always)]
fn cbrt(v: f32) -> f32 {
    // Minus a third of the bits is about minus a third of the logarithm: v^(-1/3) within 3.5 %. Each step of
    // Newton's method doubles the square of the error, and needs no division.
    let third = ((v.to_bits() >> 14) * 21_845) >> 2;
    let first = f32::from_bits(0x54a2_1d2a - third);
    let v3 = v * (1.0 / 3.0);
    let step = |root: f32| root * (4.0 / 3.0 - v3 * (root * root * root));
    let inverse = step(step(step(first)));
    v * (inverse * inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_difference_is_that_of_green_and_blue() {
        let colours = Colours::new();
        assert!((f64::from(colours.knee) / KNEE - 41.2761).abs() < 1e-4, "{}", colours.knee);
    }

    #[test]
    fn white_is_white_and_the_way_back_ends_where_it_began() {
        let colours = Colours::new();
        for rgb in [[1.0, 1.0, 1.0], [0.25, 0.5, 0.125], [1.0, 0.0, 0.0], [0.001, 0.0, 0.9]] {
            let relative = multiply(&colours.to_relative, rgb);
            for (found, wanted) in multiply(&colours.to_rgb, relative).iter().zip(rgb) {
                assert!((found - wanted).abs() < 5e-7, "{found} for {wanted}");
            }
        }
        let white = multiply(&colours.to_relative, [1.0; 3]);
        assert!(white.iter().all(|v| (v - 1.0).abs() < 1e-6), "{white:?}");
        let [lightness, a, b] = lab(&colours, [1.0, 0.0, 0.0]);
        assert!((lightness - 100.0).abs() < 1e-4 && a.abs() < 1e-3 && b.abs() < 1e-3);
    }

    #[test]
    fn cube_roots_are_near() {
        let mut worst = 0.0f64;
        for i in 0..200_000 {
            let v = 0.0088 + i as f32 * 5e-6;
            worst = worst.max((f64::from(cbrt(v)) / libm::cbrt(f64::from(v)) - 1.0).abs());
        }
        assert!(worst < 5e-7, "{worst:e}");
    }

    #[test]
    fn rows_agree_with_double_precision() {
        let colours = Colours::new();
        let mut pictures = [Filtered::new(64), Filtered::new(64)];
        for (p, picture) in pictures.iter_mut().enumerate() {
            for i in 0..64 {
                let of = |seed: usize| ((i * 37 + seed * 11 + p * i) % 64) as f32 / 63.0;
                let [y, x, z] = [of(1), of(2), of(3)];
                picture.opponents[0][i] = y;
                picture.opponents[1][i] = 0.2 * (x - y);
                picture.opponents[2][i] = 0.2 * (y - z);
                picture.features[0][i] = 0.5 * of(4);
                picture.features[1][i] = 0.5 * of(5);
            }
        }
        let mut found = [0.0; 64];
        compare(&colours, &pictures[0], &pictures[1], &mut found);
        let relative = XYZ_OF_RGB.map(|row| row.map(|value| value / row.iter().sum::<f64>()));
        let back = inverse(relative);
        let lab = |picture: &Filtered, i: usize| {
            let [y, x, z] = picture.opponents.each_ref().map(|row| f64::from(row[i]));
            let rgb = back.map(|row| dot(row, [x + y, y, y - z]).clamp(0.0, 1.0));
            lab_of_relative(relative.map(|row| dot(row, rgb)))
        };
        for (i, found) in found.iter().enumerate() {
            let [p, q] = &pictures;
            let error = libm::pow(hyab(lab(p, i), lab(q, i)), 0.7);
            let most = 41.276_1;
            let colour = if error < 0.4 * most {
                0.95 * error / (0.4 * most)
            } else {
                0.95 + 0.05 * (error - 0.4 * most) / (0.6 * most)
            };
            let feature = (0..2).map(|f| f64::from((p.features[f][i] - q.features[f][i]).abs()));
            let feature = (feature.fold(0.0, f64::max) / 2f64.sqrt()).sqrt();
            let wanted = if error > 0.0 { libm::pow(colour, 1.0 - feature) } else { 0.0 };
            assert!((f64::from(*found) - wanted).abs() < 1e-5, "{i}: {found} for {wanted}");
        }
        assert!(found[0] <= 0.0, "{}", found[0]);
    }
}
