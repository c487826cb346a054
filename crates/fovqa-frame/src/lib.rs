//! Mathematics on pixels: frames as decoded, transfer functions, tone maps, luma, masks and row
//! blocks. Knows nothing of files or eyes.
//!
//! | word | meaning |
//! | --- | --- |
//! | frame | decoded samples of one picture, one (gray) or three (RGB) channels |
//! | signal | what metrics see: display-encoded, in `[0, peak]` |
//! | plane | one channel of the signal, `f32`, row by row |
//! | mask | which pixels count |
//! | guides | motion and depth of a frame, raw as decoded |
//! | source | a sequence of frames, wherever they come from |

mod blocks;
mod chromaticities;
mod codes;
mod conversion;
mod frame;
mod frame_signal;
mod guides;
mod light;
mod luma;
mod mask;
mod pair;
mod shown_light;
mod side;
mod signal;
mod signal_params;
pub mod source;
mod tonemap;
pub mod transfer;

pub use blocks::{BLOCK_ROWS, map_row_blocks};
pub use chromaticities::Chromaticities;
pub use frame::{BadPixel, Channels, Crop, CropError, Frame, FrameError, Samples};
pub use frame_signal::FrameSignal;
pub use guides::{Guides, Motion, Plane, PlaneSamples};
pub use light::{LightTables, LinearLight, LuminanceScratch, LuminanceSignal};
pub use luma::{LumaKind, LumaScratch, LumaSignal};
pub use mask::Mask;
pub use pair::{PairSignal, PairTile, Part};
pub use shown_light::ShownLight;
pub use signal::SignalTables;
pub use signal_params::{Luma, SignalChannels, SignalParams, Transfer};
pub use tonemap::ToneMap;
