//! FovVideoVDP 1.2 (Mantiuk, Denes, Chapiro, Kaplanyan, Rufo, Bachy, Lian, Patney 2021,
//! "FovVideoVDP: A visible difference predictor for wide field-of-view video", ACM TOG 40(4), 49).
//!
//! There is one file per step:
//!
//! | step | file |
//! | --- | --- |
//! | encoded values to luminance | `photometry`, `color_space` |
//! | direction of a pixel from the display's centre and from the gaze | `geometry` |
//! | sustained and transient channels | `temporal_filters`, `window` |
//! | spatial-frequency bands | `pyramid`, `bands` |
//! | contrast relative to the background | `contrast` |
//! | sensitivity | `csf` |
//! | masked differences in multiples of the threshold | `masking` |
//! | the rows of a level, which combine these steps | `level` |
//! | from levels to the score of a frame | `score` |
//! | from frames to a sequence | `sequence` |
//! | Q and just-objectionable differences | `pooling` |
//! | heat maps | `heat_map` |
//! | planes and their memory | `grid`, `spare` |
//!
//! Luminance is in cd/m². Q is 0 and above. JOD is 10 for no difference, falls by 1 where 75 % of
//! observers prefer the reference, and has no lower limit. Everything is computed in `f32`, with
//! the same operations for every pixel, and summed in `f64` over fixed blocks of rows. Results are
//! bit-identical for any number of threads and any vector width.

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
