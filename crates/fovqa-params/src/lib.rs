//! Parameters that users set by name, `--set ssim.sigma=1.5` or a key in a TOML table: what each may
//! be, its default and its unit. Metrics, acuity models and foveation methods describe theirs with
//! [`ParamInfo`] and take them as [`ParamValue`].

mod error;
mod info;
mod value;
mod words;

pub use error::ParamError;
pub use info::{ParamInfo, ParamValues, find};
pub use value::ParamValue;
pub use words::{OrAuto, Words, words_of};

// For [`words!`].
#[doc(hidden)]
pub use serde;
