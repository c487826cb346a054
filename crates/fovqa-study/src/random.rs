//! The random numbers of bootstraps and simulations: xoshiro256++ (Blackman and Vigna 2021), one
//! generator per replicate. The same seed gives the same bits on every machine.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use crate::distributions::normal_quantile;

/// The increment of SplitMix64.
const GAMMA: u64 = 0x9E37_79B9_7F4A_7C15;

/// The generator of one replicate.
#[derive(Debug, Clone)]
pub struct Replicate(Xoshiro256PlusPlus);

impl Replicate {
    /// The generator of replicate `b` (0, 1, …). Its state are the outputs 4b+1 to 4b+4 of SplitMix64
    /// from the seed.
    pub fn new(seed: u64, b: u64) -> Self {
        let start = seed.wrapping_add(b.wrapping_mul(4).wrapping_mul(GAMMA));
        Self(Xoshiro256PlusPlus::seed_from_u64(start))
    }

    /// The next output.
    pub fn next_u64(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// An index below `n`, which has to be below 2³².
    pub fn index(&mut self, n: usize) -> usize {
        (((self.next_u64() >> 32) * n as u64) >> 32) as usize
    }

    /// `n` indices below `n`, in order: one resampling of `n` units with replacement.
    pub fn resample(&mut self, n: usize) -> Vec<usize> {
        (0..n).map(|_| self.index(n)).collect()
    }

    /// A uniform number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// A number of the standard normal distribution.
    pub fn normal(&mut self) -> f64 {
        normal_quantile(((self.next_u64() >> 11) as f64 + 0.5) * 2.0_f64.powi(-53))
    }

    /// `true` with probability `p`.
    pub fn bernoulli(&mut self, p: f64) -> bool {
        self.uniform() < p
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outputs_of_seed_1_are_the_published_ones() {
        let mut first = Replicate::new(1, 0);
        assert_eq!(first.next_u64(), 0xcfc5_d07f_6f03_c29b);
        assert_eq!(first.next_u64(), 0xbf42_4132_963f_e08d);
        assert_eq!(Replicate::new(1, 1).next_u64(), 0x65ac_e976_687d_8740);
    }

    #[test]
    fn seeds_and_replicates_wrap() {
        Replicate::new(u64::MAX, u64::MAX).next_u64();
    }

    #[test]
    fn indices_are_below_their_limit() {
        let mut random = Replicate::new(3, 0);
        let mut seen = [0; 3];
        for _ in 0..300 {
            seen[random.index(3)] += 1;
        }
        assert!(seen.iter().all(|count| *count > 60), "{seen:?}");
        assert_eq!(random.resample(5).len(), 5);
        assert!((0..100).all(|_| (0.0..1.0).contains(&random.uniform())));
        assert!((0..100).all(|_| random.normal().is_finite()));
    }
}
