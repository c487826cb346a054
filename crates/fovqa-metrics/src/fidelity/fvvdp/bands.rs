//! The bands of a pyramid on a display: their sizes, frequencies and gains, computed once per view.

use super::band::Band;
use super::calibration::COARSE_GAIN;
use super::csf::Line;
use super::geometry::Geometry;
use super::pyramid::band_frequencies_cpd;

/// The bands of frames in a geometry.
pub(super) fn bands(geometry: &Geometry) -> Vec<Band> {
    let mut size = (geometry.view.width, geometry.view.height);
    let frequencies = band_frequencies_cpd(size, geometry.pixels_per_degree);
    let bands = frequencies.into_iter().enumerate().map(|(index, cpd)| {
        let here = size;
        size = (size.0.div_ceil(2), size.1.div_ceil(2));
        let gain = if index == 0 { 1.0 } else { COARSE_GAIN };
        Band {
            size: here,
            cpd,
            log2_gain: libm::log2(gain) as f32,
            directions: geometry.directions(here),
            foveal: Line::foveal(cpd),
        }
    });
    bands.collect()
}
