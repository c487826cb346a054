//! The position of a band's pixels on the display, as FovVideoVDP defines it.
//!
//! The direction of a point is the pair of angles atan((x - c_x) / f_x), atan((c_y - y) / f_y), in
//! degrees; every band is stretched over the whole frame. Eccentricity is the Euclidean distance of
//! two such pairs, not the angle between the rays. The resolution magnification m = (tan(A + δ) -
//! tan A) / tan δ = cos δ / (cos A cos(A + δ)), with δ = 0.5 / ppd degrees and the angle A from the
//! centre, tells how many times more pixels a degree has in that direction.

use fovqa_vision::View;
use multiversion::multiversion;

use super::band::Band;
use super::calibration::FARTHEST_DEG;
use super::csf::{Coordinates, ECC_STEPS, RHO_FROM, RHO_STEPS_PER_OCTAVE};
use crate::log_exp::{log2, sine};

/// The geometry of a frame on a display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    /// The view of the frame.
    pub view: View,
    /// Pixels of the display per degree at its centre.
    pub pixels_per_degree: f64,
}

impl Geometry {
    /// The geometry of a view on a display with this number of pixels per degree at the centre, as
    /// [`fovqa_vision::Display::central_pixels_per_degree`] counts them. `None` means that the
    /// pixels of the frame are those of the display.
    pub fn new(view: View, display_pixels_per_degree: Option<f64>) -> Self {
        let own = 0.5 / libm::atan(0.5 / view.focal_px[0]).to_degrees();
        Self { view, pixels_per_degree: display_pixels_per_degree.unwrap_or(own) }
    }

    /// The direction of a point in pixels of the frame, in degrees to the right and up.
    pub fn direction_deg(&self, [x_px, y_px]: [f64; 2]) -> [f64; 2] {
        let View { focal_px: [fx, fy], principal_px: [cx, cy], .. } = self.view;
        [libm::atan((x_px - cx) / fx).to_degrees(), libm::atan((cy - y_px) / fy).to_degrees()]
    }

    /// The factor by which a degree has more pixels at this angle from the centre of the display.
    /// It is negative where another half pixel exceeds 90°: see [`Geometry::passes_90_deg`].
    pub fn magnification(&self, from_centre_deg: f64) -> f64 {
        let angle = from_centre_deg.min(FARTHEST_DEG).to_radians();
        let delta = (0.5 / self.pixels_per_degree).to_radians();
        libm::cos(delta) / (libm::cos(angle) * libm::cos(angle + delta))
    }

    /// Whether a pixel of the frame lies so far from the centre of the display that A + δ passes
    /// 90°, which only happens below 5 pixels per degree. The magnification is negative there, and
    /// so is the frequency. FovVideoVDP then uses the sensitivity of its lowest frequency, 1/16
    /// cpd, so that a difference far from the axis counts much more than it should.
    pub fn passes_90_deg(&self) -> bool {
        let (w, h) = (self.view.width, self.view.height);
        let [columns, rows] = self.directions((w, h));
        let farthest =
            |directions: &[f64]| directions.iter().fold(0.0, |far: f64, d| far.max(d.abs()));
        let corner_deg = libm::hypot(farthest(&columns), farthest(&rows));
        corner_deg.min(FARTHEST_DEG) + 0.5 / self.pixels_per_degree >= 90.0
    }

    /// The directions of the columns and of the rows of a band.
    pub(super) fn directions(&self, (width, height): (usize, usize)) -> [Vec<f64>; 2] {
        let centre =
            |i: usize, count: usize, side: usize| (i as f64 + 0.5) * side as f64 / count as f64;
        let column = |i| self.direction_deg([centre(i, width, self.view.width), 0.0])[0];
        let row = |i| self.direction_deg([0.0, centre(i, height, self.view.height)])[1];
        [(0..width).map(column).collect(), (0..height).map(row).collect()]
    }
}

/// The directions of a band's pixels for one gaze, as coordinates of the sensitivity table.
#[derive(Debug, Clone)]
pub(super) struct BandDirections {
    /// Squares of the angles from the display's centre and from the gaze, for each column.
    columns: [Vec<f32>; 2],
    rows: [Vec<f32>; 2],
    /// log2 of the band's frequency at the centre of the display, multiplied by cos δ, as a table
    /// coordinate.
    rho: f32,
    delta_rad: f32,
}

impl BandDirections {
    pub(super) fn new(geometry: &Geometry, band: &Band, gaze_px: [f64; 2]) -> Self {
        let gaze = geometry.direction_deg(gaze_px);
        let delta = (0.5 / geometry.pixels_per_degree).to_radians();
        let squares = |directions: &[f64], from: f64| {
            directions.iter().map(|deg| ((deg - from) * (deg - from)) as f32).collect()
        };
        let both =
            |directions: &[f64], gaze: f64| [squares(directions, 0.0), squares(directions, gaze)];
        let octaves = libm::log2(band.cpd) + libm::log2(libm::cos(delta));
        Self {
            columns: both(&band.directions[0], gaze[0]),
            rows: both(&band.directions[1], gaze[1]),
            rho: ((octaves - RHO_FROM) * RHO_STEPS_PER_OCTAVE) as f32,
            delta_rad: delta as f32,
        }
    }

    /// The coordinates of row `y`.
    pub(super) fn row(&self, y: usize, out: &mut Coordinates) {
        let Coordinates { rho, ecc } = out;
        let [centre, gaze] = &self.columns;
        let n = centre.len();
        let row = [self.rows[0][y], self.rows[1][y]];
        let band = [self.rho, self.delta_rad];
        coordinates([centre, gaze], row, band, [&mut rho[..n], &mut ecc[..n]]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn coordinates(
    [centre, gaze]: [&[f32]; 2],
    [row_centre, row_gaze]: [f32; 2],
    [rho_of_band, delta_rad]: [f32; 2],
    [rho, ecc]: [&mut [f32]; 2],
) {
    const RADIANS: f32 = (std::f64::consts::PI / 180.0) as f32;
    /// A limit that keeps the logarithm finite. This close to 90° every frequency is beyond the
    /// last node of the table.
    const LEAST_RAD: f32 = 1e-4;
    /// The coordinate of the lowest frequency.
    const LOWEST: f32 = 0.0;
    let n = rho.len();
    let (centre, gaze, ecc) = (&centre[..n], &gaze[..n], &mut ecc[..n]);
    for x in 0..n {
        let from_centre_deg = (centre[x] + row_centre).sqrt().min(FARTHEST_DEG as f32);
        // Cosines are computed as sines of the angle left to 90°, which keeps small cosines
        // accurate.
        let left = std::f32::consts::FRAC_PI_2 - from_centre_deg * RADIANS;
        let left_of_pixel = left - delta_rad;
        let cosines = sine(left) * sine(left_of_pixel.max(LEAST_RAD));
        let at = rho_of_band - log2(cosines) * RHO_STEPS_PER_OCTAVE as f32;
        // Beyond 90° the formula's frequency is negative, and the reference program uses the lowest
        // one.
        rho[x] = if left_of_pixel > 0.0 { at } else { LOWEST };
        ecc[x] = (gaze[x] + row_gaze).sqrt().sqrt() * ECC_STEPS as f32;
    }
}
