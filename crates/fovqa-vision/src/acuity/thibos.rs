//! Measured thresholds for gratings away from the gaze, where a grating can be detected that cannot be
//! resolved: it is seen as an alias of itself.

/// The highest spatial frequencies at an eccentricity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GratingThresholds {
    /// The eccentricity in degrees.
    pub eccentricity_deg: f64,
    /// The highest frequency that is detected, in cycles per degree.
    pub detection_cpd: f64,
    /// The highest frequency whose bars are resolved, in cycles per degree.
    pub resolution_cpd: f64,
}

/// Thibos et al. 1996, as quoted by Patney et al. 2016.
pub const THIBOS_1996: GratingThresholds =
    GratingThresholds { eccentricity_deg: 30.0, detection_cpd: 30.0, resolution_cpd: 5.0 };
