//! The tone maps of HDR-FLIP.

use multiversion::multiversion;

/// A tone map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tonemap {
    /// The ACES filmic curve in the fit of Narkowicz, for values before its exposure.
    #[default]
    Aces,
    /// The filmic curve of Hable.
    Hable,
    /// Reinhard's curve of luminance.
    Reinhard,
}

/// A ratio of polynomials `(n2 v² + n1 v + n0) / (d2 v² + d1 v + d0)`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rational {
    numerator: [f64; 3],
    denominator: [f64; 3],
}

const ACES: Rational =
    Rational { numerator: [0.9036, 0.018, 0.0], denominator: [0.8748, 0.354, 0.14] };
const HABLE: Rational =
    Rational { numerator: [0.231_683, 0.013_791, 0.0], denominator: [0.18, 0.3, 0.018] };

/// The value that the brightest pixel has in the darkest exposure, and the median in the brightest.
const BRIGHT: f64 = 0.85;

/// Rec.709 luminance.
pub(super) const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// A value whose square is finite; curves are flat there.
const LARGEST: f32 = 1e16;

impl Tonemap {
    /// The name of the word in parameters.
    pub(super) fn find(word: &str) -> Option<Self> {
        match word {
            "aces" => Some(Self::Aces),
            "hable" => Some(Self::Hable),
            "reinhard" => Some(Self::Reinhard),
            _ => None,
        }
    }

    fn rational(self) -> Option<Rational> {
        match self {
            Self::Aces => Some(ACES),
            Self::Hable => Some(HABLE),
            Self::Reinhard => None,
        }
    }

    /// The input that is mapped to [`BRIGHT`].
    pub(super) fn of_bright(self) -> f64 {
        let Some(Rational { numerator, denominator }) = self.rational() else {
            return BRIGHT / (1.0 - BRIGHT);
        };
        // The larger root of numerator - BRIGHT · denominator.
        let [a, b, c]: [f64; 3] = std::array::from_fn(|i| numerator[i] - BRIGHT * denominator[i]);
        (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
    }

    /// Exposes and tone-maps a row; `root` is the root of the gain. Values are clamped to 0 to 1.
    pub(super) fn map(self, root: f32, light: [&[f32]; 3], out: [&mut [f32]; 3]) {
        match self.rational() {
            Some(Rational { numerator, denominator }) => {
                let [n, d] = [numerator, denominator].map(|of| of.map(|value| value as f32));
                for (light, out) in light.into_iter().zip(out) {
                    rational(root, [n, d], light, out);
                }
            }
            None => reinhard(root, light, out),
        }
    }
}

#[inline(always)]
fn exposed(value: f32, root: f32) -> f32 {
    let value = value * root * root;
    if value < LARGEST { value } else { LARGEST }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn rational(root: f32, [n, d]: [[f32; 3]; 2], light: &[f32], out: &mut [f32]) {
    for (out, &light) in out.iter_mut().zip(light) {
        let v = exposed(light, root);
        let mapped = ((n[0] * v + n[1]) * v + n[2]) / ((d[0] * v + d[1]) * v + d[2]);
        *out = if mapped < 1.0 { mapped } else { 1.0 };
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn reinhard(root: f32, [r, g, b]: [&[f32]; 3], out: [&mut [f32]; 3]) {
    let n = r.len();
    let (g, b) = (&g[..n], &b[..n]);
    let [to_r, to_g, to_b] = out.map(|plane| &mut plane[..n]);
    let [wr, wg, wb] = LUMINANCE;
    for x in 0..n {
        let rgb = [r[x], g[x], b[x]].map(|value| exposed(value, root));
        let over = 1.0 / (1.0 + (wr * rgb[0] + wg * rgb[1] + wb * rgb[2]));
        let [mapped_r, mapped_g, mapped_b] = rgb.map(|value| {
            let mapped = value * over;
            if mapped < 1.0 { mapped } else { 1.0 }
        });
        (to_r[x], to_g[x], to_b[x]) = (mapped_r, mapped_g, mapped_b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bright_pixels_have_the_same_value_for_all_curves() {
        for tonemap in [Tonemap::Aces, Tonemap::Hable, Tonemap::Reinhard] {
            let bright = tonemap.of_bright();
            let light = [0.0, bright as f32 / 4.0, 1e30, f32::MAX];
            let mut out = [[0.0; 4]; 3];
            let [r, g, b] = &mut out;
            tonemap.map(2.0, [&light; 3], [r, g, b]);
            let [dark, found, most, beyond] = out[1];
            assert!((f64::from(found) - BRIGHT).abs() < 1e-6, "{tonemap:?}: {found}");
            assert!(
                dark.abs() < 1e-7 && most > 0.99 && most <= 1.0 && beyond <= 1.0,
                "{tonemap:?}"
            );
        }
        assert!((Tonemap::Reinhard.of_bright() - 17.0 / 3.0).abs() < 1e-12);
    }
}
