//! Mathematics on pixels: frames as decoded, transfer functions, tone maps, luma, masks and row
//! blocks. This crate knows nothing about files or eyes.
//!
//! | word | meaning |
//! | --- | --- |
//! | frame | decoded samples of one picture, one (gray) or three (RGB) channels |
//! | signal | the values that metrics compare: display-encoded, in `[0, peak]` |
//! | plane | one channel of the signal, `f32`, row by row |
//! | mask | which pixels count |
//! | guides | motion and depth of a frame, as decoded |
//! | source | a sequence of frames from any origin |

mod blocks;
mod buffer;
mod chromaticities;
mod codes;
mod conversion;
mod display_range;
mod frame;
mod frame_signal;
mod guides;
mod half_floats;
mod light;
mod luma;
mod luminance;
mod mask;
mod pair;
mod side;
mod signal;
mod signal_params;
pub mod source;
mod tonemap;
pub mod transfer;

pub use blocks::{BLOCK_ROWS, map_plane_blocks, map_row_blocks};
pub use buffer::Buffer;
pub use chromaticities::Chromaticities;
pub use display_range::DisplayRange;
pub use frame::{BadPixel, Channels, Crop, CropError, Frame, FrameError, Samples};
pub use frame_signal::FrameSignal;
pub use guides::{Guides, Motion, Plane, PlaneSamples};
pub use half_floats::half_floats;
pub use light::{LightKind, LightSignal};
pub use luma::{LumaKind, LumaScratch, LumaSignal};
pub use luminance::{LinearInput, LuminanceScratch, LuminanceSignal, LuminanceTables};
pub use mask::Mask;
pub use pair::{PairSignal, PairTile, Part};
pub use signal::SignalTables;
pub use signal_params::{Luma, SignalChannels, SignalParams, Transfer};
pub use tonemap::ToneMap;
