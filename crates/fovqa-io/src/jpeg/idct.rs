//! The inverse discrete cosine transform, from coefficients to samples.
//!
//! The factorisation is that of Loeffler, Ligtenberg and Moschytz ("Practical fast 1-D DCT
//! algorithms with 11 multiplications", ICASSP 1989) in integers. At each step it has as many
//! fractional bits as libjpeg's accurate method, so that samples are equal to the last bit.

use std::num::Wrapping;

use multiversion::multiversion;

use super::frame_header::BLOCK;
use super::quantisation::{COEFFICIENTS, Steps};
use super::sequential::Coefficients;

/// Fractional bits of the constants.
const FRACTION: usize = 13;
/// Fractional bits that are kept between the column and the row transform.
const KEPT: usize = 2;

/// The numbers of a block, row by row.
type Block = [i32; COEFFICIENTS];

/// A constant of the factorisation, with [`FRACTION`] fractional bits.
const fn fixed(value: f64) -> i32 {
    (value * (1 << FRACTION) as f64 + 0.5) as i32
}

/// The transform of each column, divided by a power of two and rounded. `bits` is the number of
/// bits that are removed, of which [`FRACTION`] come from the constants. Numbers that no valid
/// image has may wrap around.
#[inline(always)]
fn columns(values: &Block, bits: usize) -> Block {
    let mut out = [0; COEFFICIENTS];
    // One column per iteration: the compiler vectorises it to eight columns at once.
    for x in 0..BLOCK {
        let at = |y: usize| values[y * BLOCK + x];
        let column = [at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)].map(Wrapping);
        let [even, odd] = halves(column);
        for y in 0..BLOCK / 2 {
            let rounded = |v: Wrapping<i32>| ((v + Wrapping(1 << (bits - 1))) >> bits).0;
            out[y * BLOCK + x] = rounded(even[y] + odd[y]);
            out[(BLOCK - 1 - y) * BLOCK + x] = rounded(even[y] - odd[y]);
        }
    }
    out
}

/// Two halves whose sums and differences are the transform of eight numbers, from both ends
/// inwards.
#[inline(always)]
fn halves(v: [Wrapping<i32>; BLOCK]) -> [[Wrapping<i32>; BLOCK / 2]; 2] {
    let times = |v: Wrapping<i32>, constant: i32| v * Wrapping(constant);
    let turned = times(v[2] + v[6], const { fixed(0.541_196_100) });
    let low = turned + times(v[2], const { fixed(0.765_366_865) });
    let high = turned - times(v[6], const { fixed(1.847_759_065) });
    let (sum, difference) = ((v[0] + v[4]) << FRACTION, (v[0] - v[4]) << FRACTION);

    let (third, first) = (v[7] + v[3], v[5] + v[1]);
    let all = times(third + first, const { fixed(1.175_875_602) });
    let outer = times(v[7] + v[1], const { fixed(0.899_976_223) });
    let inner = times(v[5] + v[3], const { fixed(2.562_915_447) });
    let third = all - times(third, const { fixed(1.961_570_560) });
    let first = all - times(first, const { fixed(0.390_180_644) });
    [
        [sum + low, difference + high, difference - high, sum - low],
        [
            times(v[1], const { fixed(1.501_321_110) }) - outer + first,
            times(v[3], const { fixed(3.072_711_026) }) - inner + third,
            times(v[5], const { fixed(2.053_119_869) }) - inner + first,
            times(v[7], const { fixed(0.298_631_336) }) - outer + third,
        ],
    ]
}

#[inline(always)]
fn transposed(values: &Block) -> Block {
    let mut out = [0; COEFFICIENTS];
    for y in 0..BLOCK {
        for x in 0..BLOCK {
            out[y * BLOCK + x] = values[x * BLOCK + y];
        }
    }
    out
}

