//! Numbers that look random and are the same on every machine.

/// A well mixed number for three whole numbers and a seed (the finaliser of MurmurHash3).
pub(crate) fn hash(x: i64, y: i64, z: i64, seed: u64) -> u64 {
    let parts = [x as u64, y as u64, z as u64];
    let joined = parts.into_iter().fold(seed ^ 0x9e37_79b9_7f4a_7c15, |state, part| {
        let state = (state ^ part).wrapping_mul(0xff51_afd7_ed55_8ccd);
        state ^ (state >> 32)
    });
    let mixed = joined.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    mixed ^ (mixed >> 33)
}

/// A number from 0 up to, but not including, 1.
pub(crate) fn random(x: i64, y: i64, z: i64, seed: u64) -> f64 {
    (hash(x, y, z, seed) >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise in the plane with a wavelength of about 2, from 0 to 1.
pub(crate) fn smooth(x: f64, y: f64, seed: u64) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let (u, v) = (ease(x - i), ease(y - j));
    let (i, j) = (i as i64, j as i64);
    let at = |di: i64, dj: i64| random(i + di, j + dj, 0, seed);
    let (low, high) = (lerp(at(0, 0), at(1, 0), u), lerp(at(0, 1), at(1, 1), u));
    lerp(low, high, v)
}

/// Smooth noise of some octaves, each with twice the frequency and half the strength; 0 to 1.
pub(crate) fn octaves(x: f64, y: f64, octaves: u32, seed: u64) -> f64 {
    let (mut sum, mut all, mut scale, mut weight) = (0.0, 0.0, 1.0, 1.0);
    for octave in 0..octaves {
        sum += weight * smooth(x * scale, y * scale, seed + u64::from(octave));
        all += weight;
        scale *= 2.0;
        weight *= 0.5;
    }
    sum / all
}

/// 0 for 0 and below, 1 for 1 and above, with a smooth rise between.
pub(crate) fn ease(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// [`ease`] between two limits.
pub(crate) fn rise(from: f64, to: f64, at: f64) -> f64 {
    ease((at - from) / (to - from))
}

pub(crate) fn lerp(a: f64, b: f64, share: f64) -> f64 {
    a + (b - a) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_spread_evenly_and_never_jumps() {
        let values: Vec<f64> = (0..4000).map(|i| random(i, -i, 3, 7)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
        assert!(values.iter().all(|value| (0.0..1.0).contains(value)));
        assert_ne!(hash(1, 2, 3, 0), hash(2, 1, 3, 0));
        for i in 0..2000 {
            let x = f64::from(i) * 0.01 - 7.0;
            let [a, b] = [octaves(x, 0.3, 3, 1), octaves(x + 1e-6, 0.3, 3, 1)];
            assert!((a - b).abs() < 1e-4 && (0.0..=1.0).contains(&a));
        }
    }
}
