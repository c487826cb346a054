//! A contrast-sensitivity chart: a grating whose frequency rises to the right and whose contrast falls
//! downwards, after Campbell and Robson (1968, Application of Fourier analysis to the visibility of
//! gratings).

use fovqa_frame::transfer::srgb;
use fovqa_vision::View;

use crate::frame_scene::{FrameScene, Surface};

/// The chart.
#[derive(Debug)]
pub(crate) struct CsfChart {
    view: View,
    /// Cycles per pixel at the left edge.
    lowest: f64,
    /// The factor by which the frequency rises over the width, as its logarithm.
    rise: f64,
}

/// Frequency at the right edge in cycles per pixel: the display shows no more.
const HIGHEST: f64 = 0.5;

/// The contrast falls from 1 to this, logarithmically.
const LEAST_CONTRAST: f64 = 0.003;

impl CsfChart {
    pub(crate) fn new(view: View) -> Self {
        let lowest = 1.5 / view.width as f64;
        Self { view, lowest, rise: libm::log(HIGHEST / lowest) }
    }

    pub(crate) fn frame(&self) -> &Self {
        self
    }
}

impl FrameScene for &CsfChart {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        let (width, height) = (self.view.width as f64, self.view.height as f64);
        // The integral of the frequency.
        let cycles = self.lowest * width / self.rise * (libm::exp(self.rise * x / width) - 1.0);
        let wave = libm::sin(2.0 * std::f64::consts::PI * cycles);
        let contrast = libm::exp(libm::log(LEAST_CONTRAST) * (y / height).clamp(0.0, 1.0));
        // The middle gray of an sRGB display; contrast is that of linear light (Michelson).
        let mean = srgb::decode(0.5);
        [(mean * (1.0 + contrast * wave)) as f32; 3]
    }

    fn surface(&self, _x: f64, _y: f64) -> Surface {
        Surface { depth_m: 1.0, motion_px: Some([0.0; 2]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequency_rises_and_contrast_falls() {
        let view =
            View { width: 1000, height: 400, focal_px: [500.0; 2], principal_px: [500.0, 200.0] };
        let chart = CsfChart::new(view);
        let frame = &chart;
        let mean = srgb::decode(0.5);
        let crossings = |from: usize| {
            let value = |i: usize| f64::from(frame.light(i as f64 / 10.0, 0.0)[0]) - mean;
            (10 * from..10 * from + 1000).filter(|i| value(*i) * value(i + 1) < 0.0).count()
        };
        assert!(crossings(0) < 3 && crossings(900) > 70, "{} {}", crossings(0), crossings(900));
        let contrast = |y: f64| {
            let values = (0..10_000).map(|i| f64::from(frame.light(f64::from(i) / 10.0, y)[0]));
            values.fold(0.0, |most: f64, value| most.max((value - mean).abs())) / mean
        };
        assert!(
            (contrast(0.0) - 1.0).abs() < 0.01 && (contrast(400.0) - LEAST_CONTRAST).abs() < 1e-4
        );
    }
}
