//! The places within a sample's cell: one (`point`) or 4x4 (`area`).
//!
//! A point sample is at (ξ, η) of its cell, the centre without jitter. The places of an area sample are
//! at ((p + ξ)/4, (q + η)/4), p, q = 0…3: jitter moves each within its sixteenth of the cell, so that none
//! leaves the cell.

use crate::jitter::CENTRE;
use crate::sampling::Sampling;

/// The places within the cell of each sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SamplePlaces {
    pub(crate) sampling: Sampling,
    /// ξ and η, from 0 to 1.
    within_cell: [f64; 2],
}

impl SamplePlaces {
    /// Places at `within_cell` of each cell, or of its sixteenths.
    pub(crate) fn new(sampling: Sampling, within_cell: [f64; 2]) -> Self {
        Self { sampling, within_cell }
    }

    /// Whether there is no jitter.
    pub(crate) fn are_centred(&self) -> bool {
        self.within_cell == CENTRE
    }

    /// The places along the columns' axis, 0, or the rows', 1.
    pub(crate) fn axis(&self, axis: usize) -> AxisPlaces {
        let count = match self.sampling {
            Sampling::Point => 1,
            Sampling::Area => 4,
        };
        AxisPlaces { count, within_cell: self.within_cell[axis] }
    }
}

/// Where samples of one per pixel stand, in pixels, row by row.
pub(crate) fn pixel_positions(
    places: SamplePlaces,
    [width, height]: [usize; 2],
) -> impl Iterator<Item = [f64; 2]> {
    let [dx, dy] = places.within_cell;
    (0..height).flat_map(move |y| (0..width).map(move |x| [x as f64 + dx, y as f64 + dy]))
}

/// The places of a sample along one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AxisPlaces {
    /// 1 or 4.
    pub(crate) count: usize,
    /// ξ or η.
    pub(crate) within_cell: f64,
}

impl AxisPlaces {
    /// Place `p` within the cell, from 0 to 1.
    #[inline]
    pub(crate) fn at(&self, p: usize) -> f64 {
        (p as f64 + self.within_cell) / self.count as f64
    }

    /// Coordinates of the places of all of `n` samples, in the order of the samples.
    pub(crate) fn coordinates(self, n: usize) -> impl Iterator<Item = f64> {
        let of_sample = move |i: usize| (0..self.count).map(move |p| (i, p));
        (0..n).flat_map(of_sample).map(move |(i, p)| i as f64 + self.at(p))
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "quarters are exact")]
mod tests {
    use super::*;

    #[test]
    fn jitter_moves_places_within_their_parts_of_the_cell() {
        let area = SamplePlaces::new(Sampling::Area, CENTRE);
        let centred: Vec<f64> = area.axis(0).coordinates(2).collect();
        assert_eq!(centred, [0.125, 0.375, 0.625, 0.875, 1.125, 1.375, 1.625, 1.875]);
        let point = SamplePlaces::new(Sampling::Point, [0.25, 0.75]);
        assert!(!point.are_centred() && area.are_centred());
        assert_eq!(point.axis(1).coordinates(3).collect::<Vec<_>>(), [0.75, 1.75, 2.75]);
        let area = SamplePlaces::new(Sampling::Area, [0.0, 1.0]);
        assert_eq!([area.axis(0).at(0), area.axis(0).at(3)], [0.0, 0.75]);
        assert_eq!([area.axis(1).at(0), area.axis(1).at(3)], [0.25, 1.0]);
    }
}
