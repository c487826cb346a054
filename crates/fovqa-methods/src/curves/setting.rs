//! Where a curve is computed: a screen, a gaze and a direction, and the range of eccentricities.

use fovqa_vision::{EccentricityKind, Tangential, View};

use crate::error::MethodError;
use crate::setting::Setting;

/// The eccentricities of curves: from 0 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveRange {
    /// From one to the next, degrees.
    pub step_deg: f64,
    /// The last one, degrees, for methods whose curves do not end with the frame.
    pub to_deg: f64,
}

impl Default for CurveRange {
    fn default() -> Self {
        Self { step_deg: 0.25, to_deg: 60.0 }
    }
}

impl CurveRange {
    /// Steps finer than this are no longer told apart in a plot or a table.
    pub const LEAST_STEP_DEG: f64 = 0.001;
    /// Where eccentricity ends.
    pub const MOST_DEG: f64 = 179.0;
}

/// A screen, a gaze, and how rates are measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSetting {
    /// The frame.
    pub view: View,
    /// The gaze in pixels; one outside of the frame is taken at its border.
    pub gaze_px: [f64; 2],
    /// Direction of the curve from the gaze, degrees from +x towards +y.
    pub direction_deg: f64,
    /// What a degree across the curve is.
    pub tangential: Tangential,
    /// How eccentricity is measured.
    pub eccentricity: EccentricityKind,
}

impl CurveSetting {
    /// What methods are applied to.
    ///
    /// # Errors
    /// When the frame has no pixels or the gaze is no place.
    pub fn setting(&self) -> Result<Setting, MethodError> {
        Setting::new(&self.view, self.gaze_px)
    }
}
