//! Views that can be, but are more likely a slip: other units than those asked for.
//!
//! A frustum in degrees is an error of its own ([`crate::ViewError::FrustumAngles`]). One in radians
//! cannot be told from tangents by its values, which are of the same size; but it rarely makes square
//! pixels, which eye buffers have.

use std::fmt;

use crate::view::{View, ViewSpec};

/// A field of view beyond which a pinhole image is hardly ever rendered, degrees.
const WIDEST_DEG: f64 = 170.0;
/// The smallest field of view of a display, degrees.
const NARROWEST_DEG: f64 = 5.0;
/// Five times the pixels per degree that show the finest grating an eye sees (60 cycles per degree).
const FINEST_PPD: f64 = 600.0;
/// How far from square pixels may be: more than eye buffers of headsets are.
const SQUARE: f64 = 0.03;

/// Why a view is questionable. Its text is one sentence that names the likely slip.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// A side that is seen under more than 170°.
    Wide {
        /// Angle across and down.
        field_deg: [f64; 2],
        /// What is in which unit.
        hint: String,
    },
    /// A field of less than 5°, or more pixels per degree than any eye resolves.
    Narrow {
        /// Angle across and down.
        field_deg: [f64; 2],
        /// What is in which unit.
        hint: String,
    },
    /// Pixels that are far from square.
    Oblong {
        /// Focal length in pixels, along x and y.
        focal_px: [f64; 2],
        /// What may be wrong.
        hint: String,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wide { field_deg: [x, y], hint } | Self::Narrow { field_deg: [x, y], hint } => {
                write!(
                    f,
                    "the view sees {} x {} degrees, which is questionable: {hint}",
                    short(*x),
                    short(*y)
                )
            }
            Self::Oblong { focal_px: [x, y], hint } => write!(
                f,
                "the view makes pixels {:.1} % {} than they are {}: {hint}",
                100.0 * (x.max(*y) / x.min(*y) - 1.0),
                if x < y { "wider" } else { "taller" },
                if x < y { "tall" } else { "wide" },
            ),
        }
    }
}

