//! Parameters that users set by name, with `--set ssim.sigma=1.5` or as a key in a TOML table:
//! their accepted values, default and unit. Metrics, acuity models and foveation methods describe
//! their parameters with [`ParamInfo`] and receive them as [`ParamValue`].

mod error;
mod info;
mod value;
mod words;

pub use error::ParamError;
pub use info::{ParamInfo, ParamValues, find};
pub use value::ParamValue;
pub use words::{OrAuto, Words, words_of};

// The macro `words!` uses it in other crates.
#[doc(hidden)]
pub use serde;
