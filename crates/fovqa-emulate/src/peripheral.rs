//! Widths and strengths that grow with eccentricity, from the end of the fovea on (Patney et al. 2016).

use fovqa_methods::Setting;

/// A blur that grows linearly with eccentricity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Growth {
    /// Width in minutes of arc a degree.
    pub(crate) rate_arcmin: f64,
    /// Where it begins, in degrees.
    pub(crate) foveal_deg: f64,
}

impl Growth {
    /// s = rate / 60 · max(0, e - foveal) · pixels per degree, in pixels.
    pub(crate) fn width_px(self, setting: &Setting, radius_px: f64) -> f64 {
        let pixels_per_degree = setting.focal_px() * std::f64::consts::PI / 180.0;
        let beyond_deg = (setting.eccentricity_deg(radius_px) - self.foveal_deg).max(0.0);
        self.rate_arcmin / 60.0 * beyond_deg * pixels_per_degree
    }
}
