//! The walk through the hall, frame by frame.

use fovqa_vision::View;

use crate::camera::Camera;
use crate::frame_scene::{FrameScene, Surface};
use crate::path::head;
use crate::place::Place;

/// The hall as one eye of the viewer sees it.
#[derive(Debug)]
pub(crate) struct Walk {
    place: Place,
    view: View,
    fps: f64,
    /// From the middle between the eyes to this eye, to the right, in metres.
    eye_m: f64,
}

impl Walk {
    pub(crate) fn new(view: View, fps: f64, eye_m: f64, seed: u64) -> Self {
        Self { place: Place::new(seed), view, fps, eye_m }
    }

    pub(crate) fn camera(&self, frame: f64) -> Camera {
        Camera { pose: head(frame / self.fps).moved(self.eye_m), view: self.view }
    }

    pub(crate) fn frame(&self, frame: usize) -> WalkFrame<'_> {
        let camera = self.camera(frame as f64);
        WalkFrame { place: &self.place, camera, before: self.camera(frame as f64 - 1.0) }
    }
}

/// A frame of the walk.
#[derive(Debug)]
pub(crate) struct WalkFrame<'a> {
    place: &'a Place,
    camera: Camera,
    /// The camera of the frame before.
    before: Camera,
}

impl FrameScene for WalkFrame<'_> {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        self.place.light(&self.camera.ray(x, y)).to_light()
    }

    fn surface(&self, x: f64, y: f64) -> Surface {
        let ray = self.camera.ray(x, y);
        let hit = self.place.meet(&ray);
        let was = if hit.outdoors {
            // So far away that only the direction counts.
            self.before.pose.turned(ray.direction)
        } else {
            self.before.pose.seen_by_eye(ray.at(hit.t))
        };
        let motion_px = self.before.project(was).map(|[u, v]| [u - x, v - y]);
        let depth_m = hit.t * ray.direction.dot(self.camera.pose.forward);
        Surface { depth_m, motion_px }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk() -> Walk {
        let view =
            View { width: 320, height: 240, focal_px: [150.0; 2], principal_px: [160.0, 120.0] };
        Walk::new(view, 90.0, 0.0315, 1)
    }

    /// The motion leads to where the frame before shows the same point, at the same distance.
    #[test]
    fn motion_leads_to_the_same_point() {
        let walk = walk();
        let mut seen = 0;
        for frame in [1, 90, 300] {
            let (now, then) = (walk.frame(frame), walk.frame(frame - 1));
            for i in 0..2000 {
                let (x, y) = (f64::from(i % 50) * 6.4 + 0.3, f64::from(i / 50) * 6.0 + 0.7);
                let surface = now.surface(x, y);
                let Some([dx, dy]) = surface.motion_px else { continue };
                let (u, v) = (x + dx, y + dy);
                let at = now.camera.ray(x, y).at(now.place.meet(&now.camera.ray(x, y)).t);
                let ray = then.camera.ray(u, v);
                let hit = then.place.meet(&ray);
                // Another thing may have hidden it.
                if hit.outdoors || (ray.at(hit.t) - at).length() > 0.05 {
                    continue;
                }
                assert!((ray.at(hit.t) - at).length() < 1e-6, "{x} {y}");
                seen += 1;
            }
        }
        assert!(seen > 4000, "{seen}");
    }

    #[test]
    fn depth_is_along_the_axis() {
        let walk = walk();
        let frame = walk.frame(0);
        let ray = frame.camera.ray(10.0, 200.0);
        let hit = frame.place.meet(&ray);
        let eye = frame.camera.pose.seen_by_eye(ray.at(hit.t));
        assert!((frame.surface(10.0, 200.0).depth_m - eye.z).abs() < 1e-9);
    }

    #[test]
    fn light_is_finite_and_has_a_bright_window() {
        let walk = walk();
        let frame = walk.frame(40);
        let mut brightest: f32 = 0.0;
        for i in 0..4800 {
            let light = frame.light(f64::from(i % 80) * 4.0, f64::from(i / 80) * 4.0);
            assert!(light.iter().all(|value| value.is_finite() && *value >= 0.0), "{light:?}");
            brightest = light.into_iter().fold(brightest, f32::max);
        }
        assert!(brightest > 3.0, "{brightest}");
    }
}
