//! Test against reference: one file a metric, and one pass over the rows for all of them.

pub mod fpsnr;
mod ms_ssim;
mod pass;
mod scorer;
mod squared_error;
pub mod ssim;
#[cfg(test)]
mod tests;
mod weighted_mean;

pub use scorer::{BandScores, PairScores, ScoreError, Scorer};
pub use squared_error::psnr_db;
