//! How many pixels one degree has at a position on the screen, along the line from the gaze and
//! across it.

use std::f64::consts::PI;

use fovqa_params::words;

use crate::eccentricity::EccentricityKind;
use crate::view::View;

words! {
    /// What one degree means across the line from the gaze.
    #[derive(Default)]
    pub enum Tangential {
        /// As many pixels as along that line (VaFR divides its Eq. 6 and 20 by the radial dr/de).
        #[default]
        Paper "paper" "The same number of pixels as along the curve: the papers' convention";
        /// A degree of visual angle.
        Angle "angle" "A degree of visual angle";
    }
}

/// A position on the screen, and the number of pixels per degree there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelScale {
    /// Distance from the gaze in pixels.
    pub radius_px: f64,
    /// Pixels per degree along the line from the gaze.
    pub radial: f64,
    /// Pixels per degree across that line.
    pub tangential: f64,
}

impl PixelScale {
    /// The position at an eccentricity in degrees, in a direction from the gaze, which is a unit
    /// vector in pixels. `None` where no pixel of the plane is at this eccentricity.
    ///
    /// `planar`: e = atan(r / f), so that a degree has (π/180) f / cos² e pixels along the line and
    /// (π/180) f / cos e across it. `angular` uses the true angles between rays: a line through the
    /// gaze is a great circle, on which the ray G + s D turns by |G x D| / |G + s D|² per pixel.
    pub fn at(
        view: &View,
        gaze_px: [f64; 2],
        kind: EccentricityKind,
        tangential: Tangential,
        direction: [f64; 2],
        eccentricity_deg: f64,
    ) -> Option<Self> {
        const DEG: f64 = PI / 180.0;
        let e = eccentricity_deg * DEG;
        let (radius_px, radial, across) = match kind {
            EccentricityKind::Planar => {
                if eccentricity_deg >= 90.0 {
                    return None;
                }
                let (f, cos) = (view.mean_focal_px(), libm::cos(e));
                (f * libm::tan(e), DEG * f / (cos * cos), DEG * f / cos)
            }
            EccentricityKind::Angular => {
                let ray = |offset: [f64; 2], z: f64| {
                    [offset[0] / view.focal_px[0], offset[1] / view.focal_px[1], z]
                };
                let [cx, cy] = view.principal_px;
                let gaze = ray([gaze_px[0] - cx, gaze_px[1] - cy], 1.0);
                let along = ray(direction, 0.0);
                let side = ray([-direction[1], direction[0]], 0.0);
                let turned = norm(cross(gaze, along));
                let (sin, cos) = (libm::sin(e), libm::cos(e));
                let room = turned * cos - dot(gaze, along) * sin;
                // This near to the horizon, a radius would consist of rounding errors only.
                if room <= 1e-9 * turned {
                    return None;
                }
                let radius_px = dot(gaze, gaze) * sin / room;
                let at: [f64; 3] = std::array::from_fn(|i| gaze[i] + radius_px * along[i]);
                let square = dot(at, at);
                (radius_px, DEG * square / turned, DEG * square / norm(cross(at, side)))
            }
        };
        let tangential = match tangential {
            Tangential::Paper => radial,
            Tangential::Angle => across,
        };
        Some(Self { radius_px, radial, tangential })
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::eccentricity::Eccentricity;
    use crate::view::ViewSpec;

    fn view(fov_vertical_deg: f64) -> View {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(fov_vertical_deg) };
        spec.resolve(2560, 1440).unwrap().view
    }

