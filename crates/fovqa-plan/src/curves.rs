//! The content of a curves file: foveation methods over eccentricity, and the figures and tables of
//! them.

use std::path::PathBuf;

use fovqa_methods::curves::{CurveRange, CurveSpec};
use fovqa_params::words;
use fovqa_vision::acuity::AcuityModel;

use crate::curve_data::{GivenValues, ResponsePlot};
use crate::figures::FigureSettings;

/// A curves file and its plan.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesFile {
    /// Name of the curves.
    pub name: String,
    /// Description for the page; may be empty.
    pub about: String,
    /// Path of the file.
    pub path: PathBuf,
    /// Text of the file.
    pub text: String,
    /// The plan: what is computed.
    pub plan: CurvePlan,
}

/// Curves, figures and tables.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePlan {
    /// The curves. The curves of one method for different settings are consecutive.
    pub curves: Vec<CurveSpec>,
    /// The acuity model that rates are compared with.
    pub acuity: AcuityModel,
    /// Parameters of the acuity model that differ from their defaults, written as those of a curve.
    pub acuity_parameters: String,
    /// The eccentricities at which curves are computed.
    pub range: CurveRange,
    /// The figures. If the file names no figure and no table, these are all figures that fit.
    pub plots: Vec<CurvePlot>,
    /// `[figures]`, how figures are printed; it is part of the settings of each figure already.
    pub figures: FigureSettings,
    /// The tables. If the file names no figure and no table, these are all tables that fit.
    pub tables: Vec<CurveTable>,
    /// Which curves, figures and tables are left out, and why: their budget cannot be reached.
    pub left_out: Vec<String>,
}

/// A figure.
#[allow(clippy::struct_excessive_bools, reason = "each is a choice of its own")]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePlot {
    /// What it shows.
    pub kind: CurvePlotKind,
    /// Name of its file; `None` for the name of the kind.
    pub name: Option<String>,
    /// The title above the figure.
    pub title: Option<String>,
    /// Names of its curves; `None` for all.
    pub curves: Option<Vec<String>>,
    /// Which rate it shows.
    pub rate: RateKind,
    /// The unit of the rate.
    pub unit: RateUnit,
    /// What each panel shows.
    pub panels: PanelOf,
    /// Whether over- and under-sampled areas are shaded. `None` shades them if a panel has only one
    /// curve.
    pub areas: Option<bool>,
    /// Whether the display's own rate is drawn as well. `None` draws it in cycles per degree.
    pub display: Option<bool>,
    /// Whether rates are drawn that exceed the display's own, which the display cannot show.
    pub beyond_display: bool,
    /// Lower and upper end of the vertical axis.
    pub y_limits: Option<[f64; 2]>,
    /// Measured values: a name, an eccentricity in degrees, and a value in cycles per degree.
    pub marks: Vec<(String, [f64; 2])>,
    /// Whether values are shown on a logarithmic axis.
    pub log: bool,
    /// Eccentricities in degrees whose rings are drawn over an image.
    pub rings_deg: Vec<f64>,
    /// Values of RMFR's parameter f for the figure of the half axis.
    pub f: Vec<f64>,
    /// Whether the rates of a method over the settings of a panel are one band.
    pub band: bool,
    /// Whether positions of samples are dots on the half axis.
    pub dots: bool,
    /// How density is drawn.
    pub style: DensityStyle,
    /// What acuity is divided by if rates are in samples per pixel.
    pub acuity_scale: AcuityScale,
    /// The frequency responses of a plot of this kind.
    pub response: Option<ResponsePlot>,
    /// The values of a plot of this kind.
    pub values: Option<GivenValues>,
    /// How it is printed.
    pub figure: FigureSettings,
}

words! {
    /// What acuity is divided by where rates are relative.
    #[derive(Default)]
    pub enum AcuityScale {
        /// The display's own rate, as the rates.
        #[default]
        Display "display" "The display's own rate, as the rates";
        /// Acuity at the gaze (DEAMP, Fig. 5c).
        Own "own" "Acuity at the gaze";
    }
}

words! {
    /// How density is drawn over the field.
    #[derive(Default)]
    pub enum DensityStyle {
        /// A picture with rings of equal eccentricity.
        #[default]
        Rings "rings" "A picture with rings of equal eccentricity";
        /// A picture with lines of equal density.
        Contours "contours" "A picture with lines of equal density";
    }
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
        /// Layered methods: the scale of each layer, in steps.
        Steps "steps" "Layered methods: the scale of each layer";
        /// Where samples lie over the frame.
        Samples "samples" "Positions of the samples over the frame";
        /// The numbers of samples as bars over resolutions.
        SamplesBars "samples_bars" "Numbers of samples as bars over resolutions";
        /// VaFR: the outline of the buffer (Figs. 2 and 4).
        Outline "outline" "VaFR: the outline of the buffer";
        /// What the sandbox of Patney et al. 2016 leaves of gratings (Fig. 3).
        Response "response" "What the sandbox of Patney et al. leaves of gratings";
        /// Values that the file gives, as bars.
        Values "values" "Values that the file gives, as bars";
    }
}

impl CurvePlotKind {
    /// Whether it shows no curve of the file.
    pub fn needs_no_curve(self) -> bool {
        matches!(self, Self::HalfAxis | Self::Response | Self::Values)
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
        /// Each curve of the file, with all its settings.
        Name "name" "Each curve of the file, with all its settings";
        /// Each setting (resolution, gaze and direction), with all curves of it.
        Setting "setting" "Each resolution, gaze and direction, with all curves of it";
        /// Each resolution.
        Resolution "resolution" "Each resolution";
        /// Each gaze.
        Gaze "gaze" "Each gaze";
        /// Each direction.
        Direction "direction" "Each direction";
    }
}

/// A table of curves.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTable {
    /// What it shows.
    pub kind: CurveTableKind,
    /// Names of its curves; `None` for all.
    pub curves: Option<Vec<String>>,
    /// What the columns of a table of samples are.
    pub across: TableAcross,
}

words! {
    /// What the columns of a table of samples are.
    #[derive(Default)]
    pub enum TableAcross {
        /// One column per resolution.
        #[default]
        Resolutions "resolutions" "One column per resolution, one row per method";
        /// One column per method.
        Methods "methods" "One column per method, one row per resolution";
    }
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
