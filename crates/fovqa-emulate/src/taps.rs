//! Taps of many places at once, computed on as many as a vector holds.

use multiversion::multiversion;

use crate::fetch::Tap;

/// Places that are looked at together.
pub(crate) const PLACES: usize = 64;

/// In floats from 2^52 on all are whole, so that adding this rounds to whole numbers, which are then
/// its lower bits.
const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;

/// Taps along one axis.
#[derive(Debug, Clone)]
pub(crate) struct Taps {
    at: [u32; PLACES],
    next: [u32; PLACES],
    t: [f32; PLACES],
}

impl Taps {
    pub(crate) fn new() -> Self {
        Self { at: [0; PLACES], next: [0; PLACES], t: [0.0; PLACES] }
    }

    /// At coordinates `origin + factor * values` among `n` pixels, clamped to them; of up to [`PLACES`]
    /// values.
    #[inline]
    pub(crate) fn set(&mut self, origin: f64, factor: f64, values: &[f64], n: usize) {
        set(self, [origin, factor], values, n as u32 - 1);
    }

    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Tap {
        Tap { at: self.at[i], next: self.next[i], t: self.t[i] }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn set(taps: &mut Taps, [origin, factor]: [f64; 2], values: &[f64], last: u32) {
    let outs = taps.at.iter_mut().zip(&mut taps.next).zip(&mut taps.t);
    for (((at, next), t), value) in outs.zip(values) {
        let a = (origin + factor * value - 0.5).max(0.0).min(f64::from(last));
        // To the nearest of a - 0.5: at a whole number either neighbour will do, with t = 0 or 1.
        let whole = (a - 0.5) + WHOLE;
        *at = whole.to_bits() as u32;
        *next = (*at + 1).min(last);
        *t = (a - (whole - WHOLE)) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn are_those_of_single_places() {
        let values: Vec<f64> = (0..PLACES).map(|i| i as f64 * 0.37 - 3.0).collect();
        let mut taps = Taps::new();
        for n in [1, 2, 7, 20] {
            taps.set(0.5, 1.0, &values, n);
            for (i, value) in values.iter().enumerate() {
                let (found, tap) = (taps.get(i), Tap::clamped(value + 0.5, n));
                let place = |tap: Tap| tap.at as f32 + tap.t * (tap.next - tap.at) as f32;
                assert!((place(found) - place(tap)).abs() < 1e-5, "{value} of {n}");
                assert!((found.next as usize) < n && (0.0..=1.0).contains(&found.t));
            }
        }
    }
}
