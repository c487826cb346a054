//! FovVideoVDP 1.2 (Mantiuk, Denes, Chapiro, Kaplanyan, Rufo, Bachy, Lian, Patney 2021, "FovVideoVDP: A
//! visible difference predictor for wide field-of-view video", ACM TOG 40(4), 49).
//!
//! A file a step:
//!
//! | step | file |
//! | --- | --- |
//! | values to light, light to luminance | `photometry`, `color_space` |
//! | where a pixel lies on the display and from the gaze | `geometry` |
//! | sustained and transient channel | `temporal_filters`, `window` |
//! | bands of spatial frequency | `pyramid`, `bands` |
//! | contrast to the background | `contrast` |
//! | sensitivity | `csf` |
//! | differences in multiples of the threshold, masked | `masking` |
//! | rows of a level, all of that together | `level` |
//! | levels to a frame | `score` |
//! | frames to a sequence | `sequence` |
//! | Q and just-objectionable differences | `pooling` |
//! | heat maps | `heat_map` |
//! | planes, their memory | `grid`, `spare` |
//!
//! Luminance is in cd/m². Q is 0 and above; JOD is 10 for no difference, falls by 1 where 75 % of observers
//! prefer the reference, and has no lower end. Everything is computed in `f32`, one pixel like any other,
//! and summed in `f64` over fixed blocks of rows: the same bits for any number of threads and any vector
//! width.

mod band;
mod bands;
mod calibration;
mod color_space;
mod contrast;
mod csf;
mod geometry;
mod grid;
mod heat_map;
mod level;
mod log_exp;
mod masking;
mod params;
mod photometry;
mod pooling;
mod pyramid;
mod score;
mod sequence;
mod spare;
mod temporal_filters;
#[cfg(test)]
mod tests;
mod window;

pub use color_space::ColorSpace;
pub use csf::sensitivity;
pub use geometry::Geometry;
pub use grid::Grid;
pub use heat_map::DifferenceMap;
pub(crate) use params::INFO;
pub use params::{MapContext, Padding, Params};
pub use photometry::Photometry;
pub use pooling::jod;
pub use pyramid::SMALLEST_SIDE;
pub use score::{Fvvdp, FvvdpBand, FvvdpFrame, FvvdpReference, FvvdpRegions};
pub use sequence::{Stream, Time, TimeError};
pub use temporal_filters::{FASTEST_FPS, TOO_SLOW_FPS};
