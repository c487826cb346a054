//! Pictures out of formulas: the same on every machine.

use fovqa_frame::{Channels, Frame, Samples};

/// Marsaglia's xorshift64: enough randomness for pictures, and no dependency.
#[derive(Debug, Clone)]
pub struct Xorshift(u64);

impl Xorshift {
    /// A generator; seeds differ in their stream.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next number.
    pub fn next_u64(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// The next number in `[0, 1)`.
    pub fn next_unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Interleaved 8-bit codes of a smooth picture with some noise on it.
pub fn codes(width: usize, height: usize, channels: usize, seed: u64) -> Vec<u8> {
    let mut random = Xorshift::new(seed);
    let mut codes = Vec::with_capacity(width * height * channels);
    for y in 0..height {
        for x in 0..width {
            for c in 0..channels {
                let (x, y) = (x as f64, y as f64);
                let wave = (x * 0.21 + c as f64).sin() * (y * 0.13 + 0.5 * c as f64).cos();
                let noise = random.next_unit() - 0.5;
                codes.push((127.5 + 90.0 * wave + 60.0 * noise).clamp(0.0, 255.0) as u8);
            }
        }
    }
    codes
}

/// [`codes`] with other noise on them: a test picture for a reference picture.
pub fn disturbed(codes: &[u8], amount: f64, seed: u64) -> Vec<u8> {
    let mut random = Xorshift::new(seed);
    let disturb = |&code: &u8| {
        let noise = (random.next_unit() - 0.5) * amount;
        (f64::from(code) + noise).round().clamp(0.0, 255.0) as u8
    };
    codes.iter().map(disturb).collect()
}

/// An 8-bit RGB frame of interleaved codes.
///
/// # Panics
/// When the codes are not `3 * width * height`.
pub fn rgb8(width: usize, height: usize, codes: Vec<u8>) -> Frame {
    Frame::new(width, height, Channels::Rgb, Samples::U8(codes.into()))
        .expect("three codes a pixel")
}
