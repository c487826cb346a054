//! The part that kernel foveated rendering and log-polar foveated rendering have in common: the
//! normalised logarithm of the distance, and a buffer of w x h samples.

use std::f64::consts::TAU;

use crate::error::MethodError;
use crate::foveation::Counts;
use crate::setting::{Place, Setting};

/// z = ln r / ln L, where L is the distance from the gaze to the farthest corner, and a buffer of
/// W/σ x H/σ.
///
/// Inside one pixel, r is set to 1. Otherwise ln r would be negative, and its even powers would map
/// the inside of the pixel to the buffer a second time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LogPolar {
    setting: Setting,
    ln_corner: f64,
    /// Width and height of the buffer.
    pub(crate) size: [f64; 2],
}

impl LogPolar {
    pub(crate) fn new(
        setting: &Setting,
        sigma: f64,
        method: &'static str,
    ) -> Result<Self, MethodError> {
        let corner_px = setting.corner_px();
        if corner_px <= 1.0 {
            let message = format!(
                "the farthest corner is {corner_px:.3} px from the gaze, and the logarithm of the \
                 distance needs more than 1 px"
            );
            return Err(MethodError::Params { method, message });
        }
        let size = setting.size_px().map(|side| side / sigma);
        Ok(Self { setting: *setting, ln_corner: libm::log(corner_px), size })
    }

    /// z at a distance.
    pub(crate) fn z(&self, radius_px: f64) -> f64 {
        libm::log(radius_px.max(1.0)) / self.ln_corner
    }

    /// dz/dr at a distance above one pixel.
    pub(crate) fn z_slope(&self, radius_px: f64) -> f64 {
        1.0 / (radius_px * self.ln_corner)
    }

    pub(crate) fn radius_px(&self, z: f64) -> f64 {
        libm::exp(z * self.ln_corner)
    }

    /// v = θ/360 h.
    pub(crate) fn row(&self, place: Place) -> f64 {
        place.angle_deg() / 360.0 * self.size[1]
    }

    pub(crate) fn place(&self, z: f64, row: f64) -> Place {
        Place::polar(self.radius_px(z), row / self.size[1] * 360.0)
    }

    /// Rows per pixel across the line from the gaze.
    pub(crate) fn tangential(&self, radius_px: f64) -> f64 {
        self.size[1] / (TAU * radius_px)
    }

    /// The counts, from the share U(z) of the buffer's width that lies within a distance.
    pub(crate) fn counts(&self, breaks_px: &[f64], share: impl Fn(f64) -> f64) -> Counts {
        let [w, h] = self.size;
        let breaks: Vec<f64> = std::iter::once(1.0).chain(breaks_px.iter().copied()).collect();
        let on_screen = self.setting.integrate_within(&breaks, |r| w * h * share(self.z(r)));
        Counts::of(self.size, on_screen)
    }
}
