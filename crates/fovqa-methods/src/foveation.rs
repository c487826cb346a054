//! What every method answers once it is applied to a frame and a gaze.

use std::fmt::Debug;

use crate::setting::Place;

/// Samples per pixel along the line from the gaze and across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rates {
    /// Along the line from the gaze.
    pub radial: f64,
    /// Across it.
    pub tangential: f64,
}

impl Rates {
    /// The same rate in both directions.
    pub(crate) fn both(rate: f64) -> Self {
        Self { radial: rate, tangential: rate }
    }

    /// The rates of a separable method with samples per pixel along x and y, J = diag(j): |J d|
    /// along a direction, |J d⊥| across it.
    pub(crate) fn separable([jx, jy]: [f64; 2], [dx, dy]: [f64; 2]) -> Self {
        Self { radial: libm::hypot(jx * dx, jy * dy), tangential: libm::hypot(jx * dy, jy * dx) }
    }
}

/// How many samples a method shades in a frame. Numbers are ideal: a real buffer has whole sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Counts {
    /// Width and height of each reduced buffer in samples, the innermost first.
    pub buffers: Vec<[f64; 2]>,
    /// What the papers count.
    pub samples: f64,
    /// Those of these and of the ones beyond that fall into the frame.
    pub samples_on_screen: f64,
    /// What a frame wider than the method's own field needs beyond `samples` (VaFR beyond 60°).
    pub samples_beyond: f64,
    /// Samples that are shaded and seen: the integral of the density over the frame, without what is
    /// shaded and then covered by a finer layer, and without what is reprojected.
    pub samples_seen: f64,
}

impl Counts {
    /// All that a frame costs: the papers' count, and what lies beyond the method's own field.
    pub fn whole(&self) -> f64 {
        self.samples + self.samples_beyond
    }

    /// Counts of a method that has no buffer, but chooses among the frame's own pixels.
    pub(crate) fn of_pixels(samples: f64) -> Self {
        Self {
            buffers: Vec::new(),
            samples,
            samples_on_screen: samples,
            samples_beyond: 0.0,
            samples_seen: samples,
        }
    }

    /// Counts of a method whose every sample is shaded once.
    pub(crate) fn of(buffer: [f64; 2], samples_on_screen: f64) -> Self {
        Self {
            buffers: vec![buffer],
            samples: buffer[0] * buffer[1],
            samples_on_screen,
            samples_beyond: 0.0,
            samples_seen: samples_on_screen,
        }
    }
}

/// How far a curve of a method reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// To any eccentricity.
    Any,
    /// To the frame's border in the direction of the curve.
    Border,
    /// To the frame's farthest corner.
    Corner,
}

/// A method applied to a frame and a gaze.
pub trait Foveation: Debug + Send + Sync {
    /// Samples per pixel at a place, along the line from the gaze and across it; `None` where the
    /// method has none.
    fn rates(&self, place: Place) -> Option<Rates>;

    /// Samples per pixel of area at a place.
    fn density(&self, place: Place) -> f64 {
        self.rates(place).map_or(0.0, |rates| rates.radial * rates.tangential)
    }

    /// How many samples there are.
    fn counts(&self) -> Counts;

    /// Share of the samples at any place that is shaded, from 0 to 1. The others are reprojected from
    /// the other eye: the density counts them, and the numbers of samples do not.
    fn shaded_share(&self) -> f64 {
        1.0
    }

    /// How far its curves reach.
    fn reach(&self) -> Reach {
        Reach::Any
    }

    /// Where samples stand; `None` for a method that chooses among the frame's own pixels.
    fn mapping(&self) -> Option<&dyn Mapping> {
        None
    }

    /// What has to be said wherever the method is shown in this setting.
    fn note(&self) -> Option<String> {
        None
    }
}

/// From the screen to reduced buffers and back. Coordinates of a buffer begin at its top-left
/// corner; a sample's centre is at +0.5.
pub trait Mapping {
    /// How many buffers there are, the innermost first.
    fn layers(&self) -> usize {
        1
    }

    /// The layer whose samples are seen at a place: at a bound the inner one.
    fn layer_at(&self, _place: Place) -> usize {
        0
    }

    /// Width and height of a layer's buffer, ideal.
    fn buffer(&self, layer: usize) -> [f64; 2];

    /// The buffer's coordinates of a place.
    fn to_buffer(&self, layer: usize, place: Place) -> [f64; 2];

    /// The place of a buffer's coordinates.
    fn to_screen(&self, layer: usize, buffer: [f64; 2]) -> Place;

    /// Whether the buffer's columns are distances and its rows angles. Columns may have different
    /// numbers of rows, so that a row's number changes along a line from the gaze too: work at equal
    /// angle there, not at equal row.
    fn is_polar(&self) -> bool;
}
