//! The view: a pinhole eye buffer, and the ways to specify it.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::displays::Display;

/// A pinhole eye buffer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Focal length in pixels, along x and y.
    pub focal_px: [f64; 2],
    /// Principal point in pixels from the top-left corner.
    pub principal_px: [f64; 2],
}

impl View {
    /// The focal length in pixels as a single number: the geometric mean of both axes.
    pub fn mean_focal_px(&self) -> f64 {
        let [x, y] = self.focal_px;
        // The result is exactly the focal length if both are equal.
        if x.to_bits() == y.to_bits() { x } else { (x * y).sqrt() }
    }

    /// Pixels per degree at the principal point.
    pub fn pixels_per_degree(&self) -> f64 {
        self.mean_focal_px() * std::f64::consts::PI / 180.0
    }

    /// The display's Nyquist frequency at the principal point, in cycles per degree.
    pub fn nyquist_cpd(&self) -> f64 {
        self.pixels_per_degree() / 2.0
    }
}

/// The ways to specify a view. Angles are full angles in degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ViewSpec {
    /// Horizontal or vertical field of view, or both. If only one is given, pixels are square.
    Fov {
        /// Full horizontal angle in degrees.
        horizontal_deg: Option<f64>,
        /// Full vertical angle in degrees.
        vertical_deg: Option<f64>,
    },
    /// Diagonal field of view, corner to corner; square pixels.
    FovDiagonal {
        /// Full diagonal angle in degrees.
        diagonal_deg: f64,
    },
    /// Tangents of the half angles of an asymmetric frustum. Either all four are positive away from
    /// the axis, or they are signed as in OpenXR (left and down negative).
    Frustum {
        /// Tangent to the left of the axis.
        left: f64,
        /// Tangent to the right of the axis.
        right: f64,
        /// Tangent above the axis.
        up: f64,
        /// Tangent below the axis.
        down: f64,
    },
    /// A flat screen seen from in front of its centre; square pixels.
    PixelPitch {
        /// Distance from the eye in metres.
        distance_m: f64,
        /// Size of a pixel in millimetres.
        pitch_mm: f64,
    },
    /// A flat screen of a given size that the frame fills.
    Screen {
        /// Distance from the eye in metres.
        distance_m: f64,
        /// Width and height in metres.
        size_m: [f64; 2],
    },
    /// A display preset; the frame fills its whole field.
    Display(Display),
}

/// A view that is not possible.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ViewError {
    /// An angle is outside (0°, 180°).
    #[error("the {which} field of view of {found_deg}° is not between 0° and 180°")]
    Fov {
        /// Name of the angle.
        which: &'static str,
        /// The angle that was given, in degrees.
        found_deg: f64,
    },
    /// No angle is given.
    #[error("a field of view needs a horizontal or a vertical angle")]
    NoFov,
    /// The tangents do not open to both sides.
    #[error(
        "the frustum tangents must be positive and at most 6000 (or left and down negative, as in \
         OpenXR): left {left}, right {right}, up {up}, down {down}"
    )]
    Frustum {
        /// Left tangent as given.
        left: f64,
        /// Right tangent as given.
        right: f64,
        /// Upper tangent as given.
        up: f64,
        /// Lower tangent as given.
        down: f64,
    },
    /// Tangents of more than 85°, which are most likely angles in degrees.
    #[error(
        "a frustum with the tangents {} extends more than 85° to one side; if these are angles in degrees, \
         the tangents are {}",
        with_commas(*given), with_commas(given.map(|angle| libm::tan(angle.to_radians())))
    )]
    FrustumAngles {
        /// Left, right, up and down as given.
        given: [f64; 4],
    },
    /// A focal length is outside any sensible range.
    #[error("the view's focal length of {found_px} px is not between 0.001 and 100,000,000")]
    Focal {
        /// The focal length that follows from the view, in pixels.
        found_px: f64,
    },
    /// A length is not positive.
    #[error("the {which} of {found} is not a positive length")]
    Length {
        /// Name of the length.
        which: &'static str,
        /// The value that was given.
        found: f64,
    },
}

