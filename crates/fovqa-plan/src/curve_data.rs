//! The data of figures that need no curve: frequency responses, and values that a file gives.

use fovqa_methods::sandbox::Sandbox;

/// Frequency responses of the sandbox of Patney et al. 2016 on a screen.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponsePlot {
    /// The eccentricities in degrees. Each has a panel.
    pub eccentricities_deg: Vec<f64>,
    /// The parameters of the sandbox.
    pub sandbox: Sandbox,
    /// The screen's pixels per degree at its centre.
    pub pixels_per_degree: f64,
}
