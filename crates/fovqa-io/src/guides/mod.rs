//! Motion and depth: their channels, the meaning of their values, and separate files for them.

pub(crate) mod choice;
mod encoding;
pub(crate) mod options;
pub(crate) mod preset;
mod preset_channels;
pub(crate) mod search;
mod search_order;

pub(crate) use choice::{DepthChoice, GuideFile, LayerScope, MotionChoice};
pub(crate) use encoding::Encoding;
pub use options::{DepthChannels, GuideOptions, MotionChannels, MotionUnit, NamedMotion};
pub use preset::GuidePreset;
pub(crate) use search::joined_names;
pub use search::{ChannelSearch, GuideSearch};
