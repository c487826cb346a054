//! Computes a curve: rates at rising eccentricities in one direction.

use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::{EccentricityKind, PixelScale};
use rayon::prelude::*;

use super::acuity_shares::{AcuityShares, acuity_shares};
use super::error::CurveError;
use super::setting::{CurveRange, CurveSetting};
use super::spec::{CurveSource, CurveSpec};
use crate::foveation::{Counts, Foveation, Reach};
use crate::registry::Method;
use crate::setting::Place;

/// A curve, with the cost of its method.
#[derive(Debug, Clone)]
pub struct Curve {
    /// The specification of the curve.
    pub spec: CurveSpec,
    /// Its values, at rising eccentricities.
    pub points: Vec<CurvePoint>,
    /// The numbers of samples of the method in a frame; `None` for an acuity model.
    pub counts: Option<Counts>,
    /// Shares of the frame below and above acuity; `None` for an acuity model, and for a curve that
    /// was computed by itself.
    pub shares: Option<AcuityShares>,
    /// Notes that must accompany the curve wherever it is shown.
    pub notes: Vec<String>,
}

/// Rates at one eccentricity, in cycles per degree (cpd); a cycle is two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Eccentricity in degrees.
    pub eccentricity_deg: f64,
    /// The rate along the line from the gaze.
    pub radial_cpd: f64,
    /// The rate across that line. An acuity model has the same rate in both directions.
    pub tangential_cpd: f64,
    /// The display's own rates along the line and across it; `None` without a screen.
    pub display_cpd: Option<[f64; 2]>,
    /// Samples per pixel of area; `None` without a screen.
    pub samples_per_pixel: Option<f64>,
}

/// Computes all curves, in their order, and compares each method with an acuity model.
///
/// # Errors
/// When a method cannot be applied, or the knots of an acuity model do not make a curve.
pub fn trace_all(
    specs: &[CurveSpec],
    range: CurveRange,
    acuity: &AcuityModel,
) -> Result<Vec<Curve>, CurveError> {
    let traced = |spec: &CurveSpec| {
        let shares = match &spec.source {
            CurveSource::Acuity(_) => None,
            CurveSource::Method { method, setting } => {
                Some(acuity_shares(method, setting, acuity)?)
            }
        };
        Ok(Curve { shares, ..trace(spec, range)? })
    };
    specs.par_iter().map(traced).collect()
}

/// Computes one curve.
///
/// # Errors
/// As [`trace_all`].
pub fn trace(spec: &CurveSpec, range: CurveRange) -> Result<Curve, CurveError> {
    match &spec.source {
        CurveSource::Acuity(model) => acuity(spec, model, range),
        CurveSource::Method { method, setting } => shading(spec, method, setting, range),
    }
}

/// Multiples of the step up to and including the end; each is computed from its index, so that
/// rounding errors do not add up.
fn eccentricities_deg(range: CurveRange) -> impl Iterator<Item = f64> {
    const DECIMALS: f64 = 1e9;
    let rounded = move |i: u32| (f64::from(i) * range.step_deg * DECIMALS).round() / DECIMALS;
    (0..).map(rounded).take_while(move |e| *e <= range.to_deg)
}

fn acuity(spec: &CurveSpec, model: &AcuityModel, range: CurveRange) -> Result<Curve, CurveError> {
    let curve = model.curve()?;
    let point = |eccentricity_deg| {
        let cpd = curve.cutoff_cpd(eccentricity_deg);
        CurvePoint {
            eccentricity_deg,
            radial_cpd: cpd,
            tangential_cpd: cpd,
            display_cpd: None,
            samples_per_pixel: None,
        }
    };
    let points = eccentricities_deg(range).map(point).collect();
    Ok(Curve { spec: spec.clone(), points, counts: None, shares: None, notes: Vec::new() })
}

