//! Eccentricity: the angle between a pixel and the gaze, in degrees.

use std::f64::consts::PI;
use std::ops::Range;

use multiversion::multiversion;

use fovqa_params::words;

use crate::view::View;

words! {
    /// The definition of eccentricity.
    #[derive(Default)]
    pub enum EccentricityKind {
        /// The angle between the ray through the pixel and the ray through the gaze.
        #[default]
        Angular "angular" "The angle between the rays to the pixel and to the gaze";
        /// The papers' shortcut `atan(r / focal_px)`, where `r` is the distance to the gaze in
        /// pixels. It is exact only for a gaze at the principal point.
        Planar "planar" "The papers' shortcut, atan(distance in pixels / focal length)";
    }
}

/// Eccentricity for one view and one gaze.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eccentricity {
    view: View,
    gaze_px: [f64; 2],
    kind: EccentricityKind,
    planar: Planar,
}

/// The quantities for planar eccentricity. Distances are in pixels of the full frame, even over a
/// picture that is scaled unequally along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Planar {
    focal_px: f64,
    /// Size of a pixel of the picture, in pixels of the full frame.
    step_px: [f64; 2],
}

impl Planar {
    /// The distance to the gaze in pixels of the full frame.
    fn offset_px(&self, [dx, dy]: [f64; 2]) -> [f64; 2] {
        [dx * self.step_px[0], dy * self.step_px[1]]
    }
}

impl Eccentricity {
    /// Eccentricity relative to a gaze in pixels, which may lie outside the frame.
    pub fn new(view: View, gaze_px: [f64; 2], kind: EccentricityKind) -> Self {
        let planar = Planar { focal_px: view.mean_focal_px(), step_px: [1.0; 2] };
        Self { view, gaze_px, kind, planar }
    }

    /// The same eccentricity for a picture of another size that replaces the frame, scaled along x
    /// and y. Each of its pixels has the eccentricity of the corresponding position in the frame.
    #[must_use]
    pub fn scaled(&self, (width, height): (usize, usize), scale: [f64; 2]) -> Self {
        let by_scale = |[x, y]: [f64; 2]| [x * scale[0], y * scale[1]];
        let View { focal_px, principal_px, .. } = self.view;
        let (focal_px, principal_px) = (by_scale(focal_px), by_scale(principal_px));
        let view = View { width, height, focal_px, principal_px };
        let [x, y] = self.planar.step_px;
        let planar = Planar { step_px: [x / scale[0], y / scale[1]], ..self.planar };
        Self { view, gaze_px: by_scale(self.gaze_px), kind: self.kind, planar }
    }

    /// The view.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The gaze in pixels.
    pub fn gaze_px(&self) -> [f64; 2] {
        self.gaze_px
    }

    /// The definition of eccentricity.
    pub(crate) fn kind(&self) -> EccentricityKind {
        self.kind
    }

    /// The radii along x and y, in pixels, of the ellipse around the gaze on which the planar
    /// eccentricity is `deg`; `None` if no point has it.
    pub(crate) fn planar_radii_px(&self, deg: f64) -> Option<[f64; 2]> {
        let radius_px = self.planar.focal_px * libm::tan(deg.to_radians());
        (deg > 0.0 && deg < 90.0).then(|| self.planar.step_px.map(|step| radius_px / step))
    }

    /// Eccentricity in degrees of a point in pixels; pixel centres are at +0.5.
    pub fn at_deg(&self, x_px: f64, y_px: f64) -> f64 {
        let radians = match self.kind {
            EccentricityKind::Angular => {
                let (cross, dot, _) = self.rays(x_px, y_px);
                libm::atan2(cross, dot)
            }
            EccentricityKind::Planar => {
                let offset = [x_px - self.gaze_px[0], y_px - self.gaze_px[1]];
                let [dx, dy] = self.planar.offset_px(offset);
                libm::atan2(libm::hypot(dx, dy), self.planar.focal_px)
            }
        };
        radians * (180.0 / PI)
    }

