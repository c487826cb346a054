//! A frame with the gaze in its centre.

use std::fmt::Display;

use fovqa_methods::Setting;
use fovqa_vision::ViewSpec;

/// A frame with a vertical field of view in degrees, the gaze in its centre.
pub(super) fn centred([width, height]: [usize; 2], fov_vertical_deg: f64) -> Setting {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(fov_vertical_deg) };
    let view = spec.resolve(width, height).map(|resolved| resolved.view);
    let gaze_px = [width as f64 / 2.0, height as f64 / 2.0];
    possible(Setting::new(&possible(view), gaze_px))
}

/// What cannot fail, since the papers' own values are written here.
pub(super) fn possible<T, E: Display>(made: Result<T, E>) -> T {
    made.unwrap_or_else(|error| panic!("a paper's own values: {error}"))
}
