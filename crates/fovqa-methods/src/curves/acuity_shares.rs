//! Compares a method with acuity over the field of view: how much of the field is shown too
//! sparsely, and how many samples exceed the need of acuity. A rate above the display's own counts
//! as that of the display, which shows no more.

use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::{Eccentricity, PixelScale};

use super::error::CurveError;
use super::setting::CurveSetting;
use crate::registry::Method;
use crate::setting::Place;

/// The number of cells along the longer side of the frame.
const CELLS: f64 = 720.0;
/// Relative tolerance of comparisons, so that a rate that follows acuity is not below it by a
/// rounding error.
const EQUAL: f64 = 1e-9;

/// The shares of a frame that is seen below and above acuity: at the rate of the method, or that of
/// the display where it is lower. They are shares of the
/// frame's pixels, evaluated at the centres of cells that are at most 1/720 of the longer side
/// wide, with a precision of about 1/1000.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AcuityShares {
    /// Share of the field whose radial rate is below acuity.
    pub below_radial: f64,
    /// Share of the field whose tangential rate is below acuity.
    pub below_tangential: f64,
    /// Share of the field where either rate is below acuity.
    pub below: f64,
    /// The number of shaded samples beyond the need of acuity or of the display: the integral over
    /// the frame of density (1 - min(1, f/radial) min(1, f/tangential)), multiplied by the share
    /// that is shaded. f is acuity, or the display's own rate where it is lower.
    pub samples_above: f64,
    /// These samples as a share of all samples that are shaded and visible.
    pub above: f64,
}

/// Compares a method with an acuity model over the whole frame.
///
/// # Errors
/// When the method cannot be applied or the model does not make a curve.
pub fn acuity_shares(
    method: &Method,
    screen: &CurveSetting,
    acuity: &AcuityModel,
) -> Result<AcuityShares, CurveError> {
    let setting = screen.setting()?;
    let foveation = method.apply(&setting)?;
    let acuity = acuity.curve()?;
    let CurveSetting { view, tangential, eccentricity, .. } = *screen;
    let gaze_px = setting.gaze_px();
    let seen = Eccentricity::new(view, gaze_px, eccentricity);
    let sides = [view.width, view.height].map(|side| side as f64);
    let cell_px = (sides[0].max(sides[1]) / CELLS).max(1.0);
    let cells = sides.map(|side| (side / cell_px).ceil());
    let steps = [sides[0] / cells[0], sides[1] / cells[1]];
    let (mut sums, mut samples) = (AcuityShares::default(), 0.0);
    for j in 0..cells[1] as usize {
        for i in 0..cells[0] as usize {
            let at = [(i as f64 + 0.5) * steps[0], (j as f64 + 0.5) * steps[1]];
            let place = Place::at([at[0] - gaze_px[0], at[1] - gaze_px[1]]);
            let e = seen.at_deg(at[0], at[1]);
            let scale =
                PixelScale::at(&view, gaze_px, eccentricity, tangential, place.direction, e);
            // The rate along and across, and the display's own; a pixel has one sample at most.
            let rates = foveation.rates(place).zip(scale).map(|(rates, scale)| {
                let [along, across] = [scale.radial / 2.0, scale.tangential / 2.0];
                [(rates.radial * along, along), (rates.tangential * across, across)]
            });
            let needed = acuity.cutoff_cpd(e);
            let rates = rates.unwrap_or_default();
            let [less, across] = rates.map(|(rate, own)| rate.min(own) < needed * (1.0 - EQUAL));
            sums.below_radial += f64::from(less);
            sums.below_tangential += f64::from(across);
            sums.below += f64::from(less || across);
            let density = foveation.density(place);
            samples += density;
            let [along, abreast] = rates.map(|(rate, own)| (needed.min(own) / rate).min(1.0));
            let useful = along * abreast;
            // A rate that follows acuity has no samples above it, whatever its last bit is.
            if 1.0 - useful > 2.0 * EQUAL {
                sums.samples_above += density * (1.0 - useful);
            }
        }
    }
    let all = cells[0] * cells[1];
    let cell_pixels = steps[0] * steps[1];
    Ok(AcuityShares {
        below_radial: sums.below_radial / all,
        below_tangential: sums.below_tangential / all,
        below: sums.below / all,
        samples_above: sums.samples_above * cell_pixels * foveation.shaded_share(),
        above: if samples > 0.0 { sums.samples_above / samples } else { 0.0 },
    })
}

