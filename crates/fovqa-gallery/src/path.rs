//! The walk of the viewer through the place: a slow walk with glances to both sides.

use crate::camera::Pose;
use crate::vec3::vec3;

/// Height of the eyes in metres.
const EYE_HEIGHT_M: f64 = 1.62;

/// Where the head is and where it looks at a time in seconds. The walk goes back and forth, so that a
/// sequence may have any length.
pub(crate) fn head(time_s: f64) -> Pose {
    let wave = |period_s: f64, phase: f64| {
        libm::sin((time_s / period_s + phase) * 2.0 * std::f64::consts::PI)
    };
    // From 2.2 m to 10.2 m and back in 24 s; at most 1.05 m/s.
    let z = 6.2 - 4.0 * wave(24.0, 0.25);
    let x = 0.35 * wave(9.0, 0.1);
    // Two steps a second.
    let y = EYE_HEIGHT_M + 0.012 * wave(0.55, 0.0);
    let yaw_deg = 11.0 * wave(7.0, 0.0) + 3.0 * wave(2.9, 0.3);
    let pitch_deg = -2.0 + 3.0 * wave(5.3, 0.6);
    Pose::new(vec3(x, y, z), yaw_deg, pitch_deg)
}
