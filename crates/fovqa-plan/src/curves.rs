//! A file of curves: foveation methods over eccentricity, and what is drawn and tabulated of them.

use std::path::PathBuf;

use fovqa_methods::curves::{CurveRange, CurveSpec};
use fovqa_params::words;
use fovqa_vision::acuity::AcuityModel;

/// What a file of curves asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesFile {
    /// Its name.
    pub name: String,
    /// What it shows, for its page; may be empty.
    pub about: String,
    /// Its file.
    pub path: PathBuf,
    /// The file's text.
    pub text: String,
    /// What is to be computed.
    pub plan: CurvePlan,
}

/// Curves, figures and tables.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePlan {
    /// The curves, a method's for each of its settings one after the other.
    pub curves: Vec<CurveSpec>,
    /// What rates are held against.
    pub acuity: AcuityModel,
    /// Its parameters that are not at their defaults, as those of a curve.
    pub acuity_parameters: String,
    /// The eccentricities.
    pub range: CurveRange,
    /// Figures; all that fit, where a file names none and no table.
    pub plots: Vec<CurvePlot>,
    /// Tables; likewise.
    pub tables: Vec<CurveTable>,
}

/// A figure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePlot {
    /// What it shows.
    pub kind: CurvePlotKind,
    /// Its file's name; the kind's without.
    pub name: Option<String>,
    /// What stands above it.
    pub title: Option<String>,
    /// Names of its curves; all without.
    pub curves: Option<Vec<String>>,
    /// Which rate.
    pub rate: RateKind,
    /// In which unit.
    pub unit: RateUnit,
    /// What has a panel of its own.
    pub panels: PanelOf,
    /// Whether over- and under-sampled areas are shaded; without, where a panel has one curve.
    pub areas: Option<bool>,
    /// Whether the display's own rate is drawn too.
    pub display: bool,
    /// Ends of the vertical axis.
    pub y_limits: Option<[f64; 2]>,
    /// Measured values: a name, an eccentricity in degrees and cycles per degree.
    pub marks: Vec<(String, [f64; 2])>,
    /// Whether values stand on a logarithmic axis.
    pub log: bool,
    /// Eccentricities whose rings are drawn over a picture, degrees.
    pub rings_deg: Vec<f64>,
    /// Values of f, of RMFR's half axis.
    pub f: Vec<f64>,
}

words! {
    /// What a figure of curves shows.
    #[derive(Default)]
    pub enum CurvePlotKind {
        /// Rates and acuity against eccentricity.
        #[default]
        Rates "rates" "Rates and acuity against eccentricity";
        /// Samples per pixel over the field, as a picture.
        Density "density" "Samples per pixel over the field, as a picture";
        /// DEAMP: shaded pixels within a layer's angle (Fig. 5b).
        Accumulated "accumulated" "DEAMP: shaded pixels within a layer's angle";
        /// RMFR: where a half axis goes (Fig. 3).
        HalfAxis "half_axis" "RMFR: the mapping of a half axis";
    }
}

words! {
    /// Which rate a figure shows.
    #[derive(Default)]
    pub enum RateKind {
        /// Along the line from the gaze.
        #[default]
        Radial "radial" "Along the line from the gaze";
        /// Across it.
        Tangential "tangential" "Across this line";
        /// Both, side by side.
        Both "both" "Both, side by side";
    }
}

words! {
    /// The unit of rates in a figure.
    #[derive(Default)]
    pub enum RateUnit {
        /// Cycles per degree.
        #[default]
        Cpd "cpd" "Cycles per degree";
        /// Samples per pixel along the direction: the display's own rate is 1.
        PerPixel "per_pixel" "Samples per pixel along the direction";
    }
}

words! {
    /// What has a panel of its own.
    #[derive(Default)]
    pub enum PanelOf {
        /// Nothing: all curves in one.
        One "one" "Nothing: one panel for all curves";
        /// Each curve with its settings.
        #[default]
        Curve "curve" "Each curve with its settings";
        /// Each resolution.
        Resolution "resolution" "Each resolution";
        /// Each gaze.
        Gaze "gaze" "Each gaze";
        /// Each direction.
        Direction "direction" "Each direction";
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTable {
    /// What it shows.
    pub kind: CurveTableKind,
    /// Names of its curves; all without.
    pub curves: Option<Vec<String>>,
}

words! {
    /// What a table of curves shows.
    pub enum CurveTableKind {
        /// Samples per frame and load, curves against resolutions (VaFR, Table 1).
        Samples "samples" "Samples per frame and load, curves against resolutions";
        /// Buffer, samples, share of pixels and theoretical speed-up.
        SpeedUp "speed_up" "Buffer, samples, share of pixels and theoretical speed-up";
        /// The share of the field below acuity, and the samples spent above it.
        Acuity "acuity" "The share of the field below acuity, and the samples spent above it";
    }
}