fn shading(
    spec: &CurveSpec,
    method: &Method,
    curve_setting: &CurveSetting,
    range: CurveRange,
) -> Result<Curve, CurveError> {
    let setting = curve_setting.setting()?;
    let ([x, y], [at_x, at_y]) = (curve_setting.gaze_px, setting.gaze_px());
    let outside = ((x - at_x).abs() + (y - at_y).abs() > 0.0).then(|| {
        format!("the gaze ({x}, {y}) is outside the frame; ({at_x}, {at_y}) on its border is used")
    });
    let foveation = method.apply(&setting)?;
    let curve_setting = &CurveSetting { gaze_px: setting.gaze_px(), ..*curve_setting };
    let direction = Place::polar(0.0, curve_setting.direction_deg).direction;
    let end_px = match foveation.reach() {
        Reach::Any => f64::INFINITY,
        Reach::Border => setting.edge_px(direction),
        Reach::Corner => setting.corner_px(),
    };
    let points: Vec<CurvePoint> = eccentricities_deg(range)
        .map_while(|e| {
            let scale = scale_at(curve_setting, direction, e)?;
            // The end belongs to the curve, whichever way its radius is rounded.
            (scale.radius_px <= end_px * (1.0 + 1e-9)).then_some((e, scale))
        })
        .filter_map(|(e, scale)| point(foveation.as_ref(), e, scale, direction))
        .collect();
    let notes = outside
        .into_iter()
        .chain(stretched(curve_setting))
        .chain(foveation.note())
        .chain(without_points(&points, range))
        .collect();
    Ok(Curve { spec: spec.clone(), points, counts: Some(foveation.counts()), shares: None, notes })
}

/// A note about planar eccentricity with pixels that are not square, if it applies.
fn stretched(curve_setting: &CurveSetting) -> Option<String> {
    let [fx, fy] = curve_setting.view.focal_px;
    let CurveSetting { view, eccentricity, .. } = curve_setting;
    ((fx - fy).abs() > 1e-6 * fx).then(|| {
        let what = match eccentricity {
            EccentricityKind::Planar => {
                "planar eccentricity and methods use their geometric mean, `angular` uses both"
            }
            EccentricityKind::Angular => "methods use their geometric mean",
        };
        format!(
            "pixels of {}x{} are not square, the focal lengths are {fx:.2} and {fy:.2} px: {what}",
            view.width, view.height
        )
    })
}

fn without_points(points: &[CurvePoint], range: CurveRange) -> Option<String> {
    points.is_empty().then(|| {
        format!(
            "no rate is defined at any step from 0° to {}°: use a finer step or a larger range",
            range.to_deg
        )
    })
}

fn scale_at(curve_setting: &CurveSetting, direction: [f64; 2], e: f64) -> Option<PixelScale> {
    let CurveSetting { view, gaze_px, tangential, eccentricity, .. } = curve_setting;
    PixelScale::at(view, *gaze_px, *eccentricity, *tangential, direction, e)
}

