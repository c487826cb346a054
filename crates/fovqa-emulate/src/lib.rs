//! Emulation: what a foveation method would have shown, from a finished frame or from a scene.
//!
//! A method's samples read the frame where they stand, its reduced buffer is filled, filtered and
//! mapped back onto the screen. From a finished frame emulation understates aliasing and flicker: its
//! pixels are filtered already. A continuous scene ([`SceneLight`]) is asked for the light at each
//! sample itself ([`Emulator::emulate_scene`]), as a renderer would be.
//!
//! | word | meaning |
//! | --- | --- |
//! | picture | `f32` values of the encoded signal in `[0, 1]`, not rounded before the output |
//! | buffer | the samples a method shades; its coordinates run from 0 to the number of samples |
//! | place | where a sample reads the frame or the scene; one (`point`) or 16 (`area`) |
//! | cell | the part of a buffer that a sample stands for; jitter moves the sample within it |
//! | radial | a function of the distance from the gaze alone |
//! | piece | a rectangle of pixels, for which alone a polar buffer is sampled |
//!
//! [`EmulationSpec`] says what is to be emulated, [`Emulator`] prepares it for a frame size, a view and
//! a gaze, and turns [`Picture`]s into pictures, or in less time 8-bit codes into codes
//! ([`Emulator::emulate_codes8`]). One file per method: `rmfr`, `deamp`, `guenter`, `cps`, `linear`,
//! `log_polar` (KFR, LaFR), `vafr`, `visual_polar`, `sandbox`; behind them `temporal` and `enhance`, and
//! `reproject` between the eyes of a stereo pair.
//!
//! Angles are planar, e = atan(r / f), as a renderer computes them.
//!
//! ```
//! use fovqa_emulate::{EmulationSpec, Emulator, Picture};
//! use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
//!
//! let frame = Frame::new(64, 48, Channels::Rgb, Samples::U8(vec![128; 64 * 48 * 3].into()))?;
//! let tables = SignalTables::new(SignalParams::default());
//! let picture = Picture::from_frame(&frame, &tables);
//!
//! let emulator = Emulator::new(&EmulationSpec::new("rmfr")?, [64, 48], None, [32.0, 24.0])?;
//! assert_eq!(emulator.counts().buffers, [[25, 18]]);
//! assert_eq!(emulator.emulate(&picture)?.to_codes8(), frame);
//! assert_eq!(emulator.emulate_codes8(&frame, &tables)?, frame);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arcs;
mod blur;
mod borders;
mod budget;
mod circle;
mod codes;
mod convolve;
mod counts;
mod cps;
mod deamp;
mod emulator;
mod enhance;
mod error;
mod fetch;
mod filters;
mod fxaa;
mod grids;
mod guenter;
mod image;
mod jitter;
mod layer_axis;
mod linear;
mod log_polar;
mod method;
mod moments;
mod offsets;
mod parameters;
mod picture;
mod piece;
mod piece_samples;
mod pixels;
mod places;
mod polar_view;
mod prepared;
mod radial;
mod ragged;
mod ragged_samples;
mod read_frame;
mod reproject;
mod rmfr;
mod rounded;
mod sample_places;
mod sampling;
mod sandbox;
mod sandbox_params;
mod scene;
mod scene_emulation;
mod separable;
mod sequence;
mod source;
mod space;
mod spec;
mod split;
mod sums;
mod taps;
mod temporal;
mod texel;
mod turn;
mod vafr;
mod value;
mod values;
mod visual_polar;
mod write_frame;
mod written;

pub use borders::Border;
pub use budget::BudgetReport;
pub use counts::{Counts, quads};
pub use emulator::Emulator;
pub use error::EmulateError;
pub use filters::FilterChoice;
pub use image::Image;
pub use jitter::Jitter;
pub use picture::Picture;
pub use reproject::{EyeFrame, Reprojected, reproject};
pub use sampling::Sampling;
pub use scene::SceneLight;
pub use space::Space;
pub use spec::{Budget, EmulationSpec};
pub use temporal::{History, TaaParams};
pub use write_frame::WriteFrameError;
