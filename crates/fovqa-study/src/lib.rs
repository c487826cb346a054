//! Statistics of user studies: reads a tidy CSV table of trials, and computes estimates, intervals
//! and tests.
//!
//! The crate is pure: bytes and settings in, values that serialise to JSON out. Results do not
//! depend on the number of threads. An undefined value is `None` (`null` in JSON), and a `reason`
//! in the same object says why.

mod analysis;
pub mod anova;
pub mod bootstrap;
mod error;
pub mod input;
pub mod json;
pub mod metrics;
pub mod moments;
pub mod options;
pub mod pairs;
pub mod plan;
pub mod psychometric;
pub mod quantile;
pub mod random;
pub mod ranks;
pub mod ratings;
mod request;
mod settings;
mod simplex;
pub mod staircase;

pub use analysis::Analysis;
pub use error::{StudyError, WrongCell};
pub use fovqa_statistics::{adjust, distributions};
pub use request::{Inputs, Request};
pub use settings::Settings;