fn point(
    foveation: &dyn Foveation,
    eccentricity_deg: f64,
    scale: PixelScale,
    direction: [f64; 2],
) -> Option<CurvePoint> {
    let place = Place { radius_px: scale.radius_px, direction };
    let rates = foveation.rates(place)?;
    let point = CurvePoint {
        eccentricity_deg,
        radial_cpd: rates.radial * scale.radial / 2.0,
        tangential_cpd: rates.tangential * scale.tangential / 2.0,
        display_cpd: Some([scale.radial / 2.0, scale.tangential / 2.0]),
        samples_per_pixel: Some(foveation.density(place)),
    };
    (point.radial_cpd.is_finite() && point.tangential_cpd.is_finite()).then_some(point)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use fovqa_params::ParamValue;
    use fovqa_vision::{EccentricityKind, Tangential, ViewSpec};

    use super::*;

    /// 1440x1600, 110° vertical: the border is at 52.12° to the side and 55° above.
    fn screen(gaze_px: [f64; 2], direction_deg: f64, tangential: Tangential) -> CurveSetting {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(110.0) };
        let view = spec.resolve(1440, 1600).unwrap().view;
        let eccentricity = EccentricityKind::Planar;
        CurveSetting { view, gaze_px, direction_deg, tangential, eccentricity }
    }

    fn spec(method: Method, setting: CurveSetting) -> CurveSpec {
        let source = CurveSource::Method { method, setting };
        CurveSpec { name: String::new(), source, parameters: String::new() }
    }

    fn find(name: &str, params: &[(&str, f64)]) -> Method {
        let mut method = Method::find(name).unwrap();
        for (param, value) in params {
            method.set(param, &ParamValue::Number(*value)).unwrap();
        }
        method
    }

    const RANGE: CurveRange = CurveRange { step_deg: 0.25, to_deg: 60.0 };
    const CENTRE: [f64; 2] = [720.0, 800.0];

    fn curve(method: Method, setting: CurveSetting) -> Curve {
        trace(&spec(method, setting), RANGE).unwrap()
    }

    /// The first and the last eccentricity of a curve, and the number of points.
    fn ends(curve: &Curve) -> (f64, f64, usize) {
        let points = &curve.points;
        (points[0].eccentricity_deg, points[points.len() - 1].eccentricity_deg, points.len())
    }

    #[test]
    fn curves_end_where_their_methods_do() {
        let at = |name: &str, gaze, direction| {
            ends(&curve(find(name, &[]), screen(gaze, direction, Tangential::Paper)))
        };
        // The curve reaches the border in its direction: at 52.12°, at exactly 55°, at 60° beyond
        // the diagonal.
        for name in ["rmfr", "deamp"] {
            assert_eq!(at(name, CENTRE, 0.0), (0.0, 52.0, 209), "{name}");
            assert_eq!(at(name, CENTRE, 90.0), (0.0, 55.0, 221), "{name}");
            assert_eq!(at(name, [1440.0, 800.0], 0.0), (0.0, 0.0, 1), "{name}");
            assert_eq!(at(name, [1440.0, 800.0], 180.0), (0.0, 60.0, 241), "{name}");
        }
        // The curve reaches the farthest corner, at 62.5°, in any direction, and has no rate at the
        // gaze.
        for name in ["kfr", "lafr"] {
            assert_eq!(at(name, CENTRE, 0.0), (0.25, 60.0, 240), "{name}");
            let far = CurveRange { to_deg: 89.0, ..RANGE };
            let setting = screen(CENTRE, 0.0, Tangential::Paper);
            let found = trace(&spec(find(name, &[]), setting), far).unwrap();
            assert_eq!(ends(&found), (0.25, 62.5, 250), "{name}");
        }
        // The curve continues over the plane.
        let far = CurveRange { step_deg: 1.0, to_deg: 179.0 };
        for name in ["full", "guenter", "linear", "cps", "visual_polar"] {
            let setting = screen(CENTRE, 0.0, Tangential::Paper);
            let found = trace(&spec(find(name, &[]), setting), far).unwrap();
            assert_eq!(ends(&found), (0.0, 89.0, 90), "{name}");
        }
    }

    #[test]
    fn steps_are_free_of_rounding() {
        for (step_deg, to_deg, last) in [(0.1, 60.0, 60.0), (0.7, 4.9, 4.9), (0.7, 5.0, 4.9)] {
            let rows: Vec<f64> = eccentricities_deg(CurveRange { step_deg, to_deg }).collect();
            assert_eq!(rows[rows.len() - 1].to_bits(), f64::to_bits(last), "{rows:?}");
            for (i, e) in rows.iter().enumerate() {
                let text = format!("{:.1}", i as f64 * step_deg);
                assert_eq!(e.to_bits(), text.parse::<f64>().unwrap().to_bits(), "{e} is {text}");
            }
        }
        let fine = CurveRange { step_deg: 0.001, to_deg: 0.01 };
        assert_eq!(eccentricities_deg(fine).count(), 11);
    }

    /// A cycle is two samples; across the line, a degree follows the convention.
    #[test]
    fn rows_are_cycles_per_degree() {
        let focal_px = 800.0 / 55f64.to_radians().tan();
        for tangential in [Tangential::Paper, Tangential::Angle] {
            let found = curve(find("rmfr", &[("fx", 0.2)]), screen(CENTRE, 90.0, tangential));
            for row in &found.points {
                let cos = row.eccentricity_deg.to_radians().cos();
                let t = focal_px * row.eccentricity_deg.to_radians().tan();
                let along = PI / 180.0 * focal_px / (cos * cos) / 2.0;
                let across = if tangential == Tangential::Paper { along } else { along * cos };
                // Downwards: y is along the line and x across it.
                let y = 608.0 * 1408.0 / (2.6 * (t + 608.0).powi(2));
                let x = (288.0 + 720.0) / (2.6 * 288.0);
                let [display_along, display_across] = row.display_cpd.unwrap();
                for (found, want) in [
                    (row.radial_cpd, y * along),
                    (row.tangential_cpd, x * across),
                    (display_along, along),
                    (display_across, across),
                    (row.samples_per_pixel.unwrap(), x * y),
                ] {
                    assert!((found / want - 1.0).abs() < 1e-9, "{row:?}: {found} for {want}");
                }
            }
            assert!((found.counts.unwrap().samples * 2.6 * 2.6 - 2_304_000.0).abs() < 1e-6);
        }
        // Points without a finite rate are left out: at the corner itself LaFR's rate is infinite.
        let lafr = curve(find("lafr", &[]), screen(CENTRE, 0.0, Tangential::Paper));
        assert!(lafr.points.iter().all(|row| row.radial_cpd.is_finite()));
    }

    #[test]
    fn a_gaze_outside_is_moved_to_the_border_with_a_note() {
        let of = |gaze| curve(find("deamp", &[]), screen(gaze, 180.0, Tangential::Paper));
        let (outside, border) = (of([1500.0, 800.0]), of([1440.0, 800.0]));
        assert_eq!(outside.points, border.points);
        assert_eq!(border.notes.len(), 1, "{:?}", border.notes);
        assert!(border.notes[0].contains("DEAMP"));
        assert_eq!(outside.notes.len(), 2);
        let said = "the gaze (1500, 800) is outside the frame; (1440, 800) on its border is used";
        assert_eq!(outside.notes[0], said);
        assert!(!of([720.0, -1.0]).notes.is_empty());
        assert!(curve(find("rmfr", &[]), screen(CENTRE, 0.0, Tangential::Paper)).notes.is_empty());
        // In true angle, too, the curve is that of the clamped gaze.
        let angular = |gaze| {
            let screen = screen(gaze, 180.0, Tangential::Angle);
            curve(
                find("full", &[]),
                CurveSetting { eccentricity: EccentricityKind::Angular, ..screen },
            )
        };
        assert_eq!(angular([1500.0, 800.0]).points, angular([1440.0, 800.0]).points);
    }

    #[test]
    fn all_curves_with_their_acuity_shares() {
        let acuity = AcuityModel::find("linear_mar").unwrap();
        let setting = screen(CENTRE, 0.0, Tangential::Paper);
        let kfr = find("kfr", &[]);
        let of_acuity = CurveSource::Acuity(acuity.clone());
        let (name, parameters) = (String::new(), String::new());
        let specs = [CurveSpec { name, source: of_acuity, parameters }, spec(kfr.clone(), setting)];
        let curves = trace_all(&specs, RANGE, &acuity).unwrap();
        assert_eq!(curves.len(), 2);
        assert!(curves[0].shares.is_none() && curves[0].counts.is_none());
        assert_eq!(ends(&curves[0]), (0.0, 60.0, 241));
        for row in &curves[0].points {
            let want = 1.0 / (0.0275 * row.eccentricity_deg + 1.0 / 48.0);
            assert!((row.radial_cpd / want - 1.0).abs() < 1e-12);
            assert!(row.tangential_cpd.to_bits() == row.radial_cpd.to_bits());
            assert!(row.display_cpd.is_none() && row.samples_per_pixel.is_none());
        }
        assert_eq!(curves[1].shares, Some(acuity_shares(&kfr, &setting, &acuity).unwrap()));
        assert_eq!(curves[1].points, curve(kfr, setting).points);
    }
}
