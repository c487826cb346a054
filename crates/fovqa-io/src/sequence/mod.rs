//! From path arguments to pairs of files: folders, globs, patterns with a number, pairing, frame
//! ranges.

mod argument;
mod frame_number;
mod frame_pattern;
mod frame_range;
mod listing;
mod listing_error;
mod natural_order;
mod pairing;
mod shown;
mod spacing;
mod wildcards;

pub use argument::{list, list_below};
pub use frame_pattern::FramePattern;
pub use frame_range::{FrameRange, FrameRangeError};
pub use listing::{FileListing, FrameFile};
pub use listing_error::ListingError;
pub use pairing::{FramePair, PairingError, Pairs, Unpaired, pair};
pub use shown::shown;
pub use spacing::{MissingFrames, Spacing};
pub use wildcards::{is_glob, literal};
