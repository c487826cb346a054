//! The discrete Fourier transform of square blocks.
//!
//! FFT libraries choose their instructions, and with them the last digits of the result, by the
//! machine. This one gives the same digits on every machine: its roots of unity come from `libm`, and
//! every value is computed by the same operations for any vector width.

use multiversion::multiversion;

/// A transform of blocks of N x N complex values; N is a power of two.
#[derive(Debug, Clone)]
pub(super) struct Transform {
    side: usize,
    /// exp(-2πi k/N) for k below N/2: cosine and negative sine.
    roots: Vec<[f64; 2]>,
}

/// A block of complex values, row by row.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) real: Vec<f64>,
    pub(super) imaginary: Vec<f64>,
    /// Memory for transposing.
    spare: Vec<f64>,
}

impl Block {
    pub(super) fn new(side: usize) -> Self {
        let zeros = || vec![0.0; side * side];
        Self { real: zeros(), imaginary: zeros(), spare: zeros() }
    }
}

impl Transform {
    pub(super) fn new(side: usize) -> Self {
        debug_assert!(side.is_power_of_two() && side > 1, "a power of two");
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / side as f64;
        let roots = (0..side / 2).map(|k| [libm::cos(angle(k)), -libm::sin(angle(k))]);
        Self { side, roots: roots.collect() }
    }

    /// Transforms a block in place. The coefficient of frequency (u, v), each from 0 to N - 1, is
    /// then at [`Self::place`].
    pub(super) fn run(&self, block: &mut Block) {
        for _ in 0..2 {
            columns(&self.roots, self.side, &mut block.real, &mut block.imaginary);
            for values in [&mut block.real, &mut block.imaginary] {
                transpose(values, &mut block.spare, self.side);
                std::mem::swap(values, &mut block.spare);
            }
        }
    }

    /// The index of a coefficient of a transformed block: u counts along rows, v along columns.
    pub(super) fn place(&self, u: usize, v: usize) -> usize {
        let bits = self.side.trailing_zeros();
        let reversed = |k: usize| k.reverse_bits() >> (usize::BITS - bits);
        reversed(v) * self.side + reversed(u)
    }
}

/// Transforms every column. Decimation in frequency: row k of the result is at the index with the
/// bits of k reversed.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn columns(roots: &[[f64; 2]], side: usize, real: &mut [f64], imaginary: &mut [f64]) {
    let mut half = side / 2;
    while half > 0 {
        let step = side / 2 / half;
        let part = 2 * half * side;
        for (real, imaginary) in real.chunks_exact_mut(part).zip(imaginary.chunks_exact_mut(part)) {
            let (upper, lower) = real.split_at_mut(half * side);
            let (upper_i, lower_i) = imaginary.split_at_mut(half * side);
            for k in 0..half {
                let row = k * side..(k + 1) * side;
                let upper = (&mut upper[row.clone()], &mut upper_i[row.clone()]);
                let lower = (&mut lower[row.clone()], &mut lower_i[row]);
                butterfly(upper, lower, roots[k * step]);
            }
        }
        half /= 2;
    }
}

/// Replaces two rows a and b by a + b and (a - b) root.
#[inline(always)]
fn butterfly(
    (a_real, a_imaginary): (&mut [f64], &mut [f64]),
    (b_real, b_imaginary): (&mut [f64], &mut [f64]),
    [cosine, sine]: [f64; 2],
) {
    const LANES: usize = 16;
    let a =
        a_real.as_chunks_mut::<LANES>().0.iter_mut().zip(a_imaginary.as_chunks_mut::<LANES>().0);
    let b =
        b_real.as_chunks_mut::<LANES>().0.iter_mut().zip(b_imaginary.as_chunks_mut::<LANES>().0);
    for ((a_real, a_imaginary), (b_real, b_imaginary)) in a.zip(b) {
        for i in 0..LANES {
            let (x, y) = (a_real[i] - b_real[i], a_imaginary[i] - b_imaginary[i]);
            a_real[i] += b_real[i];
            a_imaginary[i] += b_imaginary[i];
            b_real[i] = x * cosine - y * sine;
            b_imaginary[i] = x * sine + y * cosine;
        }
    }
}

/// Writes the transposed block to `out`, tile by tile.
fn transpose(values: &[f64], out: &mut [f64], side: usize) {
    const TILE: usize = 8;
    for y in (0..side).step_by(TILE) {
        for x in (0..side).step_by(TILE) {
            for j in y..y + TILE {
                for i in x..x + TILE {
                    out[i * side + j] = values[j * side + i];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition: Σ z exp(-2πi (u x + v y)/N).
    fn literal(real: &[f64], imaginary: &[f64], side: usize, [u, v]: [usize; 2]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (index, (re, im)) in real.iter().zip(imaginary).enumerate() {
            let turns = (u * (index % side) + v * (index / side)) % side;
            let angle = std::f64::consts::TAU * turns as f64 / side as f64;
            let (sine, cosine) = (-libm::sin(angle), libm::cos(angle));
            sum[0] += re * cosine - im * sine;
            sum[1] += re * sine + im * cosine;
        }
        sum
    }

    #[test]
    fn blocks_are_transformed_by_the_definition() {
        for side in [16, 32] {
            let transform = Transform::new(side);
            let mut block = Block::new(side);
            let value = |i: usize, seed: usize| ((i * 7919 + seed) % 1009) as f64 / 1009.0 - 0.5;
            for i in 0..side * side {
                (block.real[i], block.imaginary[i]) = (value(i * i, 3), value(i, 501));
            }
            let before = block.clone();
            transform.run(&mut block);
            for (u, v) in (0..side).flat_map(|u| (0..side).map(move |v| (u, v))) {
                let want = literal(&before.real, &before.imaginary, side, [u, v]);
                let at = transform.place(u, v);
                let found = [block.real[at], block.imaginary[at]];
                for (found, want) in found.into_iter().zip(want) {
                    assert!((found - want).abs() < 1e-11, "{found} for {want} at {u}, {v}");
                }
            }
        }
    }
}
