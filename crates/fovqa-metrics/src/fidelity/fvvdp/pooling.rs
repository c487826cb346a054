//! Pools differences to a number: over pixels, then bands, then temporal channels, then frames, and
//! converts to JOD.

use super::calibration::{BETA, BETA_CHANNELS, CHANNEL_WEIGHTS, JOD_A, LOG10_JOD_B};

/// Q of a band, the normalised norm over its pixels: (Σ D^β / N)^(1/β).
pub(crate) fn over_pixels(sum_of_powers: f64, pixels: usize) -> f64 {
    libm::pow(sum_of_powers / pixels as f64, 1.0 / BETA)
}

/// Q of a temporal channel, the weighted sum over the bands.
pub(crate) fn over_bands(channel: usize, bands: impl Iterator<Item = f64>) -> f64 {
    CHANNEL_WEIGHTS[channel] * bands.sum::<f64>()
}

/// Q of a frame, the norm over its temporal channels; if there is one channel, its Q.
pub(crate) fn over_channels(channels: &[f64]) -> f64 {
    match channels {
        [one] => *one,
        several => {
            let powers = several.iter().map(|q| libm::pow(*q, BETA_CHANNELS));
            libm::pow(powers.sum(), 1.0 / BETA_CHANNELS)
        }
    }
}

/// The contribution of each temporal channel to the norm, as shares of 1.
pub(crate) fn shares_of_channels(channels: &[f64]) -> Vec<f64> {
    let powers: Vec<f64> = channels.iter().map(|q| libm::pow(*q, BETA_CHANNELS)).collect();
    let sum: f64 = powers.iter().sum();
    powers.iter().map(|power| power / sum).collect()
}

/// Just-objectionable differences: 10 for no difference, without a lower limit. `q` is the Q of a
/// frame, or the mean over frames.
pub fn jod(q: f64) -> f64 {
    10.0 - JOD_A * libm::pow(q, jod_exponent())
}

/// b of 10 - a Q^b.
pub(crate) fn jod_exponent() -> f64 {
    libm::pow(10.0, LOG10_JOD_B)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn no_difference_is_ten_to_the_last_bit() {
        assert_eq!(jod(over_channels(&[0.0, 0.0])), 10.0);
        assert_eq!(jod(over_channels(&[0.0])), 10.0);
        assert!(jod(1e9) < 0.0, "there is no lower end");
    }

    #[test]
    fn channels_share_what_they_add_to() {
        assert_eq!(over_channels(&[3.0]), 3.0);
        let shares = shares_of_channels(&[2.0, 2.0]);
        assert_eq!(shares, [0.5, 0.5]);
        let two = over_channels(&[2.0, 2.0]);
        assert!((two - 2.0 * 2.0f64.powf(1.0 / BETA_CHANNELS)).abs() < 1e-12);
    }
}
