//! Motion and depth: which channels they are, what their values mean, and files of their own.

mod choice;
mod options;
mod preset;
mod read;
mod search;

pub(crate) use choice::{DepthChoice, Encoding, MotionChoice, Place, Reach};
pub use options::{DepthChannels, GuideOptions, MotionChannels, MotionUnit, NamedMotion};
pub use preset::GuidePreset;
pub use read::{DecodedGuides, read_guides, read_guides_and_hash};
pub(crate) use search::in_one;
pub use search::{GuideSearch, Sought};
