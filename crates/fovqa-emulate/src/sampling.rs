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
