//! Functions of the distance from the gaze alone, as chords over its square, picked by the bits of the
//! square: logarithms, tangents and powers for each pixel of each frame would cost more than the rest.

use multiversion::multiversion;
use rayon::prelude::*;

/// How many distances are looked at together.
pub(crate) const MOST: usize = 64;

/// Squares of distances below 2^FROM count as that: 1/16 px.
const FROM: u32 = 8;
const FROM_BITS: u32 = (127 - FROM) << 23;
const MANTISSA_BITS: u32 = 23;

/// How many chords an octave of the squared distance has, as a power of two. With 2^n of them a value
/// is off by (2^-n)² / 8 of the curvature over the logarithm: for coordinates in a buffer 1e-4
/// samples with [`Detail::Coarse`].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Detail {
    /// For functions that take long.
    Coarse,
    /// For sums over all pixels too.
    Fine,
}

/// A function of the distance from the gaze.
#[derive(Debug, Clone)]
pub(crate) struct Radial {
    /// Where chords begin, and how far they rise.
    chords: Vec<[f32; 2]>,
    fraction_bits: u32,
}

impl Radial {
    /// A function of the distance in pixels, asked for a few chords beyond `reach_px` too.
    pub(crate) fn new(
        detail: Detail,
        reach_px: f64,
        of: impl Fn(f64) -> f64 + Sync + Send,
    ) -> Self {
        let segment_bits = match detail {
            Detail::Coarse => 9,
            Detail::Fine => 11,
        };
        let fraction_bits = MANTISSA_BITS - segment_bits;
        let first = FROM_BITS >> fraction_bits;
        let end = ((reach_px * reach_px) as f32).to_bits().max(FROM_BITS) >> fraction_bits;
        let value = |i: u32| {
            let square = f64::from(f32::from_bits(i << fraction_bits));
            of(square.sqrt()) as f32
        };
        // The square of a pixel may be rounded up into the chord behind the last one.
        let values: Vec<f32> =
            (first..end + 4).into_par_iter().with_min_len(1024).map(value).collect();
        let chords = values.windows(2).map(|ends| [ends[0], ends[1] - ends[0]]).collect();
        Self { chords, fraction_bits }
    }

    /// The function at many squared distances, at most [`MOST`]; they make way for the values.
    pub(crate) fn at_all(&self, squares: &mut [f32]) {
        let mut found = [(0, 0.0); MOST];
        let found = &mut found[..squares.len()];
        find(self.fraction_bits, self.chords.len() - 1, squares, found);
        for (value, (index, t)) in squares.iter_mut().zip(found) {
            let [from, rise] = self.chords[*index as usize];
            *value = from + rise * *t;
        }
    }

    /// The function at a squared distance in pixels.
    #[inline(always)]
    pub(crate) fn at(&self, square: f32) -> f32 {
        let offset = square.to_bits().max(FROM_BITS) - FROM_BITS;
        let index = ((offset >> self.fraction_bits) as usize).min(self.chords.len() - 1);
        let fraction = offset & ((1 << self.fraction_bits) - 1);
        let t = fraction as f32 * (1.0 / (1u32 << self.fraction_bits) as f32);
        let [from, rise] = self.chords[index];
        from + rise * t
    }

    /// Of a function that does not fall: from which distance in pixels on it is at least a value.
    pub(crate) fn first(&self, value: f32) -> f32 {
        let index = self.chords.partition_point(|[from, rise]| from + rise < value);
        if index == 0 && self.chords[0][0] >= value { 0.0 } else { self.distance(index, value) }
    }

    /// Of a function that does not fall: up to which distance it is at most a value.
    pub(crate) fn last(&self, value: f32) -> f32 {
        let behind = self.chords.partition_point(|[from, _]| *from <= value);
        behind.checked_sub(1).map_or(0.0, |index| self.distance(index, value))
    }

    /// Where a chord is at a value, or the nearest of its ends.
    fn distance(&self, index: usize, value: f32) -> f32 {
        let index = index.min(self.chords.len() - 1);
        let [from, rise] = self.chords[index];
        let t = if rise > 0.0 { ((value - from) / rise).clamp(0.0, 1.0) } else { 1.0 };
        let first = FROM_BITS >> self.fraction_bits;
        let square = |i: usize| f32::from_bits((first + i as u32) << self.fraction_bits);
        (square(index) + (square(index + 1) - square(index)) * t).sqrt()
    }

    /// The largest value, up to the last chord.
    pub(crate) fn largest(&self) -> f32 {
        self.chords
            .iter()
            .map(|[from, rise]| from.max(from + rise))
            .fold(f32::NEG_INFINITY, f32::max)
    }
}

/// The chords of squared distances, and how far along each, on as many as a vector holds.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn find(fraction_bits: u32, last: usize, squares: &[f32], found: &mut [(u32, f32)]) {
    let scale = 1.0 / (1u32 << fraction_bits) as f32;
    for (square, (index, t)) in squares.iter().zip(found) {
        let offset = square.to_bits().max(FROM_BITS) - FROM_BITS;
        *index = (offset >> fraction_bits).min(last as u32);
        *t = (offset & ((1 << fraction_bits) - 1)) as i32 as f32 * scale;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_follow_the_function() {
        let reach = 2203.0f64;
        let of = |r: f64| 1500.0 * (r.max(1.0).ln() / reach.ln()).powi(4);
        for (detail, bound) in [(Detail::Coarse, 3e-4), (Detail::Fine, 2e-4)] {
            let radial = Radial::new(detail, reach, of);
            let mut worst = 0.0f64;
            for i in 0..=220_300 {
                let r = f64::from(i) / 100.0;
                let exact = of(f64::from((r * r) as f32).sqrt());
                worst = worst.max((f64::from(radial.at((r * r) as f32)) - exact).abs());
            }
            assert!(worst < bound, "{detail:?}: {worst:e}");
            assert!((1.0..1.005).contains(&(radial.largest() / 1500.0)));
        }
    }

    #[test]
    fn distances_lead_back() {
        let of = |r: f64| if r < 3.0 { 2.0 } else { 2.0 + (r - 3.0).sqrt() };
        let radial = Radial::new(Detail::Coarse, 200.0, of);
        for i in 1..=1600 {
            let value = 2.0 + i as f32 / 160.0;
            for r in [radial.first(value), radial.last(value)] {
                assert!((radial.at(r * r) - value).abs() < 1e-4, "{value}: {r}");
            }
        }
        assert!(radial.first(2.0) == 0.0 && (radial.last(2.0) - 3.0).abs() < 0.01);
        assert!(radial.first(1.0) == 0.0 && radial.last(1.0) == 0.0);
        assert!(radial.first(99.0) >= 200.0 && radial.last(99.0) >= 200.0);
    }

    #[test]
    fn the_ends_are_those_of_the_function() {
        let radial = Radial::new(Detail::Coarse, 10.0, |r| r);
        assert!((radial.at(0.0) - 1.0 / 16.0).abs() < 1e-6);
        assert!((radial.at(100.0) - 10.0).abs() < 1e-3, "{}", radial.at(100.0));
        assert!((radial.at(1e9) - 10.0).abs() < 0.1);
    }
}
