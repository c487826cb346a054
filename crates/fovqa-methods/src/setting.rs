//! The setting to which a method is applied: a frame, its focal length and the gaze.

use std::f64::consts::{PI, TAU};

use fovqa_vision::View;

use crate::error::MethodError;
use crate::quadrature;

/// Relative tolerance of bounds: a place this near to a bound counts as being at the bound, because
/// its distance was computed from the eccentricity of the bound and has been rounded.
const ROUNDING: f64 = 1e-10;

/// Whether a value is at most a bound, within rounding.
pub(crate) fn up_to(value: f64, bound: f64) -> bool {
    value <= bound * (1.0 + ROUNDING)
}

/// A place on the screen, relative to the gaze.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Distance from the gaze in pixels.
    pub radius_px: f64,
    /// Unit vector from the gaze. At the gaze itself it is the direction in which rates are
    /// measured.
    pub direction: [f64; 2],
}

impl Place {
    /// The place at an offset from the gaze in pixels. At the gaze itself the direction is to the
    /// right.
    pub fn at([x, y]: [f64; 2]) -> Self {
        let radius_px = libm::hypot(x, y);
        let direction = if radius_px > 0.0 { [x / radius_px, y / radius_px] } else { [1.0, 0.0] };
        Self { radius_px, direction }
    }

    /// The place at a distance in pixels and a direction in degrees from +x towards +y. Multiples
    /// of 90° are exact.
    pub fn polar(radius_px: f64, direction_deg: f64) -> Self {
        let turn = libm::fmod(libm::fmod(direction_deg, 360.0) + 360.0, 360.0);
        let quarter = (turn / 90.0).floor();
        let (sin, cos) = libm::sincos((turn - 90.0 * quarter).to_radians());
        let direction = match quarter as u8 {
            0 => [cos, sin],
            1 => [-sin, cos],
            2 => [-cos, -sin],
            _ => [sin, -cos],
        };
        Self { radius_px, direction }
    }

    /// Offset from the gaze in pixels.
    pub fn offset_px(&self) -> [f64; 2] {
        self.direction.map(|d| d * self.radius_px)
    }

    /// θ = atan2(y, x) in [0°, 360°); 0 at the gaze itself.
    pub fn angle_deg(&self) -> f64 {
        if self.radius_px == 0.0 {
            return 0.0;
        }
        let deg = libm::atan2(self.direction[1], self.direction[0]) * (180.0 / PI);
        let positive = if deg < 0.0 { deg + 360.0 } else { deg };
        // A tiny negative angle is rounded to 360.
        if positive >= 360.0 { 0.0 } else { positive }
    }
}

/// A frame, its focal length and the gaze.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    size_px: [f64; 2],
    focal_px: f64,
    gaze_px: [f64; 2],
}

impl Setting {
    /// The setting of a view and a gaze in pixels. A gaze outside the frame is clamped to it. If
    /// pixels are not square, the focal length is the geometric mean.
    ///
    /// # Errors
    /// When the frame has no pixels, the focal length is not positive, or the gaze is not finite.
    pub fn new(view: &View, gaze_px: [f64; 2]) -> Result<Self, MethodError> {
        let focal_px = view.mean_focal_px();
        let message = if view.width == 0 || view.height == 0 {
            format!(
                "a resolution of {}x{} has no pixels: both sides must be at least 1",
                view.width, view.height
            )
        } else if !(focal_px > 0.0 && focal_px.is_finite()) {
            format!("a focal length of {focal_px} px is not positive")
        } else if !gaze_px.iter().all(|g| g.is_finite()) {
            format!("a gaze at {gaze_px:?} is not a position")
        } else {
            let size_px = [view.width as f64, view.height as f64];
            let gaze_px = [0, 1].map(|i| gaze_px[i].clamp(0.0, size_px[i]));
            return Ok(Self { size_px, focal_px, gaze_px });
        };
        Err(MethodError::Setting(message))
    }

    /// Width and height in pixels.
    pub fn size_px(&self) -> [f64; 2] {
        self.size_px
    }

    /// The number of pixels of the frame.
    pub fn pixels(&self) -> f64 {
        self.size_px[0] * self.size_px[1]
    }

    /// Focal length in pixels: 1 / c_r of VaFR's Eq. 3.
    pub fn focal_px(&self) -> f64 {
        self.focal_px
    }

    /// The gaze, clamped to the frame, in pixels from its top-left corner.
    pub fn gaze_px(&self) -> [f64; 2] {
        self.gaze_px
    }

    /// The planar eccentricity in degrees at a distance in pixels (VaFR, Eq. 3).
    pub fn eccentricity_deg(&self, radius_px: f64) -> f64 {
        libm::atan2(radius_px, self.focal_px) * (180.0 / PI)
    }

    /// The distance in pixels at a planar eccentricity in degrees below 90.
    pub fn radius_px(&self, eccentricity_deg: f64) -> f64 {
        self.focal_px * libm::tan(eccentricity_deg * (PI / 180.0))
    }