    /// |r x g|, r · g and |r| |g| of the pixel's ray r and the gaze ray g. The cross product is computed from (r - g), so that it is exact near the gaze, where r and g are nearly equal.
    fn rays(&self, x_px: f64, y_px: f64) -> (f64, f64, f64) {
        let [fx, fy] = self.view.focal_px;
        let [cx, cy] = self.view.principal_px;
        let (gx, gy) = ((self.gaze_px[0] - cx) / fx, (self.gaze_px[1] - cy) / fy);
        let (rx, ry) = ((x_px - cx) / fx, (y_px - cy) / fy);
        let (dx, dy) = ((x_px - self.gaze_px[0]) / fx, (y_px - self.gaze_px[1]) / fy);
        let z = dx * gy - dy * gx;
        let cross = (dx * dx + dy * dy + z * z).sqrt();
        let dot = 1.0 + rx * gx + ry * gy;
        let lengths = ((1.0 + rx * rx + ry * ry) * (1.0 + gx * gx + gy * gy)).sqrt();
        (cross, dot, lengths)
    }

    /// A number that increases with eccentricity and is cheap, because it needs no arctangent:
    /// tan(e/2) for angular and tan(e) for planar eccentricity.
    pub(crate) fn ordering_tangent(&self, x_px: f64, y_px: f64) -> f64 {
        match self.kind {
            EccentricityKind::Angular => {
                let (cross, dot, lengths) = self.rays(x_px, y_px);
                cross / (lengths + dot)
            }
            EccentricityKind::Planar => {
                let offset = [x_px - self.gaze_px[0], y_px - self.gaze_px[1]];
                let [dx, dy] = self.planar.offset_px(offset);
                (dx * dx + dy * dy).sqrt() / self.planar.focal_px
            }
        }
    }

    /// The [`Eccentricity::ordering_tangent`] of an eccentricity in degrees; infinite if no pixel can
    /// reach it.
    pub(crate) fn ordering_tangent_of_deg(&self, deg: f64) -> f64 {
        let (end_deg, angle_deg) = match self.kind {
            EccentricityKind::Angular => (180.0, deg / 2.0),
            EccentricityKind::Planar => (90.0, deg),
        };
        if deg >= end_deg { f64::INFINITY } else { libm::tan(angle_deg.to_radians()) }
    }

    /// The column, in pixels, at which the eccentricity along a row has its only turning point. On
    /// each side of it eccentricity is monotone. It is not finite if there is no turning point.
    pub(crate) fn turning_x_px(&self, y_px: f64) -> f64 {
        match self.kind {
            EccentricityKind::Planar => self.gaze_px[0],
            EccentricityKind::Angular => {
                // cos e = (X gx + k) / sqrt(X² + m) up to a constant factor; its derivative is 0
                // where gx m = X k.
                let [fx, fy] = self.view.focal_px;
                let [cx, cy] = self.view.principal_px;
                let (gx, gy) = ((self.gaze_px[0] - cx) / fx, (self.gaze_px[1] - cy) / fy);
                let y = (y_px - cy) / fy;
                gx * (1.0 + y * y) / (1.0 + y * gy) * fx + cx
            }
        }
    }

    /// The largest eccentricity of any pixel centre, in degrees. It lies on the border of the
    /// frame: neither kind of eccentricity has a maximum inside.
    pub fn max_deg(&self) -> f64 {
        let (w, h) = (self.view.width, self.view.height);
        let border = (0..w)
            .flat_map(|x| [(x, 0), (x, h - 1)])
            .chain((0..h).flat_map(|y| [(0, y), (w - 1, y)]));
        let (mut far, mut at) = (f64::NEG_INFINITY, (0.5, 0.5));
        for (x, y) in border {
            let centre = (x as f64 + 0.5, y as f64 + 0.5);
            let tangent = self.ordering_tangent(centre.0, centre.1);
            if tangent > far {
                (far, at) = (tangent, centre);
            }
        }
        self.at_deg(at.0, at.1)
    }

