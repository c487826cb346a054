//! Axes of methods that map x and y separately, from their mapping.

use fovqa_methods::{Mapping, Place, Setting};

use crate::rounded::rounded;
use crate::sample_places::SamplePlaces;
use crate::separable::Axis;

/// One axis of a layer, for methods that map the two axes separately: its rounded size, and its
/// coordinates stretched so that the ends are met.
pub(crate) fn layer_axis(
    mapped: &impl Mapping,
    setting: &Setting,
    layer: usize,
    axis: usize,
    places: SamplePlaces,
) -> Axis {
    let (side, gaze) = (setting.size_px()[axis], setting.gaze_px()[axis]);
    let ideal = mapped.buffer(layer)[axis];
    let n = rounded(ideal);
    let stretch = n as f64 / ideal;
    let along = |value: f64| if axis == 0 { [value, 0.0] } else { [0.0, value] };
    let position = |b: f64| {
        // The other axis does not matter.
        let mut buffer = mapped.buffer(layer).map(|size| size / 2.0);
        buffer[axis] = b / stretch;
        mapped.to_screen(layer, buffer).offset_px()[axis] + gaze
    };
    let coordinate = |x: f64| mapped.to_buffer(layer, Place::at(along(x - gaze)))[axis] * stretch;
    Axis::new(n, side as usize, places.axis(axis), position, coordinate)
}
