//! The conditions of a curve: a screen, a gaze and a direction, and the range of eccentricities.

use fovqa_vision::{EccentricityKind, Tangential, View};

use crate::error::MethodError;
use crate::setting::Setting;

/// The range of eccentricities of curves, starting at 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveRange {
    /// Step between two eccentricities in degrees.
    pub step_deg: f64,
    /// The last eccentricity in degrees, for methods whose curves do not end with the frame.
    pub to_deg: f64,
}

impl Default for CurveRange {
    fn default() -> Self {
        Self { step_deg: 0.25, to_deg: 60.0 }
    }
}

impl CurveRange {
    /// The smallest step: finer ones make no difference in a plot or a table.
    pub const LEAST_STEP_DEG: f64 = 0.001;
    /// The largest eccentricity of a curve.
    pub const MOST_DEG: f64 = 179.0;
}

/// A screen, a gaze, and the conventions for rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSetting {
    /// The frame.
    pub view: View,
    /// The gaze in pixels. A gaze outside the frame is moved to its border.
    pub gaze_px: [f64; 2],
    /// Direction of the curve from the gaze, in degrees from +x towards +y.
    pub direction_deg: f64,
    /// The meaning of a degree across the curve.
    pub tangential: Tangential,
    /// The definition of eccentricity.
    pub eccentricity: EccentricityKind,
}

impl CurveSetting {
    /// The setting to which methods are applied.
    ///
    /// # Errors
    /// When the frame has no pixels or the gaze is not finite.
    pub fn setting(&self) -> Result<Setting, MethodError> {
        Setting::new(&self.view, self.gaze_px)
    }
}
