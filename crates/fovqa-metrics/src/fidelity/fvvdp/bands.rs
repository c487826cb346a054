//! The bands of a pyramid on a display: their sizes, frequencies and gains, settled once a view.

use super::calibration::COARSE_GAIN;
use super::csf::Line;
use super::geometry::Geometry;
use super::pyramid::band_frequencies_cpd;

/// One band, the finest first.
#[derive(Debug, Clone)]
pub(super) struct Band {
    pub(super) size: (usize, usize),
    /// Frequency at the centre of the display, cycles per degree.
    pub(super) cpd: f64,
    /// log2 of the gain of its contrast.
    pub(super) log2_gain: f32,
    /// Degrees from the centre of the display, of columns and of rows.
    pub(super) directions: [Vec<f64>; 2],
    /// Its sensitivity where every pixel is looked at directly.
    pub(super) foveal: Line,
}

/// The bands of frames under a geometry.
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
