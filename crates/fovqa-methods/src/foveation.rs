//! The interface of a method that is applied to a frame and a gaze.

use std::fmt::Debug;

use crate::setting::Place;

/// Samples per pixel in two directions.
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

    /// The rates of a separable method, from its samples per pixel along x and y: with J = diag(j),
    /// |J d| along a direction and |J d⊥| across it.
    pub(crate) fn separable([jx, jy]: [f64; 2], [dx, dy]: [f64; 2]) -> Self {
        Self { radial: libm::hypot(jx * dx, jy * dy), tangential: libm::hypot(jx * dy, jy * dx) }
    }
}

/// The numbers of samples that a method shades in a frame. They are ideal: a real buffer has
/// integer sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Counts {
    /// Width and height of each reduced buffer in samples, the innermost first.
    pub buffers: Vec<[f64; 2]>,
    /// The number of samples as the papers count them.
    pub samples: f64,
    /// The number of samples that fall into the frame, including those of `samples_beyond`.
    pub samples_on_screen: f64,
    /// Additional samples for a frame that is wider than the method's own field (VaFR beyond 60°).
    pub samples_beyond: f64,
    /// The number of samples that are shaded and visible: the integral of the density over the
    /// frame, without samples that a finer layer covers or that are reprojected.
    pub samples_seen: f64,
}

impl Counts {
    /// The total cost of a frame: the papers' count plus the samples beyond the method's own field.
    pub fn whole(&self) -> f64 {
        self.samples + self.samples_beyond
    }

    /// The counts of a method that has no buffer, but selects among the frame's own pixels.
    pub(crate) fn of_pixels(samples: f64) -> Self {
        Self {
            buffers: Vec::new(),
            samples,
            samples_on_screen: samples,
            samples_beyond: 0.0,
            samples_seen: samples,
        }
    }

    /// The counts of a method that shades each of its samples once.
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
    /// Up to the frame's border in the direction of the curve.
    Border,
    /// Up to the frame's farthest corner.
    Corner,
}

/// A method applied to a frame and a gaze.
pub trait Foveation: Debug + Send + Sync {
    /// Samples per pixel at a place, along the line from the gaze and across it; `None` where the
    /// method has no samples.
    fn rates(&self, place: Place) -> Option<Rates>;

    /// Samples per pixel of area at a place.
    fn density(&self, place: Place) -> f64 {
        self.rates(place).map_or(0.0, |rates| rates.radial * rates.tangential)
    }

    /// The numbers of samples.
    fn counts(&self) -> Counts;

    /// The share of the samples at any place that is shaded, from 0 to 1. The others are
    /// reprojected from the other eye: the density includes them, and the counts do not.
    fn shaded_share(&self) -> f64 {
        1.0
    }

    /// How far its curves reach.
    fn reach(&self) -> Reach {
        Reach::Any
    }

    /// The mapping of samples to the screen; `None` for a method that selects among the frame's own
    /// pixels.
    fn mapping(&self) -> Option<&dyn Mapping> {
        None
    }

    /// A note that must accompany the method in this setting wherever it is shown.
    fn note(&self) -> Option<String> {
        None
    }
}

/// The mapping between the screen and reduced buffers. Coordinates of a buffer begin at its
/// top-left corner; a sample's centre is at +0.5.
pub trait Mapping {
    /// The number of buffers, which are ordered from the innermost on.
    fn layers(&self) -> usize {
        1
    }

    /// The layer whose samples are visible at a place; at a bound it is the inner one.
    fn layer_at(&self, _place: Place) -> usize {
        0
    }

    /// Ideal width and height of a layer's buffer, in samples.
    fn buffer(&self, layer: usize) -> [f64; 2];

    /// The buffer coordinates of a place.
    fn to_buffer(&self, layer: usize, place: Place) -> [f64; 2];

    /// The place with these buffer coordinates.
    fn to_screen(&self, layer: usize, buffer: [f64; 2]) -> Place;

    /// Whether the buffer's columns are distances and its rows angles. Columns may have different
    /// numbers of rows, so that the row number also changes along a line from the gaze. Callers
    /// must therefore work at equal angle, not at equal row.
    fn is_polar(&self) -> bool;
}
