//! The results of `fovqa curves` as JSON: curves with their settings, counts and shares of the
//! field.

use fovqa_methods::curves::{AcuityShares, Curve, CurveSource};
use fovqa_params::Words;
use fovqa_plan::CurvesFile;
use serde::{Deserialize, Serialize};

use crate::files::CURVES_SCHEMA;

/// The record of a curves file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurvesRecord {
    /// [`CURVES_SCHEMA`].
    pub schema: String,
    /// Version of fovqa.
    pub version: String,
    /// Name of the curves file.
    pub name: String,
    /// Description of what it shows.
    pub about: String,
    /// The acuity model that rates are compared with.
    pub acuity: String,
    /// Parameters of the acuity model that differ from their defaults.
    #[serde(default)]
    pub acuity_parameters: String,
    /// The text of the curves file, which contains all settings.
    #[serde(default)]
    pub text: String,
    /// The curves.
    pub curves: Vec<CurveRecord>,
    /// Which curves, figures and tables are left out, and why.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveRecord {
    /// Name of the curve.
    pub name: String,
    /// Method or acuity model.
    pub model: String,
    /// Parameters that differ from their defaults.
    pub parameters: String,
    /// The screen of a method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub screen: Option<ScreenRecord>,
    /// The samples that a method shades.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shading: Option<ShadingRecord>,
    /// Comparison of the field with acuity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldRecord>,
    /// Remarks about the curve.
    pub notes: Vec<String>,
}

/// A screen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScreenRecord {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Focal length in pixels.
    pub focal_px: [f64; 2],
    /// The gaze.
    pub gaze_px: [f64; 2],
    /// Direction of the curve in degrees.
    pub direction_deg: f64,
    /// `paper` or `angle`.
    pub tangential: String,
    /// `planar` or `angular`.
    pub eccentricity: String,
}

/// The samples that a method shades in a frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShadingRecord {
    /// Width and height of each buffer, as ideal values that are not rounded.
    pub buffers: Vec<[f64; 2]>,
    /// Number of samples as the papers count them.
    pub samples: f64,
    /// The sum of `samples` and `samples_beyond`, divided by the number of pixels of the frame.
    pub share: f64,
    /// The number of pixels of the frame, divided by the sum of `samples` and `samples_beyond`.
    pub speed_up: f64,
    /// Number of samples inside the frame.
    pub samples_on_screen: f64,
    /// Number of samples outside the method's own field.
    pub samples_beyond: f64,
    /// Number of samples that are visible.
    pub samples_seen: f64,
}

/// Shares of the frame below and above acuity; see [`AcuityShares`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FieldRecord {
    /// Share of the frame in which the radial rate is below acuity.
    pub below_radial: f64,
    /// Share of the frame in which the tangential rate is below acuity.
    pub below_tangential: f64,
    /// Share of the frame in which at least one of the two rates is below acuity.
    pub below: f64,
    /// Number of shaded samples in excess of what acuity requires.
    pub samples_above: f64,
    /// The excess samples as a share of all samples.
    pub above: f64,
}

impl From<AcuityShares> for FieldRecord {
    fn from(shares: AcuityShares) -> Self {
        let AcuityShares { below_radial, below_tangential, below, samples_above, above } = shares;
        Self { below_radial, below_tangential, below, samples_above, above }
    }
}

impl CurvesRecord {
    /// Makes the record of the curves in a curves file.
    pub fn new(file: &CurvesFile, curves: &[Curve]) -> Self {
        Self {
            schema: CURVES_SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            name: file.name.clone(),
            about: file.about.clone(),
            acuity: file.plan.acuity.info().key.to_owned(),
            acuity_parameters: file.plan.acuity_parameters.clone(),
            text: file.text.clone(),
            curves: curves.iter().map(CurveRecord::new).collect(),
            left_out: file.plan.left_out.clone(),
        }
    }
}

impl CurveRecord {
    fn new(curve: &Curve) -> Self {
        let (model, screen) = match &curve.spec.source {
            CurveSource::Acuity(model) => (model.info().key, None),
            CurveSource::Method { method, setting } => (method.key(), Some(setting)),
        };
        let pixels = screen.map_or(0.0, |s| s.view.width as f64 * s.view.height as f64);
        Self {
            name: curve.spec.name.clone(),
            model: model.to_owned(),
            parameters: curve.spec.parameters.clone(),
            screen: screen.map(|screen| ScreenRecord {
                width: screen.view.width,
                height: screen.view.height,
                focal_px: screen.view.focal_px,
                gaze_px: screen.gaze_px,
                direction_deg: screen.direction_deg,
                tangential: screen.tangential.word().to_owned(),
                eccentricity: screen.eccentricity.word().to_owned(),
            }),
            shading: curve.counts.as_ref().map(|counts| ShadingRecord {
                buffers: counts.buffers.clone(),
                samples: counts.samples,
                share: counts.whole() / pixels,
                speed_up: pixels / counts.whole(),
                samples_on_screen: counts.samples_on_screen,
                samples_beyond: counts.samples_beyond,
                samples_seen: counts.samples_seen,
            }),
            field: curve.shares.map(FieldRecord::from),
            notes: curve.notes.clone(),
        }
    }
}