#[cfg(test)]
mod tests {
    use fovqa_params::ParamValue;
    use fovqa_vision::{EccentricityKind, Tangential, ViewSpec};

    use super::*;

    fn screen(width: usize, height: usize, tangential: Tangential) -> CurveSetting {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(110.0) };
        let view = spec.resolve(width, height).unwrap().view;
        CurveSetting {
            view,
            gaze_px: view.principal_px,
            direction_deg: 0.0,
            tangential,
            eccentricity: EccentricityKind::Planar,
        }
    }

    fn found(name: &str, screen: &CurveSetting) -> AcuityShares {
        acuity_shares(&Method::find(name).unwrap(), screen, &AcuityModel::default()).unwrap()
    }

    /// A display that shows all of acuity.
    const FINE: (usize, usize) = (60_000, 33_750);

    #[test]
    fn vafr_is_acuity_and_nothing_else() {
        let paper = found("vafr", &screen(FINE.0, FINE.1, Tangential::Paper));
        assert_eq!(paper, AcuityShares::default());
        // In visual angle the tangential rate is f cos e, which is below acuity everywhere.
        let angle = found("vafr", &screen(FINE.0, FINE.1, Tangential::Angle));
        assert!((angle.below_tangential - 1.0).abs() < 1e-12 && angle.below_radial == 0.0);
        assert!((angle.below - 1.0).abs() < 1e-12 && angle.above == 0.0);
    }

    /// On a coarse display VaFR is below acuity where the display is, and its samples beyond those of
    /// the display are above what can be seen.
    #[test]
    fn no_more_is_seen_than_the_display_shows() {
        let screen = screen(2560, 1440, Tangential::Paper);
        let (vafr, full) = (found("vafr", &screen), found("full", &screen));
        assert!(vafr.below > 0.01 && (vafr.below - full.below).abs() < 1e-12, "{vafr:?} {full:?}");
        let acuity = AcuityModel::default().curve().unwrap();
        let focal_px = screen.view.focal_px[0];
        // Density f² / display² per pixel, of which one per pixel is seen.
        let mut wasted = 0.0;
        for y in 0..720 {
            for x in 0..1280 {
                let r = (f64::from(x) + 0.5).hypot(f64::from(y) + 0.5);
                let display = (1.0 + (r / focal_px).powi(2)) * focal_px * 1f64.to_radians() / 2.0;
                let rate = acuity.cutoff_cpd((r / focal_px).atan().to_degrees()) / display;
                wasted += 4.0 * (rate * rate - 1.0).max(0.0);
            }
        }
        assert!((vafr.samples_above / wasted - 1.0).abs() < 0.02, "{vafr:?} {wasted}");
    }

    /// Reprojected samples are not shaded, so they do not count as above acuity. The shares
    /// stay the same.
    #[test]
    fn samples_above_count_shaded_samples_only() {
        let screen = screen(2560, 1440, Tangential::Paper);
        let with = |share: f64| {
            let mut method = Method::find("vafr").unwrap();
            method.set("factor", &ParamValue::Number(2.0)).unwrap();
            method.set("reprojected_share", &ParamValue::Number(share)).unwrap();
            let found = acuity_shares(&method, &screen, &AcuityModel::default()).unwrap();
            (found, method.apply(&screen.setting().unwrap()).unwrap().counts().samples_seen)
        };
        let ((all, seen), (half, half_seen)) = (with(1.0), with(0.0));
        assert!(all.samples_above > 0.5 * seen);
        assert!((half.samples_above / all.samples_above - 0.5).abs() < 1e-12);
        assert!(half.samples_above < half_seen && (half_seen / seen - 0.5).abs() < 1e-12);
        assert_eq!((half.above, half.below), (all.above, all.below));
    }

    /// The display's radial rate rises with eccentricity while acuity falls, and they are equal on
    /// a circle.
    #[test]
    fn a_display_is_below_acuity_inside_a_circle() {
        let screen = screen(2560, 1440, Tangential::Paper);
        let full = found("full", &screen);
        let focal_px = screen.view.focal_px[0];
        let acuity = AcuityModel::default().curve().unwrap();
        let (mut low, mut high) = (0.0f64, 60.0f64);
        for _ in 0..60 {
            let e = low.midpoint(high);
            let rate = focal_px * 1f64.to_radians() / (2.0 * e.to_radians().cos().powi(2));
            if rate < acuity.cutoff_cpd(e) { low = e } else { high = e }
        }
        let radius = focal_px * low.to_radians().tan();
        let share = std::f64::consts::PI * radius * radius / (2560.0 * 1440.0);
        assert!((full.below - share).abs() < 2e-3, "{} for {share}", full.below);
        assert!((full.below_tangential - full.below_radial).abs() < 1e-12);
        assert!(full.above > 0.5 && full.samples_above < 2560.0 * 1440.0);
    }

    #[test]
    fn samples_above_acuity_grow_with_the_display() {
        let of = |w, h| found("full", &screen(w, h, Tangential::Paper));
        let (small, large) = (of(1280, 720), of(7680, 4320));
        assert!(large.below < small.below && large.above > small.above);
        // A display that is below acuity nowhere needs as many samples as acuity does.
        let fine = of(60_000, 33_750);
        assert!(fine.below < 1e-3);
        let screen = screen(60_000, 33_750, Tangential::Paper);
        let vafr = Method::find("vafr").unwrap().apply(&screen.setting().unwrap()).unwrap();
        let needed = 60_000.0 * 33_750.0 - fine.samples_above;
        assert!((needed / vafr.counts().samples_on_screen - 1.0).abs() < 0.01);
    }

    #[test]
    fn shares_and_samples_are_those_of_cells() {
        let at = |(width, height): (usize, usize), gaze_px, cpd: f64| {
            let screen = CurveSetting { gaze_px, ..screen(width, height, Tangential::Paper) };
            let acuity = AcuityModel::Piecewise(fovqa_vision::acuity::PiecewiseParams {
                knots_deg: vec![0.0, 10.0],
                knots_cpd: vec![cpd; 2],
                cap_cpd: None,
            });
            (screen, acuity)
        };
        // Acuity is constant, the gaze is on the frame's border, and the sides are unequal: the
        // display reaches 9 cpd on a circle and exceeds it outside, where its share above acuity is
        // 1 - (9/f)².
        for (width, height, gaze) in [(300, 1500, [0.0, 750.0]), (1500, 300, [750.0, 300.0])] {
            let probe = at((width, height), gaze, 9.0).0;
            let focal_px = probe.view.focal_px[0];
            // cos² e = (π/180) f / 2 / cpd where the rate equals acuity.
            let cpd = focal_px * 1f64.to_radians() / 2.0 * 1.1;
            let (screen, acuity) = at((width, height), gaze, cpd);
            let full = Method::find("full").unwrap();
            let found = acuity_shares(&full, &screen, &acuity).unwrap();
            let (mut below, mut above) = (0.0, 0.0);
            for y in 0..height {
                for x in 0..width {
                    let r = (x as f64 + 0.5 - gaze[0]).hypot(y as f64 + 0.5 - gaze[1]);
                    // 1 / cos² e is 1 + (r / f)².
                    let rate = (1.0 + (r / focal_px).powi(2)) / 1.1;
                    below += f64::from(rate < 1.0);
                    above += 1.0 - (1.0 / rate).min(1.0).powi(2);
                }
            }
            let pixels = (width * height) as f64;
            assert!((found.below - below / pixels).abs() < 2e-3, "{found:?} {}", below / pixels);
            assert!((found.samples_above / above - 1.0).abs() < 2e-3, "{found:?} {above}");
            assert!((found.above / (above / pixels) - 1.0).abs() < 2e-3, "{found:?}");
        }
    }

    /// Along an axis RMFR is sparser than across it: a rate above acuity in one direction does not
    /// compensate one below it in the other.
    #[test]
    fn one_direction_does_not_make_up_for_the_other() {
        let screen = screen(1440, 1600, Tangential::Paper);
        let rmfr = Method::find("rmfr").unwrap();
        let found = acuity_shares(&rmfr, &screen, &AcuityModel::default()).unwrap();
        let acuity = AcuityModel::default().curve().unwrap();
        let focal_px = screen.view.focal_px[0];
        let (mut above, mut samples) = (0.0, 0.0);
        let axis =
            |side: f64, t: f64| 0.38 * 0.88 * side * side / ((t + 0.38 * side).powi(2) * 2.6);
        for y in 0..400 {
            for x in 0..360 {
                let (x, y) = (2.0 * f64::from(x) + 1.0, 2.0 * f64::from(y) + 1.0);
                let (jx, jy, r) = (axis(1440.0, x), axis(1600.0, y), x.hypot(y));
                let scale = (1.0 + (r / focal_px).powi(2)) * focal_px * 1f64.to_radians() / 2.0;
                let needed = acuity.cutoff_cpd((r / focal_px).atan().to_degrees());
                let along = (jx * x).hypot(jy * y) / r * scale;
                let across = (jx * y).hypot(jy * x) / r * scale;
                let useful = (needed / along).min(1.0) * (needed / across).min(1.0);
                above += jx * jy * (1.0 - useful) * 16.0;
                samples += jx * jy * 16.0;
            }
        }
        assert!((found.samples_above / above - 1.0).abs() < 2e-3, "{found:?} {above}");
        assert!((found.above / (above / samples) - 1.0).abs() < 2e-3, "{found:?}");
    }

    /// Where a method has no rate, it is below acuity and has no samples.
    #[test]
    fn where_there_is_no_rate_there_is_too_little() {
        let screen = screen(FINE.0, FINE.1, Tangential::Paper);
        let mut clamped = Method::find("vafr").unwrap();
        clamped.set("beyond", &fovqa_params::ParamValue::Text("clamp".into())).unwrap();
        let found = acuity_shares(&clamped, &screen, &AcuityModel::default()).unwrap();
        // 40 % of the pixels lie beyond 60°.
        let radius = screen.view.focal_px[0] / 60_000.0 * 2560.0 * 60f64.to_radians().tan();
        let (mut beyond, half) = (0usize, radius * radius);
        for y in 0..720 {
            for x in 0..1280 {
                let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                beyond += usize::from(x * x + y * y > half);
            }
        }
        let share = beyond as f64 / (1280.0 * 720.0);
        assert!((share - 0.40).abs() < 0.01 && (found.below - share).abs() < 2e-3, "{found:?}");
        assert!(found.below_radial.to_bits() == found.below.to_bits() && found.above == 0.0);
    }

    #[test]
    fn cells_of_small_frames_are_pixels_and_fill_any_frame() {
        let full = Method::find("full").unwrap();
        let flat = |cpd: f64| {
            AcuityModel::Piecewise(fovqa_vision::acuity::PiecewiseParams {
                knots_deg: vec![0.0, 10.0],
                knots_cpd: vec![cpd; 2],
                cap_cpd: None,
            })
        };
        // The display has 0.09 cpd at the gaze, and three times as much at the upper border.
        let found = acuity_shares(&full, &screen(30, 30, Tangential::Paper), &flat(0.2)).unwrap();
        let pixels = found.below * 900.0;
        assert!(pixels > 100.0 && (pixels - pixels.round()).abs() < 1e-9, "{pixels}");
        // Cells have 721/720 x 1 pixels. Acuity is almost 0, so that all samples are above it.
        let wide = screen(721, 2, Tangential::Paper);
        let wide =
            CurveSetting { view: fovqa_vision::View { focal_px: [900.0; 2], ..wide.view }, ..wide };
        let found = acuity_shares(&full, &wide, &flat(0.01)).unwrap();
        assert!((found.samples_above / 1442.0 - 1.0).abs() < 1e-4, "{found:?}");
    }
}
