//! A pinhole camera: from a position in the frame to a ray, and back.

use fovqa_vision::View;

use crate::ray::Ray;
use crate::vec3::{Vec3, vec3};

/// Where the eye is and where it looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    pub(crate) position: Vec3,
    /// Unit vectors to the right of the frame, down, and into it.
    pub(crate) right: Vec3,
    pub(crate) down: Vec3,
    pub(crate) forward: Vec3,
}

impl Pose {
    /// A pose from a position and angles in degrees: `yaw` to the right, `pitch` upwards.
    pub(crate) fn new(position: Vec3, yaw_deg: f64, pitch_deg: f64) -> Self {
        let [yaw, pitch] = [yaw_deg, pitch_deg].map(f64::to_radians);
        let (sy, cy) = (libm::sin(yaw), libm::cos(yaw));
        let (sp, cp) = (libm::sin(pitch), libm::cos(pitch));
        let forward = vec3(sy * cp, sp, cy * cp);
        let right = vec3(cy, 0.0, -sy);
        // y of the frame points down.
        let down = vec3(sy * sp, -cp, cy * sp);
        Self { position, right, down, forward }
    }

    /// The same pose, moved along the frame's right.
    pub(crate) fn moved(self, metres: f64) -> Self {
        Self { position: self.position + self.right * metres, ..self }
    }

    /// A point in the world, from the eye: right, down and forward, in metres.
    pub(crate) fn seen_by_eye(&self, point: Vec3) -> Vec3 {
        self.turned(point - self.position)
    }

    /// A direction, from the eye.
    pub(crate) fn turned(&self, to: Vec3) -> Vec3 {
        vec3(to.dot(self.right), to.dot(self.down), to.dot(self.forward))
    }
}

/// A pose with the view of a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Camera {
    pub(crate) pose: Pose,
    pub(crate) view: View,
}

impl Camera {
    /// The ray through a position in the frame, in pixels.
    pub(crate) fn ray(&self, x: f64, y: f64) -> Ray {
        let View { focal_px, principal_px, .. } = self.view;
        let (u, v) = ((x - principal_px[0]) / focal_px[0], (y - principal_px[1]) / focal_px[1]);
        let Pose { position, right, down, forward } = self.pose;
        Ray::new(position, (right * u + down * v + forward).unit())
    }

    /// The position of a direction from the eye (right, down, forward) in the frame; `None` behind it.
    pub(crate) fn project(&self, from_eye: Vec3) -> Option<[f64; 2]> {
        let View { focal_px, principal_px, .. } = self.view;
        (from_eye.z > 0.0).then(|| {
            [
                principal_px[0] + focal_px[0] * from_eye.x / from_eye.z,
                principal_px[1] + focal_px[1] * from_eye.y / from_eye.z,
            ]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_ray_meets_is_seen_where_it_began() {
        let view =
            View { width: 200, height: 100, focal_px: [80.0, 90.0], principal_px: [99.0, 52.0] };
        let pose = Pose::new(vec3(1.0, 1.6, 2.0), 20.0, -7.0).moved(0.03);
        let camera = Camera { pose, view };
        for (x, y) in [(0.0, 0.0), (99.0, 52.0), (13.25, 80.5), (200.0, 100.0)] {
            let point = camera.ray(x, y).at(3.7);
            let [u, v] = camera.project(pose.seen_by_eye(point)).unwrap();
            assert!((u - x).abs() < 1e-9 && (v - y).abs() < 1e-9, "{u} {v}");
        }
        assert!(camera.project(vec3(0.0, 0.0, -1.0)).is_none());
        let axes = [pose.right, pose.down, pose.forward];
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                assert!((a.dot(*b) - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
        // Right, down and forward are a right-handed system, as x, y and z of a frame are.
        assert!(
            (axes[0].cross(axes[1]) - axes[2]).length() < 1e-12
                || (axes[0].cross(axes[1]) + axes[2]).length() < 1e-12
        );
    }
}
