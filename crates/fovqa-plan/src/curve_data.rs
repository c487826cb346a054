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

/// Values that are drawn as bars.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenValues {
    /// What the values are, with their unit: the title of the vertical axis.
    pub quantity: String,
    /// Names of the groups of bars.
    pub groups: Vec<String>,
    /// The series.
    pub series: Vec<GivenSeries>,
    /// The name of a further series, the sum of the others; `None` for none.
    pub sum: Option<String>,
}

/// The values of one series.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenSeries {
    /// Its name in the legend.
    pub name: String,
    /// A value for each group.
    pub values: Vec<f64>,
    /// Half the length of the error bar of each value; empty for none.
    pub errors: Vec<f64>,
}