    /// Distance in pixels from the gaze to the border along an axis (0: x, 1: y), on the side of
    /// `sign`; 0 counts as positive.
    pub fn side_px(&self, axis: usize, sign: f64) -> f64 {
        if sign < 0.0 { self.gaze_px[axis] } else { self.size_px[axis] - self.gaze_px[axis] }
    }

    /// Distance in pixels from the gaze to the farthest corner.
    pub fn corner_px(&self) -> f64 {
        let far = |axis| self.side_px(axis, -1.0).max(self.side_px(axis, 1.0));
        libm::hypot(far(0), far(1))
    }

    /// Distance in pixels from the gaze to the border in a direction, which is a unit vector.
    pub fn edge_px(&self, direction: [f64; 2]) -> f64 {
        let to_side = |axis: usize| {
            let d = direction[axis];
            if d == 0.0 { f64::INFINITY } else { self.side_px(axis, d) / d.abs() }
        };
        to_side(0).min(to_side(1))
    }

    /// The integral over the frame of a density that depends only on the distance from the gaze.
    /// `breaks_px` are distances where it is not smooth; the integral starts at the first of them.
    pub(crate) fn integrate(&self, breaks_px: &[f64], density: impl Fn(f64) -> f64) -> f64 {
        let from = breaks_px.first().copied().unwrap_or(0.0);
        let corner = self.corner_px();
        let mut places: Vec<f64> = breaks_px.to_vec();
        // The arcs within the frame change their form at these distances.
        let sides = |axis| [self.side_px(axis, -1.0), self.side_px(axis, 1.0)];
        for x in sides(0) {
            for y in sides(1) {
                places.extend([x, y, libm::hypot(x, y)]);
            }
        }
        // Densities fall over decades of distance, so the pieces double in length.
        let mut step = 1.0;
        while step < corner {
            places.push(step);
            step *= 2.0;
        }
        places.push(corner);
        places.retain(|r| *r >= from && *r <= corner);
        places.sort_by(f64::total_cmp);
        let pieces = places.windows(2).filter(|ends| ends[1] > ends[0]);
        pieces
            .map(|ends| quadrature::rooted(ends[0], ends[1], |r| density(r) * r * self.arc(r)))
            .sum()
    }

    /// The integral over the frame of a density that depends only on the distance from the gaze,
    /// from `within`, the integral over a full disc of a radius: it is the mean of `within` over
    /// the border's distances in all directions. This is for densities that are infinite somewhere
    /// while `within` is not. `breaks_px` are distances where it is not smooth.
    pub(crate) fn integrate_within(&self, breaks_px: &[f64], within: impl Fn(f64) -> f64) -> f64 {
        let mut angles = vec![0.0, TAU];
        let axes = [(0, 1.0), (1, 1.0), (0, -1.0), (1, -1.0)];
        for (i, &(axis, sign)) in axes.iter().enumerate() {
            let (side, turn) = (self.side_px(axis, sign), i as f64 * PI / 2.0);
            let beside = [-1.0, 1.0].map(|s| libm::atan2(s * self.beside_px(axis, sign, s), side));
            let breaks = breaks_px.iter().filter(|r| **r > side).map(|r| libm::acos(side / r));
            let breaks = breaks.flat_map(|a| [-a, a]).filter(|a| beside[0] < *a && *a < beside[1]);
            let all = breaks.chain(beside).map(|a| libm::fmod(turn + a + TAU, TAU));
            angles.extend(all);
        }
        angles.sort_by(f64::total_cmp);
        let pieces = angles.windows(2).filter(|ends| ends[1] > ends[0]);
        let at = |angle| {
            let (sin, cos) = libm::sincos(angle);
            within(self.edge_px([cos, sin]))
        };
        pieces.map(|ends| quadrature::rooted_at_both(ends[0], ends[1], at)).sum::<f64>() / TAU
    }

    /// The distance from the gaze to the side next to another side, as seen in its direction: on
    /// the side of falling angles (-1) or of rising angles (1).
    fn beside_px(&self, axis: usize, sign: f64, side: f64) -> f64 {
        // Angles rise from +x towards +y, and from +y towards -x.
        let towards = if axis == 0 { side * sign } else { -side * sign };
        self.side_px(1 - axis, towards)
    }

    /// The angle in radians of the part of a circle around the gaze that lies in the frame.
    fn arc(&self, radius_px: f64) -> f64 {
        let mut arc = 0.0;
        for x in [self.side_px(0, -1.0), self.side_px(0, 1.0)] {
            for y in [self.side_px(1, -1.0), self.side_px(1, 1.0)] {
                let begin = libm::acos((x / radius_px).min(1.0));
                let end = libm::asin((y / radius_px).min(1.0));
                arc += (end - begin).max(0.0);
            }
        }
        arc.min(TAU)
    }
}
