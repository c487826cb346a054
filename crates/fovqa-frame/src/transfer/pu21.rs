//! PU21: from luminance to units in which equal steps are about equally visible (Mantiuk, Azimi
//! 2021, "PU21: A novel perceptually uniform encoding for adapting existing quality metrics for
//! HDR", banding and glare).

use std::sync::LazyLock;

use super::chords::Chords;

/// The lowest luminance of the encoding, in cd/m². Darker values are clamped to it.
pub const FLOOR_CD_M2: f64 = 0.005;
/// The highest luminance of the encoding, in cd/m². Brighter values are clamped to it.
pub const PEAK_CD_M2: f64 = 10_000.0;

/// p0 to p6 of "banding_glare".
const P: [f64; 7] = [
    234.023_561_8,
    216.933_928_6,
    0.000_109_186_423_7,
    0.893_206_924,
    0.067_339_841_21,
    1.444_718_567,
    567.631_506_5,
];

/// Converts luminance in cd/m² to PU21 units, 0 to 567.
pub fn encode(luminance_cd_m2: f64) -> f64 {
    let power = libm::pow(luminance_cd_m2.clamp(FLOOR_CD_M2, PEAK_CD_M2), P[3]);
    P[6] * (libm::pow((P[0] + P[1] * power) / (1.0 + P[2] * power), P[4]) - P[5])
}

/// Chords from 2^-8, below the floor, to 2^14, above the peak. With 2^9 chords per octave, the
/// error of a chord is (2^-9)² / 8 of the curvature: at most 3e-5 units, which is the step of an
/// `f32` there.
type EncodeChords = Chords<9, -8>;
const OCTAVES: u32 = 22;

static CHORDS: LazyLock<EncodeChords> = LazyLock::new(|| Chords::new(OCTAVES, encode));

/// [`encode`] for many `f32` values, by chords.
#[derive(Debug, Clone, Copy)]
pub struct Encoder {
    chords: &'static EncodeChords,
}

impl Encoder {
    /// The encoder. Its table is computed once per process.
    pub fn new() -> Self {
        Self { chords: &CHORDS }
    }

    /// Encodes one value, within 2e-4 units of [`encode`].
    #[inline]
    pub fn encode(self, luminance_cd_m2: f32) -> f32 {
        // `max` comes first: the maximum of NaN and a number is the number.
        self.chords.at(luminance_cd_m2.max(FLOOR_CD_M2 as f32).min(PEAK_CD_M2 as f32))
    }
}

impl Default for Encoder {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // By design 100 cd/m² is about 256, and the floor is 0.
        for (luminance, units) in [
            (0.005, 0.0),
            (0.1, 5.756_805_64),
            (1.0, 36.560_429_38),
            (100.0, 256.417_341_13),
            (1000.0, 411.383_002_14),
            (10_000.0, 566.633_957_93),
        ] {
            assert!((encode(luminance) - units).abs() < 1e-6, "{luminance}: {}", encode(luminance));
        }
        assert_eq!(encode(-1.0).to_bits(), encode(FLOOR_CD_M2).to_bits());
        assert_eq!(encode(1e9).to_bits(), encode(PEAK_CD_M2).to_bits());
    }

    #[test]
    fn chords_follow_the_curve() {
        let encoder = Encoder::new();
        let mut worst = 0.0f64;
        for i in 0..200_000 {
            let luminance = libm::exp2(-8.0 + 22.0 * f64::from(i) / 199_999.0) as f32;
            let error = f64::from(encoder.encode(luminance)) - encode(f64::from(luminance));
            worst = worst.max(error.abs());
        }
        assert!(worst < 2e-4, "{worst:e}");
        assert!((f64::from(encoder.encode(f32::NAN)) - encode(FLOOR_CD_M2)).abs() < 2e-4);
    }
}
