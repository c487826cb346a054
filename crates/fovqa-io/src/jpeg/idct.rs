//! From coefficients to samples: the inverse discrete cosine transform.
//!
//! The factorisation is that of Loeffler, Ligtenberg and Moschytz ("Practical fast 1-D DCT algorithms
//! with 11 multiplications", ICASSP 1989) in whole numbers, with as many fractional bits at each
//! place as libjpeg's accurate method has: so samples are the same to the last bit.

use std::num::Wrapping;
use std::ops::{Add, Mul, Shl, Sub};

use multiversion::multiversion;

use super::frame_header::BLOCK;
use super::quantisation::Steps;
use super::sequential::Coefficients;

/// Fractional bits of the constants.
const FRACTION: usize = 13;
/// Fractional bits that are kept between columns and rows.
const KEPT: usize = 2;

/// Eight numbers that go the same way: one of each column, or of each row. Values that no picture
/// has may wrap round.
#[derive(Clone, Copy)]
struct Eight([Wrapping<i32>; BLOCK]);

impl Eight {
    #[inline(always)]
    fn each(self, of: impl Fn(Wrapping<i32>) -> Wrapping<i32>) -> Self {
        Self(self.0.map(of))
    }

    /// Divided by a power of two and rounded.
    #[inline(always)]
    fn rounded(self, bits: usize) -> Self {
        self.each(|v| (v + Wrapping(1 << (bits - 1))) >> bits)
    }
}

impl Add for Eight {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Eight {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl Mul<i32> for Eight {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: i32) -> Self {
        self.each(|v| v * Wrapping(by))
    }
}

impl Shl<usize> for Eight {
    type Output = Self;
    #[inline(always)]
    fn shl(self, bits: usize) -> Self {
        self.each(|v| v << bits)
    }
}

/// A constant of the factorisation, with [`FRACTION`] bits.
const fn fixed(value: f64) -> i32 {
    (value * (1 << FRACTION) as f64 + 0.5) as i32
}

/// The transform along one direction, its result with [`FRACTION`] more bits.
#[inline(always)]
fn along(v: [Eight; BLOCK]) -> [Eight; BLOCK] {
    const SQRT2_COS6: i32 = fixed(0.541_196_100);
    const SQRT2_COS2_LESS_COS6: i32 = fixed(0.765_366_865);
    const SQRT2_COS2_AND_COS6: i32 = fixed(1.847_759_065);
    let turned = (v[2] + v[6]) * SQRT2_COS6;
    let (low, high) = (turned + v[2] * SQRT2_COS2_LESS_COS6, turned - v[6] * SQRT2_COS2_AND_COS6);
    let (sum, difference) = ((v[0] + v[4]) << FRACTION, (v[0] - v[4]) << FRACTION);
    let even = [sum + low, difference + high, difference - high, sum - low];

    let (outer, inner) = (v[7] + v[1], v[5] + v[3]);
    let (third, first) = (v[7] + v[3], v[5] + v[1]);
    let all = (third + first) * fixed(1.175_875_602);
    let outer = outer * fixed(0.899_976_223);
    let inner = inner * fixed(2.562_915_447);
    let third = all - third * fixed(1.961_570_560);
    let first = all - first * fixed(0.390_180_644);
    let odd = [
        v[1] * fixed(1.501_321_110) - outer + first,
        v[3] * fixed(3.072_711_026) - inner + third,
        v[5] * fixed(2.053_119_869) - inner + first,
        v[7] * fixed(0.298_631_336) - outer + third,
    ];
    std::array::from_fn(|i| if i < 4 { even[i] + odd[i] } else { even[7 - i] - odd[7 - i] })
}

#[inline(always)]
fn transposed(v: [Eight; BLOCK]) -> [Eight; BLOCK] {
    std::array::from_fn(|i| Eight(std::array::from_fn(|j| v[j].0[i])))
}

/// The samples of a row of blocks, into rows of `stride` samples. `false` where a block holds a
/// coefficient that no image has.
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn samples(
    blocks: &[Coefficients],
    steps: &Steps,
    stride: usize,
    out: &mut [u8],
) -> bool {
    for (x, block) in blocks.iter().enumerate() {
        if !is_possible(block, steps) {
            return false;
        }
        let rows = out[x * BLOCK..].chunks_mut(stride);
        if block[1..].iter().fold(0, |any, coefficient| any | coefficient) == 0 {
            let flat = flat(i32::from(block[0]) * i32::from(steps[0]));
            rows.for_each(|row| row[..BLOCK].fill(flat));
        } else {
            let whole = transform(block, steps);
            for (row, samples) in rows.zip(whole) {
                row[..BLOCK].copy_from_slice(&samples);
            }
        }
    }
    true
}

/// Whether all coefficients are within what 8-bit samples can have: damage often makes means drift
/// off, and Huffman codes do not show it.
#[inline(always)]
fn is_possible(block: &Coefficients, steps: &Steps) -> bool {
    // The largest coefficient of samples from -128 to 127 is 1024, and half a step is added when it
    // is rounded. Twice as much leaves room for encoders that overshoot on purpose.
    const MOST: i32 = 2048;
    let excess = |(value, step): (&i16, &u16)| {
        let step = i32::from(*step);
        (i32::from(*value) * step).abs() - step / 2 > MOST
    };
    !block.iter().zip(steps).fold(false, |any, coefficient| any | excess(coefficient))
}

/// A block that is all mean.
#[inline(always)]
fn flat(mean: i32) -> u8 {
    sample((mean + 4) >> 3)
}

#[inline(always)]
fn sample(value: i32) -> u8 {
    const MIDDLE: i32 = 128;
    (value + MIDDLE).clamp(0, 255) as u8
}

#[inline(always)]
fn transform(block: &Coefficients, steps: &Steps) -> [[u8; BLOCK]; BLOCK] {
    let value = |i: usize| Wrapping(i32::from(block[i])) * Wrapping(i32::from(steps[i]));
    let rows = std::array::from_fn(|y| Eight(std::array::from_fn(|x| value(y * BLOCK + x))));
    let columns_done = along(rows).map(|v| v.rounded(FRACTION - KEPT));
    let rows_done = along(transposed(columns_done)).map(|v| v.rounded(FRACTION + KEPT + 3));
    transposed(rows_done).map(|row| row.0.map(|v| sample(v.0)))
}
