//! How a sample of a buffer reads the frame.

use fovqa_params::words;

words! {
    /// How a sample of a buffer reads the frame.
    #[derive(Default)]
    pub enum Sampling {
        /// Where it stands, as a shader would.
        #[default]
        Point "point" "The frame where the sample stands, as a shader would";
        /// The mean of 4x4 places of the sample's area.
        Area "area" "The mean of 4x4 places of the sample's area";
    }
}

impl Sampling {
    /// Places of a sample along an axis, from 0 to 1.
    pub(crate) fn places(self) -> &'static [f64] {
        match self {
            Self::Point => &[0.5],
            Self::Area => &[0.125, 0.375, 0.625, 0.875],
        }
    }

    /// Coordinates of the places of all of `n` samples, in the order of the samples.
    pub(crate) fn coordinates(self, n: usize) -> impl Iterator<Item = f64> {
        (0..n).flat_map(move |i| self.places().iter().map(move |place| i as f64 + place))
    }
}
