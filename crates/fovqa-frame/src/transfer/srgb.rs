//! sRGB (IEC 61966-2-1): the encoding of 8- and 16-bit files, and of linear input after the tone
//! map.

use std::sync::LazyLock;

use super::chords::Chords;

/// The end of the linear toe of the encoding, in linear light.
const TOE_END: f64 = 0.003_130_8;

/// End of the linear toe of the decoding, as an encoded value.
const ENCODED_TOE_END: f64 = 0.040_45;

/// Converts linear light in `[0, 1]` to the encoded value in `[0, 1]`.
pub fn encode(linear: f64) -> f64 {
    if linear <= TOE_END { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Converts an encoded value in `[0, 1]` to linear light in `[0, 1]`.
pub fn decode(encoded: f64) -> f64 {
    if encoded <= ENCODED_TOE_END {
        encoded / 12.92
    } else {
        libm::pow((encoded + 0.055) / 1.055, 2.4)
    }
}

/// Chords from 2^-9, just below the end of the toe, to 1. With 2^10 chords per octave, the error of
/// a chord is (2^-10)² / 8 of the curvature: 3e-8 relative, which is below the step of an `f32`.
type EncodeChords = Chords<10, -9>;
const OCTAVES: u32 = 9;

static CHORDS: LazyLock<EncodeChords> = LazyLock::new(|| Chords::new(OCTAVES, encode));

/// [`encode`] for many `f32` values, by chords. Values are clamped to `[0, 1]`.
#[derive(Debug, Clone, Copy)]
pub struct Encoder {
    chords: &'static EncodeChords,
}

impl Encoder {
    /// The encoder. Its table is computed once per process.
    pub fn new() -> Self {
        Self { chords: &CHORDS }
    }

    /// Encodes one value, within 1e-7 of [`encode`].
    #[inline]
    pub fn encode(self, linear: f32) -> f32 {
        if linear >= 1.0 {
            return 1.0;
        }
        // NaN takes this branch too, and `max` makes it 0.
        if linear.is_nan() || linear <= TOE_END as f32 {
            return 12.92 * linear.max(0.0);
        }
        self.chords.at(linear)
    }
}

impl Default for Encoder {
    fn default() -> Self {
        Self::new()
    }
}

/// Chords from 2^-5, below the end of the toe, to 1. The error of one of 2^12 an octave, (2^-12)² / 8
/// of the curvature, is 3e-8 relative: below the step of an `f32`.
type DecodeChords = Chords<12, -5>;
const DECODE_OCTAVES: u32 = 5;

static DECODE_CHORDS: LazyLock<DecodeChords> =
    LazyLock::new(|| Chords::new(DECODE_OCTAVES, decode));

/// [`decode`] for many `f32` values, by chords. Values are clamped to `[0, 1]`.
#[derive(Debug, Clone, Copy)]
pub struct Decoder {
    chords: &'static DecodeChords,
}

impl Decoder {
    /// The decoder; its table is computed once a process.
    pub fn new() -> Self {
        Self { chords: &DECODE_CHORDS }
    }

    /// Decodes one value, within 1e-7 of [`decode`].
    #[inline]
    pub fn decode(self, encoded: f32) -> f32 {
        if encoded >= 1.0 {
            return 1.0;
        }
        // NaN goes this way too, and `max` makes it 0.
        if encoded.is_nan() || encoded <= ENCODED_TOE_END as f32 {
            return encoded.max(0.0) / 12.92;
        }
        self.chords.at(encoded)
    }
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((encode(0.215_860_5) - 0.501_960_8).abs() < 1e-6, "code 128");
        assert!((decode(0.5) - 0.214_041_14).abs() < 1e-8);
        assert!((encode(1.0) - 1.0).abs() < 1e-15);
        for i in 0..=1000 {
            let v = f64::from(i) / 1000.0;
            // The two thresholds of the standard differ in their last digits.
            assert!((decode(encode(v)) - v).abs() < 1e-7);
        }
    }

    #[test]
    fn chords_follow_the_curve() {
        let encoder = Encoder::new();
        let mut worst = 0.0f64;
        for i in 0..200_000 {
            let v = (i as f32 / 199_999.0).powi(3);
            worst = worst.max((f64::from(encoder.encode(v)) - encode(f64::from(v))).abs());
        }
        assert!(worst < 1.2e-7, "{worst:e}");
        assert_eq!(encoder.encode(60_000.0).to_bits(), 1.0f32.to_bits());
        assert_eq!(encoder.encode(-3.0).to_bits(), 0.0f32.to_bits());
        assert_eq!(encoder.encode(f32::NAN).to_bits(), 0.0f32.to_bits());
    }

    #[test]
    fn chords_decode_what_they_encode() {
        let (encoder, decoder) = (Encoder::new(), Decoder::new());
        let (mut worst, mut returned) = (0.0f64, 0.0f32);
        for i in 0..=200_000 {
            let v = i as f32 / 200_000.0;
            worst = worst.max((f64::from(decoder.decode(v)) - decode(f64::from(v))).abs());
            returned = returned.max((encoder.encode(decoder.decode(v)) - v).abs());
        }
        assert!(worst < 1.2e-7, "{worst:e}");
        assert!(returned < 1e-6, "{returned:e}");
        assert_eq!(decoder.decode(2.0).to_bits(), 1.0f32.to_bits());
        assert_eq!(decoder.decode(f32::NAN).to_bits(), 0.0f32.to_bits());
    }
}
