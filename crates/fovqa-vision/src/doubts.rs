//! Warnings about views that are possible but most likely a mistake: an angle or a length in
//! another unit, or sides in another order.

use crate::view::{View, ViewSpec};

/// No headset or screen fills a larger full angle, in degrees.
const WIDEST_DEG: f64 = 170.0;

/// No display has more pixels per degree. The eye resolves about 60, at best twice as many.
const DENSEST_PPD: f64 = 250.0;

/// Eye buffers do not have pixels with a larger ratio of sides.
const OBLONG: f64 = 1.1;

impl ViewSpec {
    /// Describes what is doubtful about a view that was given in this way: one sentence per doubt,
    /// with what may have been meant. A display preset has no doubts, since its numbers are known.
    pub fn doubts(&self, view: &View) -> Vec<String> {
        let [across, down] = field_deg(view);
        let ppd = view.pixels_per_degree();
        let mut doubts = Vec::new();
        match self {
            ViewSpec::Display(_) => return doubts,
            ViewSpec::Frustum { left, right, up, down: below } => {
                let sides = [*left, *right, *up, *below].map(f64::abs);
                if let Some(tangents) = radians(view, sides) {
                    doubts.push(format!(
                        "the frustum values look like angles in radians, because the tangents of these angles give square \
                         pixels; they are used as tangents; the tangents of these angles would be {}",
                        listed(tangents)
                    ));
                }
            }
            ViewSpec::PixelPitch { .. } | ViewSpec::Screen { .. }
                if across.max(down) > WIDEST_DEG =>
            {
                doubts.push(format!(
                    "the screen fills {across:.1}° x {down:.1}°, more than any real screen: the distance must be in \
                     metres and the pixel size in millimetres"
                ));
            }
            _ => {}
        }
        if ppd > DENSEST_PPD {
            let unit = match self {
                ViewSpec::PixelPitch { .. } | ViewSpec::Screen { .. } => {
                    "the distance must be in metres and the pixel size in millimetres"
                }
                ViewSpec::Frustum { .. } => "a frustum is given by the tangents of its half angles",
                _ => "a field of view is given in degrees, not in radians",
            };
            doubts.push(format!(
                "the view has {ppd:.0} pixels per degree at its centre, more than any display: {unit}"
            ));
        }
        let aspect = aspect(view.focal_px);
        let by_sides = matches!(
            self,
            ViewSpec::Frustum { .. }
                | ViewSpec::Fov { horizontal_deg: Some(_), vertical_deg: Some(_) }
        );
        if by_sides && aspect > OBLONG {
            doubts.push(format!(
                "pixels are {aspect:.2} times as long in one direction as in the other (focal lengths {:.1} and {:.1} px): \
                 check that the angles belong to frames of {}x{} and are in the right order",
                view.focal_px[0], view.focal_px[1], view.width, view.height
            ));
        }
        doubts
    }
}

/// The full angles across and down, in degrees.
fn field_deg(view: &View) -> [f64; 2] {
    let sides = [view.width as f64, view.height as f64];
    std::array::from_fn(|axis| {
        let (f, centre) = (view.focal_px[axis], view.principal_px[axis]);
        (libm::atan(centre / f) + libm::atan((sides[axis] - centre) / f)).to_degrees()
    })
}

/// The longer side of a pixel divided by the shorter one.
fn aspect([x, y]: [f64; 2]) -> f64 {
    (x / y).max(y / x)
}

/// Reads the sides of a frustum as angles in radians and returns their tangents, if this is far
/// more likely: these tangents make square pixels, and the sides as they were given do not.
fn radians(view: &View, sides: [f64; 4]) -> Option<[f64; 4]> {
    /// The pixels of eye buffers are square to within this ratio, about one pixel in a thousand.
    const SQUARE: f64 = 1.003;
    const NOT_SQUARE: f64 = 1.01;
    if sides.iter().any(|side| *side >= std::f64::consts::FRAC_PI_2) {
        return None;
    }
    let [l, r, u, d] = sides.map(libm::tan);
    let meant = aspect([view.width as f64 / (l + r), view.height as f64 / (u + d)]);
    (meant < SQUARE && aspect(view.focal_px) > NOT_SQUARE).then_some([l, r, u, d])
}

/// Four tangents in the notation of the command line.
fn listed(tangents: [f64; 4]) -> String {
    tangents.map(|tangent| format!("{tangent:.4}")).join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::displays::find_display;

    fn doubts(spec: &ViewSpec, size: (usize, usize)) -> Vec<String> {
        spec.doubts(&spec.resolve(size.0, size.1).unwrap().view)
    }

    fn frustum([left, right, up, down]: [f64; 4]) -> ViewSpec {
        ViewSpec::Frustum { left, right, up, down }
    }

    fn fov(horizontal_deg: Option<f64>, vertical_deg: Option<f64>) -> ViewSpec {
        ViewSpec::Fov { horizontal_deg, vertical_deg }
    }

    #[test]
    fn ordinary_views_are_not_doubted() {
        let eye = frustum([-1.2, 0.9, 1.1, -1.1]);
        for (spec, size) in [
            (eye, (2016, 2112)),
            (fov(None, Some(100.0)), (1440, 1600)),
            (fov(Some(90.0), Some(90.0)), (400, 400)),
            (fov(None, Some(60.0)), (48, 40)),
            (fov(None, Some(172.0)), (48, 40)),
            (fov(None, Some(0.5)), (64, 64)),
            (ViewSpec::PixelPitch { distance_m: 0.6, pitch_mm: 0.25 }, (3840, 2160)),
            (ViewSpec::PixelPitch { distance_m: 0.3, pitch_mm: 0.055 }, (1080, 2400)),
            (ViewSpec::FovDiagonal { diagonal_deg: 110.0 }, (1440, 1600)),
            (ViewSpec::Display(find_display("htc-vive-pro").unwrap().clone()), (100, 700)),
        ] {
            assert_eq!(doubts(&spec, size), Vec::<String>::new(), "{spec:?}");
        }
    }

    #[test]
    fn likely_mistakes_are_described() {
        let radians = [-0.87f64, 0.73, 0.83, -0.83].map(|side| side.abs().tan());
        // The frame size that the runtime recommends for these angles.
        let height = 2000.0 * (radians[2] + radians[3]) / (radians[0] + radians[1]);
        for (spec, size, words) in [
            (frustum([-0.87, 0.73, 0.83, -0.83]), (2000, height.round() as usize), "in radians"),
            (frustum([1.1, 1.1, 1.2, 0.9]), (2112, 1000), "check that the angles"),
            (fov(None, Some(1.92)), (1440, 1600), "not in radians"),
            (fov(Some(100.0), Some(60.0)), (1000, 1000), "in the right order"),
            (ViewSpec::FovDiagonal { diagonal_deg: 1.92 }, (1440, 1600), "not in radians"),
            (ViewSpec::PixelPitch { distance_m: 600.0, pitch_mm: 0.25 }, (1920, 1080), "metres"),
            (ViewSpec::PixelPitch { distance_m: 0.6, pitch_mm: 250.0 }, (1920, 1080), "metres"),
            (ViewSpec::Screen { distance_m: 600.0, size_m: [0.6, 0.3] }, (1920, 960), "metres"),
        ] {
            let found = doubts(&spec, size);
            assert!(found.iter().any(|doubt| doubt.contains(words)), "{spec:?}: {found:?}");
        }
        let found = doubts(&frustum([-0.87, 0.73, 0.83, -0.83]), (2000, height.round() as usize));
        assert!(found[0].contains(&listed(radians)), "{found:?}");
    }
}
