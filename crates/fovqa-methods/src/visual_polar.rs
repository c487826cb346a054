//! Visual-Polar space (Koskela et al. 2019): a reconstruction from the paper's description, with
//! low confidence.
//!
//! The density of samples is proportional to v(e): 1 for e ≤ 5.79°, else 7.49 / (0.3 e + 1)². The
//! buffer is polar, and its rows shrink linearly towards the gaze inside 5.79°, so that the density
//! is uniform there. The density is C v with C = 0.4 / mean(v) over the frame; above 1 the gaze is
//! supersampled. Outside, the number of samples around the gaze is constant. Our choice of this
//! number makes both rates equal at 5.79° and inside.

use std::f64::consts::TAU;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::foveation::{Counts, Foveation, Mapping, Rates};
use crate::info::MethodInfo;
use crate::quadrature;
use crate::setting::{Place, Setting};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// Samples per pixel of the frame, on average. Default 0.4.
    pub samples_per_pixel: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { samples_per_pixel: 0.4 }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "samples_per_pixel" => self.samples_per_pixel = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "visual_polar",
    label: "Visual-Polar (reconstruction)",
    about: "polar buffer with the density of acuity; reconstructed from the text of the paper, low confidence",
    source: "Koskela et al. 2019",
    params: &[ParamInfo {
        name: "samples_per_pixel",
        default: "0.4",
        values: ParamValues::Number(1e-4, 16.0),
        about: "samples per pixel of the frame, on average",
    }],
};

/// The eccentricity in degrees where the density begins to fall.
const INNER_DEG: f64 = 5.79;

/// Relative visual acuity per area.
fn acuity(eccentricity_deg: f64) -> f64 {
    if eccentricity_deg <= INNER_DEG {
        1.0
    } else {
        let fall = 0.3 * eccentricity_deg + 1.0;
        7.49 / (fall * fall)
    }
}

/// The number of distances, between the inner circle and the farthest corner, at which the number
/// of columns is stored.
const KNOTS: usize = 64;

/// Visual-Polar sampling, applied to a frame.
#[derive(Debug, Clone)]
pub struct VisualPolar {
    setting: Setting,
    /// C.
    density: f64,
    inner_px: f64,
    /// The number of rows outside the inner circle.
    rows: f64,
    /// Distances beyond the inner circle, and the number of columns up to each; a single one if no
    /// corner is beyond the circle.
    knots: Vec<(f64, f64)>,
    samples_per_pixel: f64,
}

impl VisualPolar {
    /// Applies the method to a frame and a gaze.
    pub fn new(params: &Params, setting: &Setting) -> Self {
        let inner_px = setting.radius_px(INNER_DEG);
        let acuity_at = |r| acuity(setting.eccentricity_deg(r));
        let total = setting.integrate(&[0.0, inner_px], acuity_at);
        let density = params.samples_per_pixel * setting.pixels() / total;
        let rows = TAU * inner_px * density.sqrt();
        let mut polar = Self {
            setting: *setting,
            density,
            inner_px,
            rows,
            knots: vec![(inner_px, inner_px * density.sqrt())],
            samples_per_pixel: params.samples_per_pixel,
        };
        let corner_px = setting.corner_px();
        if corner_px > inner_px {
            // Steps are equal in the logarithm of the distance, with which acuity falls.
            let step = libm::log(corner_px / inner_px) / KNOTS as f64;
            for i in 1..=KNOTS {
                let (before, columns) = polar.knots[i - 1];
                let r = inner_px * libm::exp(i as f64 * step);
                polar.knots.push((r, columns + polar.columns_between(before, r)));
            }
        }
        polar
    }

    /// Columns per pixel beyond the inner circle.
    fn columns_slope(&self, r: f64) -> f64 {
        self.density * acuity_beyond(self.setting.eccentricity_deg(r)) * TAU * r / self.rows
    }

    fn columns_between(&self, from: f64, to: f64) -> f64 {
        quadrature::smooth(from, to, |r| self.columns_slope(r))
    }

    /// The number of columns up to a distance.
    fn columns_to(&self, r: f64) -> f64 {
        if r <= self.inner_px {
            return r * self.density.sqrt();
        }
        let knot = self.knots[self.knots.partition_point(|knot| knot.0 <= r).max(1) - 1];
        knot.1 + self.columns_between(knot.0, r)
    }

    /// The distance up to which there are `columns` columns.
    fn radius_px(&self, columns: f64) -> f64 {
        let inner = self.knots[0];
        if columns <= inner.1 {
            return columns / self.density.sqrt();
        }
        let next = self.knots.partition_point(|knot| knot.1 <= columns).max(1);
        let knot = self.knots[next - 1];
        let mut r = knot.0;
        // Newton's method; the slope changes by a few percent between two knots.
        for _ in 0..50 {
            let off = knot.1 + self.columns_between(knot.0, r) - columns;
            let step = off / self.columns_slope(r);
            r -= step;
            if step.abs() <= 1e-13 * r {
                break;
            }
        }
        r
    }

    /// The number of rows of the column at a distance in pixels. Inside the inner circle it falls linearly
    /// towards the gaze.
    pub fn rows_at(&self, r: f64) -> f64 {
        self.rows * (r / self.inner_px).min(1.0)
    }
}

/// Acuity as it falls outside the inner circle; at the border of the circle it is 0.9998.
fn acuity_beyond(eccentricity_deg: f64) -> f64 {
    acuity(eccentricity_deg.max(INNER_DEG.next_up()))
}

impl Mapping for VisualPolar {
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        let corner_px = self.setting.corner_px();
        [self.columns_to(corner_px), self.rows_at(corner_px)]
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let r = place.radius_px;
        [self.columns_to(r), place.angle_deg() / 360.0 * self.rows_at(r)]
    }

    fn to_screen(&self, _layer: usize, [u, v]: [f64; 2]) -> Place {
        let r = self.radius_px(u);
        let rows = self.rows_at(r);
        Place::polar(r, if rows > 0.0 { v / rows * 360.0 } else { 0.0 })
    }

    fn is_polar(&self) -> bool {
        true
    }
}

impl Foveation for VisualPolar {
    fn rates(&self, place: Place) -> Option<Rates> {
        let r = place.radius_px;
        Some(if r <= self.inner_px {
            Rates::both(self.density.sqrt())
        } else {
            Rates { radial: self.columns_slope(r), tangential: self.rows / (TAU * r) }
        })
    }

    fn counts(&self) -> Counts {
        let buffer = self.buffer(0);
        let on_screen = self.samples_per_pixel * self.setting.pixels();
        let corner_px = self.setting.corner_px();
        let inner = self.inner_px.min(corner_px);
        // The area of a triangle of rows inside the circle, and of a rectangle outside.
        let inside = self.rows_at(inner) * self.columns_to(inner) / 2.0;
        let outside = self.rows * (buffer[0] - self.columns_to(inner));
        Counts {
            buffers: vec![buffer],
            samples: inside + outside,
            samples_on_screen: on_screen,
            samples_beyond: 0.0,
            samples_seen: on_screen,
        }
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }

    fn note(&self) -> Option<String> {
        Some(
            "Visual-Polar is a reconstruction from the text of the paper, with low confidence"
                .to_owned(),
        )
    }
}
