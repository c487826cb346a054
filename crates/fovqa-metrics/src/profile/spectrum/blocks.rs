//! The power of blocks by frequency.

use super::fft::{Block, Transform};

/// What all blocks of a picture have in common.
pub(super) struct Blocks {
    side: usize,
    transform: Transform,
    /// w_i = sin²(π (i + ½)/B).
    window: Vec<f64>,
    /// Σ w_i w_j.
    weight: f64,
    /// 1/(B² Σ w_i² w_j²).
    scale: f64,
    /// u² + v² of each ring, rising, without 0.
    squares: Vec<u32>,
    /// The number of frequencies on each ring.
    counts: Vec<u32>,
    pairs: Vec<Opposite>,
}

/// Two frequencies (u, v) and (-u, -v), which have the same power.
struct Opposite {
    places: [u32; 2],
    ring: u32,
    /// 2, or 1 for a frequency that is its own opposite.
    count: f64,
}

/// Memory for blocks.
pub(super) struct Scratch {
    block: Block,
    /// The power on each ring, of both blocks.
    rings: [Vec<f64>; 2],
}

impl Blocks {
    pub(super) fn new(side: usize) -> Self {
        let transform = Transform::new(side);
        let window = (0..side).map(|i| {
            let sine = libm::sin(std::f64::consts::PI * (i as f64 + 0.5) / side as f64);
            sine * sine
        });
        let window: Vec<f64> = window.collect();
        let sum: f64 = window.iter().sum();
        let squares_sum: f64 = window.iter().map(|w| w * w).sum();
        // Frequencies are from -B/2 to B/2 - 1.
        let distance = |k: usize| k.min(side - k) as u32;
        let square = |u: usize, v: usize| distance(u) * distance(u) + distance(v) * distance(v);
        let all = || (0..side).flat_map(|v| (0..side).map(move |u| (u, v)));
        let mut squares: Vec<u32> = all().map(|(u, v)| square(u, v)).collect();
        squares.sort_unstable();
        squares.dedup();
        squares.remove(0);
        let ring = |square: u32| squares.binary_search(&square).ok();
        let mut counts = vec![0; squares.len()];
        let mut pairs = Vec::new();
        for (u, v) in all() {
            let Some(ring) = ring(square(u, v)) else { continue };
            let opposite = ((side - u) % side, (side - v) % side);
            let [here, there] = [(u, v), opposite].map(|(u, v)| transform.place(u, v) as u32);
            if here <= there {
                let count = if here == there { 1 } else { 2 };
                counts[ring] += count;
                let (places, ring) = ([here, there], ring as u32);
                pairs.push(Opposite { places, ring, count: f64::from(count) });
            }
        }
        let scale = 1.0 / ((side * side) as f64 * squares_sum * squares_sum);
        Self { side, transform, window, weight: sum * sum, scale, squares, counts, pairs }
    }

    pub(super) fn scratch(&self) -> Scratch {
        let rings = || vec![0.0; self.squares.len()];
        Scratch { block: Block::new(self.side), rings: [rings(), rings()] }
    }

    /// u² + v² of each ring, rising, and the number of frequencies on it.
    pub(super) fn rings(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.squares.iter().copied().zip(self.counts.iter().copied())
    }

    /// The power on each ring, of two blocks; the second may be missing. `strip` has B rows of `width`
    /// luma values, and `columns` are the first columns of the blocks.
    pub(super) fn power<'a>(
        &self,
        strip: &[f64],
        width: usize,
        columns: [Option<usize>; 2],
        scratch: &'a mut Scratch,
    ) -> &'a [Vec<f64>; 2] {
        let Scratch { block, rings } = scratch;
        // Both blocks are transformed together, one as real and one as imaginary part.
        for (part, column) in [&mut block.real, &mut block.imaginary].into_iter().zip(columns) {
            match column {
                Some(column) => self.fill(strip, width, column, part),
                None => part.fill(0.0),
            }
        }
        self.transform.run(block);
        for ring in rings.iter_mut() {
            ring.fill(0.0);
        }
        let [first, second] = rings;
        for pair in &self.pairs {
            let [here, there] = pair.places.map(|place| place as usize);
            let [a, b] = [block.real[here], block.imaginary[here]];
            let [c, d] = [block.real[there], block.imaginary[there]];
            // The transform of real values at -f is the conjugate of that at f. So half the sum of
            // Z(f) and Z*(-f) belongs to the real part, and half their difference to the other.
            let of_first = (a + c) * (a + c) + (b - d) * (b - d);
            let of_second = (b + d) * (b + d) + (c - a) * (c - a);
            first[pair.ring as usize] += pair.count * of_first;
            second[pair.ring as usize] += pair.count * of_second;
        }
        for value in rings.iter_mut().flatten() {
            *value *= 0.25 * self.scale;
        }
        rings
    }

    /// Fills `out` with q_ij = w_i w_j (Y_ij - Ȳ).
    fn fill(&self, strip: &[f64], width: usize, column: usize, out: &mut [f64]) {
        let rows = || strip.chunks_exact(width).map(|row| &row[column..column + self.side]);
        let mut sum = 0.0;
        for (row, w) in rows().zip(&self.window) {
            let products = row.iter().zip(&self.window).map(|(y, w)| y * w);
            sum += w * products.sum::<f64>();
        }
        let mean = sum / self.weight;
        for ((row, w), out) in rows().zip(&self.window).zip(out.chunks_exact_mut(self.side)) {
            for ((out, y), v) in out.iter_mut().zip(row).zip(&self.window) {
                *out = w * v * (y - mean);
            }
        }
    }
}
