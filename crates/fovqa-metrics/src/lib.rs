//! The measures themselves: numbers out of pairs of frames. Knows nothing of files.
//!
//! [`Metric`] is the registry: what there is, with units, direction, parameters and source.
//! [`Scorer`] computes every metric asked for in one pass over the rows of a pair; each metric's
//! formula stands in a file of its own under `fidelity/`.

mod fidelity;
mod params;
mod regions;
mod registry;

pub use fidelity::fpsnr::{self, WeightField};
pub use fidelity::ssim;
pub use fidelity::{BandScores, PairScores, ScoreError, Scorer, psnr_db};
pub use params::{ParamError, ParamValue, Params};
pub use regions::Regions;
pub use registry::{Better, Metric, MetricInfo, ParamInfo, ParamValues};