    /// Eccentricity in degrees of the pixel centres `xs` of row `y`, in `f32`. It differs from
    /// [`Eccentricity::at_deg`] by less than 1e-5 (relative) plus a thousandth of a pixel, which is
    /// enough for weights but not for deciding bands.
    pub fn fill_row_deg(&self, y: usize, xs: Range<usize>, out: &mut [f32]) {
        let out = &mut out[..xs.len()];
        let [fx, fy] = self.view.focal_px;
        let dy_px = y as f64 + 0.5 - self.gaze_px[1];
        // It is computed from the column number, so that the value of a pixel does not depend on
        // the stretch it is part of.
        let start = xs.start as f32;
        let offset_px = (0.5 - self.gaze_px[0]) as f32;
        match self.kind {
            EccentricityKind::Planar => {
                let f = self.planar.focal_px;
                let [step, dy] = self.planar.offset_px([1.0 / f, dy_px / f]);
                planar_row(RowStretch { start, offset_px, step: step as f32, dy: dy as f32 }, out);
            }
            EccentricityKind::Angular => {
                let [cx, cy] = self.view.principal_px;
                let gaze =
                    [((self.gaze_px[0] - cx) / fx) as f32, ((self.gaze_px[1] - cy) / fy) as f32];
                let row = RowStretch {
                    start,
                    offset_px,
                    step: (1.0 / fx) as f32,
                    dy: (dy_px / fy) as f32,
                };
                angular_row(row, gaze, out);
            }
        }
    }
}

