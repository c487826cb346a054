//! The two temporal channels: sustained (0 Hz) and transient (5 Hz).
//!
//! n = ceil(0.25 s · fps) taps at t_i = i (n / fps) / (n - 1), both ends included, so that the step
//! is not 1 / fps. S_i = exp(-(ln(t_i + 1e-4) - ln 0.06)² / (2 · 0.5²)), normalised to the sum 1;
//! T_i = k (S_{i+1} - S_i) / (t_1 - t_0), and 0 for the last. Tap i belongs to the frame i steps in
//! the past.

use super::calibration::{FILTER_S, SUSTAINED_PEAK_S, SUSTAINED_SIGMA, TRANSIENT_GAIN};

/// At and below this frame rate there is only one tap, from which no filter can be made.
pub const TOO_SLOW_FPS: f64 = 4.0;
/// The highest frame rate, because every tap is a frame in memory.
pub const FASTEST_FPS: f64 = 1000.0;

/// The taps of both filters, the present frame's first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TemporalFilters {
    /// Sustained, then transient.
    pub(crate) taps: [Vec<f64>; 2],
}

impl TemporalFilters {
    /// The filters at a frame rate, above [`TOO_SLOW_FPS`].
    pub(crate) fn new(fps: f64) -> Self {
        // The division is that of the reference program: 24 frames per second make 6 taps, and 90
        // make 23.
        let n = ((FILTER_S * 1000.0 / (1000.0 / fps)).ceil() as usize).max(2);
        let step = n as f64 / fps / (n - 1) as f64;
        let response = |i: usize| {
            let log = libm::log(i as f64 * step + 1e-4) - libm::log(SUSTAINED_PEAK_S);
            libm::exp(-log * log / (2.0 * SUSTAINED_SIGMA * SUSTAINED_SIGMA))
        };
        let responses: Vec<f64> = (0..n).map(response).collect();
        let sum: f64 = responses.iter().sum();
        let sustained: Vec<f64> = responses.iter().map(|value| value / sum).collect();
        let rise = sustained.windows(2).map(|pair| TRANSIENT_GAIN * (pair[1] - pair[0]) / step);
        let transient = rise.chain([0.0]).collect();
        Self { taps: [sustained, transient] }
    }

    /// The number of taps of each filter.
    pub(crate) fn len(&self) -> usize {
        self.taps[0].len()
    }
}
