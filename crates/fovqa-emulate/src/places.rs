//! Places around the gaze on the frame.

use fovqa_methods::Setting;

/// The place in pixels at a distance from the gaze in a direction, a unit vector.
#[inline]
pub(crate) fn place(setting: &Setting, distance_px: f64, direction: [f64; 2]) -> [f64; 2] {
    let gaze_px = setting.gaze_px();
    [0, 1].map(|i| gaze_px[i] + distance_px * direction[i])
}

/// Whether a position is inside the frame, [0, W) x [0, H).
#[inline]
pub(crate) fn in_frame(setting: &Setting, at_px: [f64; 2]) -> bool {
    let size_px = setting.size_px();
    (0..2).all(|i| at_px[i] >= 0.0 && at_px[i] < size_px[i])
}
