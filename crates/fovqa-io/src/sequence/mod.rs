//! Path arguments to pairs of files: folders, globs, printf patterns, pairing, frame ranges.

mod argument;
mod frame_range;
mod natural_order;
mod pairing;

pub use argument::{FrameFile, Listing, ListingError, is_glob, list, list_below, literal};
pub use frame_range::{FrameRange, FrameRangeError};
pub use pairing::{Alone, FramePair, PairingError, Pairs, pair};
