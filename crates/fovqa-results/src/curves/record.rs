//! What was computed, as JSON: curves with their settings, counts and fields.

use fovqa_methods::curves::{AcuityShares, Curve, CurveSource};
use fovqa_params::Words;
use fovqa_plan::CurvesFile;
use serde::{Deserialize, Serialize};

use crate::files::CURVES_SCHEMA;

/// A file of curves as it was computed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurvesRecord {
    /// [`CURVES_SCHEMA`].
    pub schema: String,
    /// Version of fovqa.
    pub version: String,
    /// Name of the file of curves.
    pub name: String,
    /// What it shows.
    pub about: String,
    /// What rates were held against.
    pub acuity: String,
    /// Its parameters that are not at their defaults.
    #[serde(default)]
    pub acuity_parameters: String,
    /// The file's text: everything that was asked for.
    #[serde(default)]
    pub text: String,
    /// The curves.
    pub curves: Vec<CurveRecord>,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveRecord {
    /// Its name.
    pub name: String,
    /// Method or acuity model.
    pub model: String,
    /// Parameters that are not at their defaults.
    pub parameters: String,
    /// Where a method is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub screen: Option<ScreenRecord>,
    /// What a method shades.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shading: Option<ShadingRecord>,
    /// The field against acuity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldRecord>,
    /// What has to be said of it.
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
    /// Direction of the curve.
    pub direction_deg: f64,
    /// `paper` or `angle`.
    pub tangential: String,
    /// `planar` or `angular`.
    pub eccentricity: String,
}

/// What a method shades in a frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShadingRecord {
    /// Width and height of each buffer, ideal.
    pub buffers: Vec<[f64; 2]>,
    /// Samples as the papers count them.
    pub samples: f64,
    /// These and those beyond over the frame's pixels.
    pub share: f64,
    /// The frame's pixels over these and those beyond.
    pub speed_up: f64,
    /// Samples that fall into the frame.
    pub samples_on_screen: f64,
    /// Samples beyond the method's own field.
    pub samples_beyond: f64,
    /// Samples that are seen.
    pub samples_seen: f64,
}

/// Shares of the frame below and above acuity, as [`AcuityShares`] describes them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FieldRecord {
    /// Share of the frame whose radial rate is below acuity.
    pub below_radial: f64,
    /// Share whose tangential rate is below acuity.
    pub below_tangential: f64,
    /// Share where at least one of the two is below acuity.
    pub below: f64,
    /// Shaded samples beyond what acuity asks for.
    pub samples_above: f64,
    /// These samples as a share of all samples.
    pub above: f64,
}

impl From<AcuityShares> for FieldRecord {
    fn from(shares: AcuityShares) -> Self {
        let AcuityShares { below_radial, below_tangential, below, samples_above, above } = shares;
        Self { below_radial, below_tangential, below, samples_above, above }
    }
}

impl CurvesRecord {
    /// The record of a file's curves.
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