/// Writes the samples of a row of blocks into rows of `stride` samples. `false` if a block holds a
/// coefficient that no valid image has.
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
            for (row, samples) in rows.zip(whole.as_chunks::<BLOCK>().0) {
                row[..BLOCK].copy_from_slice(samples);
            }
        }
    }
    true
}

/// Whether all coefficients are possible for 8-bit samples. Damage often makes means drift away,
/// and Huffman codes cannot detect it.
#[inline(always)]
fn is_possible(block: &Coefficients, steps: &Steps) -> bool {
    // The largest coefficient of samples from -128 to 127 is 1024, and rounding adds half a step.
    // Twice this value leaves room for encoders that overshoot on purpose.
    const MOST: i32 = 2048;
    let excess = |(value, step): (&i16, &u16)| {
        let step = i32::from(*step);
        (i32::from(*value) * step).abs() - step / 2 > MOST
    };
    !block.iter().zip(steps).fold(false, |any, coefficient| any | excess(coefficient))
}

/// A block with only a mean.
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
fn transform(block: &Coefficients, steps: &Steps) -> [u8; COEFFICIENTS] {
    let mut values = [0; COEFFICIENTS];
    for i in 0..COEFFICIENTS {
        values[i] = i32::from(block[i]) * i32::from(steps[i]);
    }
    let values = columns(&values, FRACTION - KEPT);
    let values = columns(&transposed(&values), FRACTION + KEPT + 3);
    let values = transposed(&values);
    let mut out = [0; COEFFICIENTS];
    for i in 0..COEFFICIENTS {
        out[i] = sample(values[i]);
    }
    out
}

#[cfg(test)]
mod tests {
    use fovqa_testkit::synthetic::Xorshift;

    use super::*;

    /// The literal definition (T.81, A.3.3).
    fn literal(block: &Coefficients, steps: &Steps, x: usize, y: usize) -> f64 {
        let cosine = |at: usize, frequency: usize| {
            let scale = if frequency == 0 { 0.5f64.sqrt() } else { 1.0 };
            scale * ((2 * at + 1) as f64 * frequency as f64 * std::f64::consts::PI / 16.0).cos()
        };
        let term = |i: usize| {
            let value = f64::from(block[i]) * f64::from(steps[i]);
            value * cosine(x, i % BLOCK) * cosine(y, i / BLOCK) / 4.0
        };
        (0..COEFFICIENTS).map(term).sum::<f64>() + 128.0
    }

    #[test]
    fn is_the_transform_of_the_standard() {
        let mut random = Xorshift::new(3);
        let steps = std::array::from_fn(|i| 1 + i as u16 / 4);
        for _ in 0..200 {
            let mut blocks = [[0i16; COEFFICIENTS]; 2];
            blocks[0][0] = (random.next_unit() * 800.0 - 400.0) as i16;
            blocks[1] = std::array::from_fn(|i| {
                (80.0 * (random.next_unit() - 0.5) / (1 + i % 8 + i / 8) as f64) as i16
            });
            let mut out = [0; 2 * COEFFICIENTS];
            assert!(samples(&blocks, &steps, 16, &mut out));
            for (i, found) in out.iter().enumerate() {
                let (x, y) = (i % 16, i / 16);
                let wanted = literal(&blocks[x / 8], &steps, x % 8, y).clamp(0.0, 255.0);
                assert!((f64::from(*found) - wanted).abs() < 0.75, "{found} for {wanted}");
            }
        }
    }

    #[test]
    fn coefficients_that_no_image_has() {
        let mut out = [0; COEFFICIENTS];
        let mut possible = |value: i16, step: u16| {
            let mut block = [0; COEFFICIENTS];
            block[9] = value;
            samples(&[block], &[step; COEFFICIENTS], BLOCK, &mut out)
        };
        assert!(possible(1024, 1) && possible(-64, 16) && possible(1, 2000) && possible(0, 65535));
        assert!(!possible(-2100, 1) && !possible(300, 16) && !possible(i16::MIN, u16::MAX));
    }
}