/// A stretch of a row, relative to the gaze.
#[derive(Clone, Copy)]
struct RowStretch {
    /// The first column.
    start: f32,
    /// Offset from a column's number to its pixel centre, relative to the gaze.
    offset_px: f32,
    /// Tangent of the angle of one pixel.
    step: f32,
    /// Tangent of the angle from the gaze down to the row.
    dy: f32,
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn angular_row(row: RowStretch, [gx, gy]: [f32; 2], out: &mut [f32]) {
    let RowStretch { start, offset_px, step, dy } = row;
    let g2 = 1.0 + gx * gx + gy * gy;
    let ry = dy + gy;
    for (i, out) in out.iter_mut().enumerate() {
        let dx = ((start + i as f32) + offset_px) * step;
        let rx = dx + gx;
        let z = dx * gy - dy * gx;
        let cross = (dx * dx + dy * dy + z * z).sqrt();
        let dot = 1.0 + rx * gx + ry * gy;
        let lengths = ((1.0 + rx * rx + ry * ry) * g2).sqrt();
        // If the rays to the pixel and to the gaze point in nearly opposite directions (very wide
        // views), dot is close to -lengths, and their sum is close to 0. The exact sum is never 0,
        // but it can be in f32.
        *out = 2.0 * atan_deg(cross, (lengths + dot).max(f32::MIN_POSITIVE));
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn planar_row(row: RowStretch, out: &mut [f32]) {
    let RowStretch { start, offset_px, step, dy } = row;
    for (i, out) in out.iter_mut().enumerate() {
        let dx = ((start + i as f32) + offset_px) * step;
        *out = atan_deg((dx * dx + dy * dy).sqrt(), 1.0);
    }
}

/// atan(y / x) in degrees for y ≥ 0, x > 0, without a branch. Abramowitz and Stegun 4.4.49; the
/// error is 2e-8 on [0, 1].
#[inline(always)]
fn atan_deg(y: f32, x: f32) -> f32 {
    const C: [f32; 8] = [
        -0.333_331_45,
        0.199_935_51,
        -0.142_089,
        0.106_562_64,
        -0.075_289_64,
        0.042_909_614,
        -0.016_165_737,
        0.002_866_225_7,
    ];
    let steep = y > x;
    let t = if steep { x / y } else { y / x };
    let s = t * t;
    let series = C.iter().rev().fold(0.0, |sum, c| (sum + c) * s);
    let angle = (t + t * series) * (180.0 / PI) as f32;
    if steep { 90.0 - angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::ViewSpec;
    use proptest::prelude::*;

    fn view(width: usize, height: usize, vertical_deg: f64) -> View {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(vertical_deg) };
        spec.resolve(width, height).unwrap().view
    }

    /// The literal definition: the cross product, and the angle by atan2.
    fn literal_deg(view: &View, gaze: [f64; 2], x: f64, y: f64) -> f64 {
        let ray = |x: f64, y: f64| {
            [
                (x - view.principal_px[0]) / view.focal_px[0],
                (y - view.principal_px[1]) / view.focal_px[1],
                1.0,
            ]
        };
        let (a, b) = (ray(x, y), ray(gaze[0], gaze[1]));
        let cross =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let norm = cross.iter().map(|c| c * c).sum::<f64>().sqrt();
        norm.atan2(a.iter().zip(b).map(|(a, b)| a * b).sum()).to_degrees()
    }

    #[test]
    fn the_papers_shortcut_is_wrong_off_centre() {
        // 2560x1440, 110° vertical: a pixel 500 px inward from a gaze on the right edge.
        let view = view(2560, 1440, 110.0);
        let gaze = [2560.0, 720.0];
        let at = |kind| Eccentricity::new(view, gaze, kind).at_deg(2060.0, 720.0);
        assert!((at(EccentricityKind::Planar) - 44.8).abs() < 0.05);
        assert!((at(EccentricityKind::Angular) - 11.4).abs() < 0.05);
    }

    #[test]
    fn a_scaled_picture_has_the_eccentricity_of_the_frame() {
        // Halved to 17x62 pixels: scaled by 17/33 along x and 62/123 along y.
        let (w, h) = (33.0, 123.0);
        let view = view(33, 123, 70.0);
        for kind in [EccentricityKind::Angular, EccentricityKind::Planar] {
            let full = Eccentricity::new(view, [4.0, 100.0], kind);
            let once = full.scaled((17, 62), [17.0 / w, 62.0 / h]);
            let twice = once.scaled((9, 31), [9.0 / 17.0, 31.0 / 62.0]);
            for (scaled, size) in [(once, [17.0, 62.0]), (twice, [9.0, 31.0])] {
                for [x, y] in [[0.5, 0.5], [8.5, 30.5], [3.5, 11.5]] {
                    let want = full.at_deg(x * w / size[0], y * h / size[1]);
                    assert!((scaled.at_deg(x, y) - want).abs() < 1e-9, "{kind:?}");
                    let mut row = [0.0; 9];
                    scaled.fill_row_deg(y as usize, 0..9, &mut row);
                    assert!((f64::from(row[x as usize]) - want).abs() < 1e-3, "{kind:?}");
                }
            }
        }
    }

    proptest! {
        #[test]
        fn agrees_with_the_literal_formula(
            fov in 10.0..170.0f64, gx in -20.0..120.0f64, gy in -20.0..90.0f64,
            x in 0usize..97, y in 0usize..71,
        ) {
            let view = view(97, 71, fov);
            let e = Eccentricity::new(view, [gx, gy], EccentricityKind::Angular);
            let (xc, yc) = (x as f64 + 0.5, y as f64 + 0.5);
            let want = literal_deg(&view, [gx, gy], xc, yc);
            prop_assert!((e.at_deg(xc, yc) - want).abs() < 1e-9 * want.max(1.0));
            prop_assert!((2.0 * e.ordering_tangent(xc, yc).atan().to_degrees() - want).abs() < 1e-9 * want.max(1.0));
            for kind in [EccentricityKind::Angular, EccentricityKind::Planar] {
                let e = Eccentricity::new(view, [gx, gy], kind);
                let mut row = [0.0; 97];
                e.fill_row_deg(y, 0..97, &mut row);
                let want = e.at_deg(xc, yc);
                prop_assert!((f64::from(row[x]) - want).abs() < 1e-5 * want.max(1.0), "{} {want}", row[x]);
                let brute = (0..71).flat_map(|y| (0..97).map(move |x| (x, y)))
                    .map(|(x, y)| e.at_deg(x as f64 + 0.5, y as f64 + 0.5)).fold(0.0, f64::max);
                prop_assert!((e.max_deg() - brute).abs() < 1e-9);
            }
        }
    }
}
