//! Where a pixel falls on the retina: view, gaze, eccentricity, bands, displays, acuity.
//!
//! | word | meaning |
//! | --- | --- |
//! | view | a pinhole eye buffer: size, focal length and principal point in pixels |
//! | gaze | the point looked at, in pixels from the frame's top-left corner |
//! | eccentricity | angle between a pixel's ray and the gaze ray, in degrees |
//! | band | a half-open range of eccentricity |
//!
//! Pixel (0, 0) is the top-left one and its centre is at (0.5, 0.5); x to the right, y down.

pub mod acuity;
mod bands;
mod displays;
mod doubts;
mod eccentricity;
mod gaze_error;
mod gaze_table;
mod gaze_trace;
mod pixel_scale;
mod ring;
mod seen;
mod view;

pub use bands::{BandEdges, BandEdgesError, BandMap, DEFAULT_BAND_DEG, Run};
pub use displays::{Display, Eotf, Luminance, LuminanceError, displays, find_display};
pub use eccentricity::{Eccentricity, EccentricityKind};
pub use gaze_error::{Export, GazeTraceError};
pub use gaze_trace::{FrameAt, GazeAt, GazeTrace};
pub use pixel_scale::{PixelScale, Tangential};
pub use seen::Seen;
pub use view::{ResolvedView, View, ViewError, ViewSpec};