    proptest! {
        /// Compares the scale with numerical derivatives of eccentricity, for any gaze.
        #[test]
        fn is_the_derivative_of_eccentricity(
            gaze in (0.0..2560.0f64, 0.0..1440.0f64), direction_deg in 0.0..360.0f64,
            e in 0.5..70.0f64, planar in any::<bool>()
        ) {
            let kind = if planar { EccentricityKind::Planar } else { EccentricityKind::Angular };
            let (sin, cos) = direction_deg.to_radians().sin_cos();
            let (view, gaze_px) = (view(110.0), [gaze.0, gaze.1]);
            let scale =
                PixelScale::at(&view, gaze_px, kind, Tangential::Angle, [cos, sin], e);
            let Some(scale) = scale else { return Ok(()) };
            let at_deg = |r: f64| {
                Eccentricity::new(view, gaze_px, kind).at_deg(gaze.0 + r * cos, gaze.1 + r * sin)
            };
            prop_assert!((at_deg(scale.radius_px) - e).abs() < 1e-9);
            let h = scale.radius_px * 1e-5;
            let slope = (at_deg(scale.radius_px + h) - at_deg(scale.radius_px - h)) / (2.0 * h);
            prop_assert!((slope * scale.radial - 1.0).abs() < 1e-6);
            if !planar {
                // Across the line: the angle between the rays to two points beside the position.
                let (x, y) = (gaze.0 + scale.radius_px * cos, gaze.1 + scale.radius_px * sin);
                let beside = Eccentricity::new(view, [x - h * sin, y + h * cos], kind);
                let angle = beside.at_deg(x + h * sin, y - h * cos) / (2.0 * h);
                prop_assert!((angle * scale.tangential - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn both_kinds_agree_at_the_principal_point() {
        for e in [0.0, 0.25, 30.0, 60.0] {
            for tangential in [Tangential::Paper, Tangential::Angle] {
                let at = |kind| {
                    PixelScale::at(&view(110.0), [1280.0, 720.0], kind, tangential, [0.6, 0.8], e)
                };
                let planar = at(EccentricityKind::Planar).unwrap();
                let angular = at(EccentricityKind::Angular).unwrap();
                for (a, b) in [
                    (planar.radius_px, angular.radius_px),
                    (planar.radial, angular.radial),
                    (planar.tangential, angular.tangential),
                ] {
                    assert!((a - b).abs() <= 1e-9 * b.abs(), "{e}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn no_pixel_is_beyond_the_horizon() {
        let at = |kind, e| {
            PixelScale::at(&view(110.0), [0.0, 720.0], kind, Tangential::Paper, [-1.0, 0.0], e)
        };
        assert!(at(EccentricityKind::Angular, 10.0).is_some());
        assert!(at(EccentricityKind::Angular, 30.0).is_none());
        assert!(at(EccentricityKind::Planar, 30.0).is_some());
        assert!(at(EccentricityKind::Planar, 90.0).is_none());
    }

    /// (π/180) f / cos² e along the line. Across it, the papers' convention has the same value, and
    /// the angle has it multiplied by cos e.
    #[test]
    fn the_two_conventions_across_the_line() {
        // If pixels are not square, planar eccentricity uses the geometric mean of the focal
        // lengths.
        let oblong = View { focal_px: [400.0, 900.0], ..view(90.0) };
        for e in [0.0, 10.0, 45.0, 60.0] {
            let at = |tangential| {
                let gaze = oblong.principal_px;
                PixelScale::at(&oblong, gaze, EccentricityKind::Planar, tangential, [0.0, 1.0], e)
                    .unwrap()
            };
            let cos = e.to_radians().cos();
            let degree = 600.0 * PI / 180.0 / (cos * cos);
            let (paper, angle) = (at(Tangential::Paper), at(Tangential::Angle));
            for (found, want) in [
                (paper.radius_px, 600.0 * e.to_radians().tan()),
                (paper.radial, degree),
                (paper.tangential, degree),
                (angle.radial, degree),
                (angle.tangential, degree * cos),
            ] {
                assert!((found - want).abs() <= 1e-12 * want, "{e}: {found} for {want}");
            }
        }
        // The true angle uses the focal length of its own axis: 45° is 900 px along y and 400 px
        // along x.
        for (direction, want) in [([1.0, 0.0], 400.0), ([0.0, 1.0], 900.0)] {
            let gaze = oblong.principal_px;
            let kind = EccentricityKind::Angular;
            let at =
                PixelScale::at(&oblong, gaze, kind, Tangential::Angle, direction, 45.0).unwrap();
            assert!((at.radius_px / want - 1.0).abs() < 1e-12);
            // Along the line dr/de = f / cos² e = 2 f; across it, 1 / cos e times the focal length
            // of the other axis.
            assert!((at.radial / (2.0 * want * PI / 180.0) - 1.0).abs() < 1e-12);
            let other = 360_000.0 / want;
            assert!((at.tangential / (2f64.sqrt() * other * PI / 180.0) - 1.0).abs() < 1e-12);
        }
    }
}