/// A view for frames of a given size.
#[derive(Debug, Clone, PartialEq)]
pub struct ResolvedView {
    /// The view.
    pub view: View,
    /// The display's own size, if the frame was stretched to fill a display of another size.
    pub stretched_from: Option<[usize; 2]>,
}

/// The range of focal lengths in pixels: it includes those of all displays, and a float still
/// resolves all of it.
const FOCAL_PX: std::ops::RangeInclusive<f64> = 1e-3..=1e8;

impl ViewSpec {
    /// Checks everything that does not depend on the frame's size.
    ///
    /// # Errors
    /// As [`ViewSpec::resolve`].
    pub fn check(&self) -> Result<(), ViewError> {
        self.unbounded(2, 2).map(|_| ())
    }

    /// The view of a frame of `width` x `height` pixels.
    ///
    /// # Errors
    /// When an angle is not inside (0°, 180°), a length is not positive, a frustum does not open,
    /// or the focal length is outside any sensible range.
    pub fn resolve(&self, width: usize, height: usize) -> Result<ResolvedView, ViewError> {
        let resolved = self.unbounded(width, height)?;
        match resolved.view.focal_px.iter().find(|f| !FOCAL_PX.contains(*f)) {
            Some(&found_px) => Err(ViewError::Focal { found_px }),
            None => Ok(resolved),
        }
    }

    fn unbounded(&self, width: usize, height: usize) -> Result<ResolvedView, ViewError> {
        let (w, h) = (width as f64, height as f64);
        let centred =
            |focal_px: [f64; 2]| View { width, height, focal_px, principal_px: [w / 2.0, h / 2.0] };
        let mut stretched_from = None;
        let view = match *self {
            ViewSpec::Fov { horizontal_deg, vertical_deg } => {
                let x = horizontal_deg.map(|a| focal(w, a, "horizontal")).transpose()?;
                let y = vertical_deg.map(|a| focal(h, a, "vertical")).transpose()?;
                let one = x.or(y).ok_or(ViewError::NoFov)?;
                centred([x.unwrap_or(one), y.unwrap_or(one)])
            }
            ViewSpec::FovDiagonal { diagonal_deg } => {
                centred([focal(libm::hypot(w, h), diagonal_deg, "diagonal")?; 2])
            }
            ViewSpec::Frustum { left, right, up, down } => {
                let [l, r, u, d] = frustum_sides(left, right, up, down)?;
                View {
                    width,
                    height,
                    focal_px: [w / (l + r), h / (u + d)],
                    principal_px: [w * l / (l + r), h * u / (u + d)],
                }
            }
            ViewSpec::PixelPitch { distance_m, pitch_mm } => {
                let distance = length(distance_m, "viewing distance")?;
                let pitch = length(pitch_mm, "pixel pitch")?;
                centred([distance * 1000.0 / pitch; 2])
            }
            ViewSpec::Screen { distance_m, size_m } => {
                let distance = length(distance_m, "viewing distance")?;
                let width = length(size_m[0], "screen width")?;
                let height = length(size_m[1], "screen height")?;
                centred([w * distance / width, h * distance / height])
            }
            ViewSpec::Display(ref display) => {
                let [dw, dh] = display.resolution;
                if [width, height] != [dw, dh] {
                    stretched_from = Some([dw, dh]);
                }
                let [fx, fy] = display.focal_px();
                centred([fx * w / dw as f64, fy * h / dh as f64])
            }
        };
        Ok(ResolvedView { view, stretched_from })
    }
}

fn focal(extent_px: f64, fov_deg: f64, which: &'static str) -> Result<f64, ViewError> {
    if !(fov_deg > 0.0 && fov_deg < 180.0) {
        return Err(ViewError::Fov { which, found_deg: fov_deg });
    }
    Ok(extent_px / 2.0 / libm::tan((fov_deg / 2.0).to_radians()))
}

fn length(value: f64, which: &'static str) -> Result<f64, ViewError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(ViewError::Length { which, found: value })
    }
}

/// Four numbers as a message shows them.
fn with_commas(numbers: [f64; 4]) -> String {
    numbers.map(|number| ((number * 1e4).round() / 1e4).to_string()).join(", ")
}

