//! How an eye sees a frame.

use crate::bands::BandEdges;
use crate::eccentricity::Eccentricity;

/// How an eye sees a frame: the view, the gaze and the bands.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// The view and the gaze, from which the eccentricity of each pixel follows.
    pub eccentricity: Eccentricity,
    /// The bands of the frame.
    pub bands: BandEdges,
}
