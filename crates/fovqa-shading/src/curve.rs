//! A curve: rates at rising eccentricities in one direction.

use fovqa_config::{CurvePlan, CurveRange, CurveSetting, CurveSource, CurveSpec};
use fovqa_methods::{Counts, Foveation, Method, MethodError, Place, Reach};
use fovqa_vision::acuity::{AcuityModel, PiecewiseMarError};
use fovqa_vision::{EccentricityKind, PixelScale};
use rayon::prelude::*;
use thiserror::Error;

use crate::field::{Field, field};

/// A curve with what its method costs.
#[derive(Debug, Clone)]
pub struct Curve {
    /// What it is of.
    pub spec: CurveSpec,
    /// Its values, at rising eccentricities.
    pub rows: Vec<Row>,
    /// Samples of the method in a frame; `None` for an acuity model.
    pub counts: Option<Counts>,
    /// The frame's field against the plan's acuity; `None` for an acuity model, and of a curve by
    /// itself.
    pub field: Option<Field>,
    /// What has to be said wherever it is shown.
    pub notes: Vec<String>,
}

/// Rates at an eccentricity. cpd are cycles per degree, a cycle being two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Eccentricity in degrees.
    pub eccentricity_deg: f64,
    /// Along the line from the gaze.
    pub radial_cpd: f64,
    /// Across it; of an acuity model the same.
    pub tangential_cpd: f64,
    /// The display's own rate along the line and across it; `None` without a screen.
    pub display_cpd: Option<[f64; 2]>,
    /// Samples per pixel of area; `None` without a screen.
    pub samples_per_pixel: Option<f64>,
}

/// Why there is no curve.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// A method that cannot be applied.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// Knots that are no acuity curve.
    #[error(transparent)]
    Acuity(#[from] PiecewiseMarError),
}

/// All curves of a plan, in its order.
///
/// # Errors
/// When a method cannot be applied or an acuity model is no curve.
pub fn trace_all(plan: &CurvePlan) -> Result<Vec<Curve>, CurveError> {
    let traced = |spec: &CurveSpec| {
        let field = match &spec.source {
            CurveSource::Acuity(_) => None,
            CurveSource::Method { method, setting } => Some(field(method, setting, &plan.acuity)?),
        };
        Ok(Curve { field, ..trace(spec, plan.range)? })
    };
    plan.curves.par_iter().map(traced).collect()
}

/// A curve.
///
/// # Errors
/// As [`trace_all`].
pub fn trace(spec: &CurveSpec, range: CurveRange) -> Result<Curve, CurveError> {
    match &spec.source {
        CurveSource::Acuity(model) => acuity(spec, model, range),
        CurveSource::Method { method, setting } => shading(spec, method, setting, range),
    }
}

/// Multiples of the step, free of its rounding, up to and with the end.
fn eccentricities_deg(range: CurveRange) -> impl Iterator<Item = f64> {
    const DECIMALS: f64 = 1e9;
    let rounded = move |i: u32| (f64::from(i) * range.step_deg * DECIMALS).round() / DECIMALS;
    (0..).map(rounded).take_while(move |e| *e <= range.to_deg)
}

fn acuity(spec: &CurveSpec, model: &AcuityModel, range: CurveRange) -> Result<Curve, CurveError> {
    let curve = model.curve()?;
    let row = |eccentricity_deg| {
        let cpd = curve.cutoff_cpd(eccentricity_deg);
        Row {
            eccentricity_deg,
            radial_cpd: cpd,
            tangential_cpd: cpd,
            display_cpd: None,
            samples_per_pixel: None,
        }
    };
    let rows = eccentricities_deg(range).map(row).collect();
    Ok(Curve { spec: spec.clone(), rows, counts: None, field: None, notes: Vec::new() })
}

fn shading(
    spec: &CurveSpec,
    method: &Method,
    screen: &CurveSetting,
    range: CurveRange,
) -> Result<Curve, CurveError> {
    let setting = screen.setting()?;
    let ([x, y], [at_x, at_y]) = (screen.gaze_px, setting.gaze_px());
    let outside = ((x - at_x).abs() + (y - at_y).abs() > 0.0).then(|| {
        format!("the gaze ({x}, {y}) is outside of the frame: it is taken at ({at_x}, {at_y})")
    });
    let foveation = method.over(&setting)?;
    let screen = &CurveSetting { gaze_px: setting.gaze_px(), ..*screen };
    let direction = Place::polar(0.0, screen.direction_deg).direction;
    let end_px = match foveation.reach() {
        Reach::Any => f64::INFINITY,
        Reach::Border => setting.edge_px(direction),
        Reach::Corner => setting.corner_px(),
    };
    let rows: Vec<Row> = eccentricities_deg(range)
        .map_while(|e| {
            let scale = scale_at(screen, direction, e)?;
            // The end itself belongs to the curve, however its radius is rounded.
            (scale.radius_px <= end_px * (1.0 + 1e-9)).then_some((e, scale))
        })
        .filter_map(|(e, scale)| row(foveation.as_ref(), e, scale, direction))
        .collect();
    let notes = outside
        .into_iter()
        .chain(stretched(screen))
        .chain(foveation.note())
        .chain(without_rows(&rows, range))
        .collect();
    Ok(Curve { spec: spec.clone(), rows, counts: Some(foveation.counts()), field: None, notes })
}

/// What planar eccentricity makes of pixels that are not square.
fn stretched(screen: &CurveSetting) -> Option<String> {
    let [fx, fy] = screen.view.focal_px;
    let CurveSetting { view, eccentricity, .. } = screen;
    ((fx - fy).abs() > 1e-6 * fx).then(|| {
        let what = match eccentricity {
            EccentricityKind::Planar => {
                "planar eccentricity and methods take their geometric mean, `angular` takes both"
            }
            EccentricityKind::Angular => "methods take their geometric mean",
        };
        format!(
            "pixels of {}x{} are not square, the focal lengths are {fx:.2} and {fy:.2} px: {what}",
            view.width, view.height
        )
    })
}

fn without_rows(rows: &[Row], range: CurveRange) -> Option<String> {
    rows.is_empty().then(|| {
        format!(
            "no rate is defined at any step from 0° to {}°: take a finer step or go further",
            range.to_deg
        )
    })
}

fn scale_at(screen: &CurveSetting, direction: [f64; 2], e: f64) -> Option<PixelScale> {
    let CurveSetting { view, gaze_px, tangential, eccentricity, .. } = screen;
    PixelScale::at(view, *gaze_px, *eccentricity, *tangential, direction, e)
}

fn row(
    foveation: &dyn Foveation,
    eccentricity_deg: f64,
    scale: PixelScale,
    direction: [f64; 2],
) -> Option<Row> {
    let place = Place { radius_px: scale.radius_px, direction };
    let rates = foveation.rates(place)?;
    let row = Row {
        eccentricity_deg,
        radial_cpd: rates.radial * scale.radial / 2.0,
        tangential_cpd: rates.tangential * scale.tangential / 2.0,
        display_cpd: Some([scale.radial / 2.0, scale.tangential / 2.0]),
        samples_per_pixel: Some(foveation.density(place)),
    };
    (row.radial_cpd.is_finite() && row.tangential_cpd.is_finite()).then_some(row)
}