fn frustum_sides(left: f64, right: f64, up: f64, down: f64) -> Result<[f64; 4], ViewError> {
    /// The tangent of 85°. No eye buffer sees more to one side, and any half angle of 12° or more
    /// that is given in degrees is larger.
    const STEEPEST: f64 = 11.430_052_302_761_343;
    /// The tangent of 89.99°, which is larger than any angle in degrees.
    const LARGEST: f64 = 6000.0;
    let sides =
        if left < 0.0 && down < 0.0 { [-left, right, up, -down] } else { [left, right, up, down] };
    if !sides.iter().all(|side| *side > 0.0 && *side <= LARGEST) {
        return Err(ViewError::Frustum { left, right, up, down });
    }
    if sides.iter().any(|side| *side > STEEPEST) {
        return Err(ViewError::FrustumAngles { given: [left, right, up, down] });
    }
    Ok(sides)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]
mod tests {
    use super::*;
    use crate::displays::find_display;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-6 * b.abs()
    }

    #[test]
    fn the_ways_to_give_a_view_agree() {
        let vertical = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(100.0) };
        let view = vertical.resolve(1440, 1600).unwrap().view;
        assert!(near(view.focal_px[1], 671.279_704_941_824));
        assert_eq!(view.focal_px[0].to_bits(), view.focal_px[1].to_bits());
        let t = (50f64).to_radians().tan();
        let symmetric = ViewSpec::Frustum { left: 0.9 * t, right: 0.9 * t, up: t, down: t };
        let openxr = ViewSpec::Frustum { left: -0.9 * t, right: 0.9 * t, up: t, down: -t };
        for spec in [symmetric, openxr] {
            let same = spec.resolve(1440, 1600).unwrap().view;
            assert!(
                near(same.focal_px[0], view.focal_px[0])
                    && near(same.focal_px[1], view.focal_px[1])
            );
            assert!(near(same.principal_px[0], 720.0) && near(same.principal_px[1], 800.0));
        }
        let diagonal = ViewSpec::FovDiagonal { diagonal_deg: 110.0 }.resolve(1440, 1600).unwrap();
        assert!(near(0.5 / (0.5 / diagonal.view.focal_px[0]).atan().to_degrees(), 13.153_262_5));
        let pitch = ViewSpec::PixelPitch { distance_m: 0.6, pitch_mm: 0.25 };
        assert!(near(pitch.resolve(10, 10).unwrap().view.focal_px[0], 2400.0));
        let screen = ViewSpec::Screen { distance_m: 0.6, size_m: [0.48, 0.27] };
        assert!(near(screen.resolve(1920, 1080).unwrap().view.focal_px[1], 2400.0));
    }

    #[test]
    fn an_asymmetric_frustum_moves_the_principal_point() {
        let spec = ViewSpec::Frustum { left: 1.0, right: 3.0, up: 0.5, down: 1.5 };
        let view = spec.resolve(400, 200).unwrap().view;
        assert_eq!(view.principal_px.map(f64::round), [100.0, 50.0]);
        assert_eq!(view.focal_px.map(f64::round), [100.0, 100.0]);
    }

    #[test]
    fn a_frame_fills_the_whole_display() {
        let display = find_display("standard-4k").unwrap().clone();
        let full = ViewSpec::Display(display.clone()).resolve(3840, 2160).unwrap();
        assert!(full.stretched_from.is_none());
        let half = ViewSpec::Display(display).resolve(1920, 2160).unwrap();
        assert_eq!(half.stretched_from, Some([3840, 2160]));
        assert!(near(half.view.focal_px[0] * 2.0, full.view.focal_px[0]));
        assert!(near(half.view.focal_px[1], full.view.focal_px[1]));
    }

    #[test]
    fn refuses_frequencies_that_no_eye_sees() {
        for bad in [0.0, -10.0, 180.0, f64::NAN] {
            let spec = ViewSpec::Fov { horizontal_deg: Some(bad), vertical_deg: None };
            assert!(spec.check().is_err(), "{bad}");
        }
        assert!(ViewSpec::PixelPitch { distance_m: 0.5, pitch_mm: 0.0 }.check().is_err());
        assert!(ViewSpec::Frustum { left: -1.0, right: 1.0, up: 1.0, down: 1.0 }.check().is_err());
    }
}