/// A number to three digits.
fn short(number: f64) -> String {
    let digits = (2 - number.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{number:.digits$}")
}

impl ViewSpec {
    /// What is questionable about the view that these words give of a frame.
    pub fn doubts(&self, view: &View) -> Vec<Doubt> {
        let size = [view.width as f64, view.height as f64];
        let field_deg = std::array::from_fn(|i| {
            let (focal, centre) = (view.focal_px[i], view.principal_px[i]);
            (libm::atan(centre / focal) + libm::atan((size[i] - centre) / focal)).to_degrees()
        });
        let mut doubts = Vec::new();
        if matches!(self, ViewSpec::Display(_)) {
            return doubts;
        }
        let is_given_as_angle =
            !matches!(self, ViewSpec::PixelPitch { .. } | ViewSpec::Screen { .. });
        let is_narrow = is_given_as_angle
            && field_deg.iter().any(|angle| *angle < NARROWEST_DEG)
            && field_deg.iter().all(|angle| *angle < 2.0 * NARROWEST_DEG);
        if field_deg.iter().any(|angle| *angle > WIDEST_DEG) {
            doubts.push(Doubt::Wide { field_deg, hint: self.units(false) });
        } else if is_narrow || view.pixels_per_degree() > FINEST_PPD {
            doubts.push(Doubt::Narrow { field_deg, hint: self.units(true) });
        }
        let [x, y] = view.focal_px;
        if x.max(y) / x.min(y) > 1.0 + SQUARE {
            doubts.push(Doubt::Oblong { focal_px: [x, y], hint: self.squared(size) });
        }
        doubts
    }

    /// What is in which unit, and what it may have been.
    fn units(&self, narrow: bool) -> String {
        let radians = |angle: f64| {
            let angle_deg = angle.to_degrees();
            let fits = narrow && angle_deg > NARROWEST_DEG && angle_deg < WIDEST_DEG;
            let hint = format!("; {angle} radians would be {} degrees", short(angle_deg));
            if fits { hint } else { String::new() }
        };
        match *self {
            ViewSpec::Fov { horizontal_deg, vertical_deg } => {
                let angle = vertical_deg.or(horizontal_deg).unwrap_or_default();
                format!("fields of view are in degrees, and whole angles{}", radians(angle))
            }
            ViewSpec::FovDiagonal { diagonal_deg } => {
                format!("fields of view are in degrees, and whole angles{}", radians(diagonal_deg))
            }
            ViewSpec::PixelPitch { distance_m, pitch_mm } => format!(
                "the distance is {distance_m} metres and a pixel {pitch_mm} millimetres{}",
                millimetres(distance_m)
            ),
            ViewSpec::Screen { distance_m, size_m: [w, h] } => format!(
                "the distance is {distance_m} metres and the screen {w} x {h} metres{}",
                millimetres(distance_m)
            ),
            ViewSpec::Frustum { .. } | ViewSpec::Display(_) => {
                "a frustum is given by the tangents of its half angles".to_owned()
            }
        }
    }

    /// What may have made pixels oblong.
    fn squared(&self, [w, h]: [f64; 2]) -> String {
        match *self {
            ViewSpec::Frustum { left, right, up, down } => {
                let [l, r, u, d] = [left, right, up, down].map(|side| libm::tan(side.abs()));
                let ratio = (w / (l + r)) / (h / (u + d));
                let radians = if (ratio - 1.0).abs() < SQUARE / 3.0 {
                    let tangents = [l, r, u, d].map(short).join(", ");
                    format!(
                        "; as half angles in radians, these would be the tangents {tangents}, with square pixels"
                    )
                } else {
                    String::new()
                };
                format!(
                    "check that these are tangents of half angles, in the order left, right, up, down{radians}"
                )
            }
            _ => "check which value is the horizontal one, and that the frame fills this field"
                .to_owned(),
        }
    }
}

/// What a distance may have been that is far for metres.
fn millimetres(distance_m: f64) -> String {
    if distance_m >= 100.0 {
        format!("; {distance_m} millimetres would be {} metres", distance_m / 1000.0)
    } else if distance_m >= 20.0 {
        format!("; {distance_m} centimetres would be {} metres", distance_m / 100.0)
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn doubts(spec: &ViewSpec, width: usize, height: usize) -> String {
        let view = spec.resolve(width, height).unwrap().view;
        let doubts = spec.doubts(&view);
        doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    }

    fn vertical(vertical_deg: f64) -> ViewSpec {
        ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(vertical_deg) }
    }

    #[test]
    fn usual_views_are_not_questioned() {
        let frustum = ViewSpec::Frustum { left: 1.39, right: 1.24, up: 1.46, down: 1.46 };
        for (spec, w, h) in [
            (vertical(110.0), 1440, 1600),
            (vertical(150.0), 1024, 1024),
            (vertical(60.0), 64, 48),
            (ViewSpec::FovDiagonal { diagonal_deg: 110.0 }, 1440, 1600),
            (ViewSpec::Fov { horizontal_deg: Some(90.0), vertical_deg: Some(90.0) }, 1600, 1600),
            (frustum, 1512, 1680),
            (ViewSpec::PixelPitch { distance_m: 0.6, pitch_mm: 0.25 }, 16, 16),
            (ViewSpec::PixelPitch { distance_m: 10.0, pitch_mm: 1.2 }, 1920, 1080),
            (ViewSpec::Screen { distance_m: 0.6, size_m: [0.48, 0.27] }, 1920, 1080),
        ] {
            assert_eq!(doubts(&spec, w, h), "", "{spec:?}");
        }
    }

    #[test]
    fn slips_are_named() {
        let pitch = |distance_m, pitch_mm| ViewSpec::PixelPitch { distance_m, pitch_mm };
        let both = |x, y| ViewSpec::Fov { horizontal_deg: Some(x), vertical_deg: Some(y) };
        let radians = |left, right, up, down| ViewSpec::Frustum { left, right, up, down };
        for (spec, words) in [
            (vertical(1.92), "1.92 radians would be 110 degrees"),
            (vertical(175.0), "whole angles"),
            (pitch(600.0, 0.25), "600 millimetres would be 0.6 metres"),
            (pitch(60.0, 0.25), "60 centimetres would be 0.6 metres"),
            (pitch(0.6, 250.0), "a pixel 250 millimetres"),
            (ViewSpec::Screen { distance_m: 0.6, size_m: [480.0, 530.0] }, "480 x 530 metres"),
            (both(100.0, 90.0), "wider than they are tall: check which value"),
            (
                radians(0.785_398, 0.785_398, 0.837_981, 0.837_981),
                "the tangents 1.00, 1.00, 1.11, 1.11",
            ),
            (radians(1.46, 1.39, 1.24, 1.46), "in the order left, right, up, down"),
        ] {
            let found = doubts(&spec, 1440, 1600);
            assert!(found.contains(words), "{words:?} is not in {found:?}");
        }
    }

    #[test]
    fn frusta_in_degrees_are_refused_with_their_tangents() {
        for (given, tangents) in
            [([45.0; 4], "1, 1, 1, 1"), ([50.0, 30.0, 45.0, 12.0], "1.1918, 0.5774, 1, 0.2126")]
        {
            let [left, right, up, down] = given;
            let error = ViewSpec::Frustum { left, right, up, down }.check().unwrap_err();
            assert!(
                error.to_string().ends_with(&format!("the tangents are {tangents}")),
                "{error}"
            );
        }
        let openxr = ViewSpec::Frustum { left: -45.0, right: 45.0, up: 45.0, down: -45.0 };
        assert!(openxr.check().unwrap_err().to_string().ends_with("-1, 1, 1, -1"));
    }
}
